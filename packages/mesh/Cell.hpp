#pragma once
#include <array>
#include <string>
#include <vector>

namespace suture {

/// Shapes of elements. The values are written to mesh files: do not renumber.
enum class Cell : int { Triangle3 = 0, Triangle6 = 1, Quadrilateral4 = 2, Quadrilateral8 = 3, Quadrilateral9 = 4 };

/// Topology of a shape.
struct CellInfo {
  std::string name;
  int dimension;
  int nodes;
  int vertices;                             ///< the first nodes
  std::vector<std::vector<int>> sideNodes;  ///< local nodes of each side, end points first, in the positive sense of the element
  int vtkType;
};

namespace detail {
extern const std::array<CellInfo, 5> cells;
[[noreturn]] void noSuchCell(int number);
}  // namespace detail

/// Topology of a shape; inline, since loops over elements ask for it. \throws InternalError  a number that is no shape
inline const CellInfo& cellInfo(Cell cell) {
  const auto at = static_cast<unsigned>(cell);
  if (at >= detail::cells.size()) detail::noSuchCell(static_cast<int>(at));
  return detail::cells[at];
}

}  // namespace suture
