#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/Cell.hpp>

#include <utility>
#include <vector>

namespace suture {

/// A side of an element.
struct Side {
  int element;
  int side;  ///< number in cellInfo(...).sideNodes
};

/// 2 pi r: what a point of the meridian plane stands for in axisymmetric blocks.
inline double circumference(double radius) { return 6.283185307179586476925286766559 * radius; }

/// Elements and their nodes, numbered from 0: the part of a mesh that assembly needs. The whole mesh and the mesh of a subdomain are both
/// made of one, so that elasticity serves both.
struct CellBlock {
  int dimension = 2;
  std::vector<double> coordinates;  ///< nodes x dimension [length]
  std::vector<Cell> cells;          ///< shape of each element
  std::vector<int> offsets{0};      ///< elements + 1
  std::vector<int> connectivity;    ///< nodes of element e: connectivity[offsets[e] .. offsets[e+1])

  /// A meridian half plane: x is the distance r >= 0 from the axis, y runs along it, and the body is the whole revolution. Set by
  /// makeAxisymmetric(); whatever integrates over elements or sides then has the factor 2 pi r.
  bool axisymmetric = false;

  std::vector<int> regions;  ///< number of each element's region in the scene, or -1; empty: the scene has no regions

  int nodes() const { return static_cast<int>(coordinates.size()) / dimension; }
  int elements() const { return static_cast<int>(cells.size()); }
  Span<const int> nodesOf(int element) const {
    return {connectivity.data() + offsets[element], std::size_t(offsets[element + 1] - offsets[element])};
  }
  Point point(int node) const {
    Point p{0, 0, 0};
    for (int k = 0; k < dimension; ++k) p[k] = coordinates[std::size_t(node) * dimension + k];
    return p;
  }
  /// Nodes of a side, end points first, so that the body lies on the left of the way from the first to the second.
  std::vector<int> nodesOf(const Side& side) const;
};

/// Calls visit(ends, side) for every side of an element; ends: its two end points, the lower number first.
template <typename Visit>
void forEachSide(const CellBlock& block, int element, const Visit& visit) {
  const Span<const int> nodes = block.nodesOf(element);
  int number = 0;
  for (const std::vector<int>& side : cellInfo(block.cells[element]).sideNodes) {
    const int a = nodes[side[0]], b = nodes[side[1]];
    visit(a < b ? std::pair<int, int>(a, b) : std::pair<int, int>(b, a), Side{element, number++});
  }
}

}  // namespace suture
