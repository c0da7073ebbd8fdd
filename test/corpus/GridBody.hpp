#pragma once
#include <suture/mesh/Mesh.hpp>

#include <functional>
#include <string>

namespace suture::corpus {

/// Sides of a cell of the grid, where its neighbour is missing.
enum class Face { Bottom, Right, Top, Left };

/// A body whose mesh is the image of a grid of nx x ny cells of the unit square; cells may be left out (a tray), and the left may be glued
/// to the right (a ring).
struct GridBody {
  std::string name;
  Cell cell = Cell::Quadrilateral4;
  int nx = 4, ny = 4;
  bool periodic = false;
  std::function<Point(double s, double t)> map;              ///< keeps the orientation
  std::function<bool(int i, int j)> present;                 ///< none: all cells
  std::function<std::string(int i, int j, Face face)> side;  ///< suffix of the side group of a boundary side; "": in none
  bool keepGrid = false;     ///< map, present or side depend on the numbers of cells: Builder must not change them
  int cutsX = 1, cutsY = 1;  ///< named subdomains, this many blocks of cells per direction
};

/// Adds the body to the mesh: element groups <name> and subdomain_<name>_<i>_<j>, side groups <name>_<suffix>. Local.
void add(const GridBody& body, Mesh& mesh);

/// Renumbers nodes and elements: new number of each. Local.
void renumber(Mesh& mesh, const std::vector<int>& nodes, const std::vector<int>& elements);

/// The suffixes bottom, right, top, left of a box.
std::string boxSide(int i, int j, Face face);

}  // namespace suture::corpus
