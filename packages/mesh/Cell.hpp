#pragma once
#include <array>
#include <string>
#include <vector>

namespace suture {

/// Shapes of elements. The values are written to mesh files: do not renumber.
enum class Cell : int {
  Triangle3 = 0,
  Triangle6 = 1,
  Quadrilateral4 = 2,
  Quadrilateral8 = 3,
  Quadrilateral9 = 4,
  Tetrahedron4 = 5,
  Tetrahedron10 = 6,
  Hexahedron8 = 7,
  Hexahedron20 = 8,
  Hexahedron27 = 9,
  Wedge6 = 10,
  Pyramid5 = 11
};
constexpr int kCells = 12;          ///< number of shapes
constexpr int kMostCellNodes = 27;  ///< largest number of nodes of a shape
constexpr int kMostSideNodes = 9;   ///< largest number of nodes of a side
constexpr int kMostSideVertices = 4;

/// Topology of a shape.
struct CellInfo {
  std::string name;
  int dimension;
  int order;  ///< order of the polynomials on its edges
  int nodes;
  int vertices;  ///< the first nodes
  std::vector<std::array<int, 2>>
      edges;  ///< vertices of the edges; in cells of order 2 the mid-edge nodes follow the vertices in this order
  std::vector<std::vector<int>> sideNodes;  ///< local nodes of each side, in the order defined in SideGeometry.hpp
  int vtkType;
};

namespace detail {
extern const std::array<CellInfo, kCells> cells;
[[noreturn]] void noSuchCell(int number);
}  // namespace detail

/// Topology of a shape; inline, since loops over elements call it. \throws InternalError  for an invalid number
inline const CellInfo& cellInfo(Cell cell) {
  const auto at = static_cast<unsigned>(cell);
  if (at >= detail::cells.size()) detail::noSuchCell(static_cast<int>(at));
  return detail::cells[at];
}

/// Dimension of a shape; cheaper than cellInfo().
constexpr int dimensionOf(Cell cell) { return cell < Cell::Tetrahedron4 ? 2 : 3; }
/// True for triangles and tetrahedra.
constexpr bool isSimplex(Cell cell) {
  return cell == Cell::Triangle3 || cell == Cell::Triangle6 || cell == Cell::Tetrahedron4 || cell == Cell::Tetrahedron10;
}

}  // namespace suture
