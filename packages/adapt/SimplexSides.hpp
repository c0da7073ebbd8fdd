#pragma once
#include <array>

namespace suture {

/// Vertex opposite to each side of a triangle (dimension 2) or a tetrahedron, by the side's number in cellInfo(...).sideNodes.
constexpr std::array<int, 4> vertexOppositeSide(int dimension) {
  return dimension == 2 ? std::array<int, 4>{2, 0, 1, -1} : std::array<int, 4>{3, 2, 0, 1};
}
/// Side opposite to each vertex: the inverse.
constexpr std::array<int, 4> sideOppositeVertex(int dimension) {
  return dimension == 2 ? std::array<int, 4>{1, 2, 0, -1} : std::array<int, 4>{2, 3, 1, 0};
}

}  // namespace suture
