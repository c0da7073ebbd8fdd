#pragma once
#include <suture/mesh/Cell.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Element type with Gmsh's number.
struct GmshType {
  int number;
  const char* name;  ///< as Gmsh names it
  int dimension;
  int nodes;
  std::optional<Cell> cell;  ///< none: a line, a point, or an element that Suture does not support
  std::vector<int> order;    ///< node i of the cell is Gmsh's node order[i]; empty: the same order
};

/// Entry of the only table of Gmsh's types, or null for a number that the table does not hold. Local.
const GmshType* gmshType(int number);

/// "Triangle 3, Quadrilateral 4, ...": the types that have a Cell.
std::string knownGmshTypes();

}  // namespace suture
