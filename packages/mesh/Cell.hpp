#pragma once
#include <array>
#include <string>
#include <vector>

namespace suture {

/// Shapes of elements. The values are written to mesh files: do not renumber.
enum class Cell : int { Triangle3 = 0, Triangle6 = 1, Quadrilateral4 = 2, Quadrilateral8 = 3, Quadrilateral9 = 4 };

/// What is known of a shape without any geometry.
struct CellInfo {
  std::string name;
  int dimension;
  int nodes;
  int vertices;                             ///< the first nodes
  std::vector<std::vector<int>> sideNodes;  ///< of each side: local nodes, end points first, in the positive sense of the element
  int vtkType;
};

const CellInfo& cellInfo(Cell cell);

}  // namespace suture
