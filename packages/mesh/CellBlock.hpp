#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/Cell.hpp>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace suture {

/// A side of an element.
struct Side {
  int element;
  int side;  ///< number in cellInfo(...).sideNodes
};

/// Identifies a side by its vertices, in any order: in 2D by the two end points; in 3D by the three lowest vertices, which suffice in a
/// conforming mesh.
struct SideKey {
  int low = -1;         ///< the lowest
  long long rest = -1;  ///< the others

  bool operator==(const SideKey& other) const { return low == other.low && rest == other.rest; }
  bool operator<(const SideKey& other) const { return low < other.low || (low == other.low && rest < other.rest); }
};

inline SideKey sideKey(int a, int b) { return a < b ? SideKey{a, b} : SideKey{b, a}; }

/// \param vertices  two; in 3D three or four
inline SideKey sideKey(const int* vertices, int count) {
  if (count == 2) return sideKey(vertices[0], vertices[1]);
  int a = vertices[0], b = vertices[1], c = vertices[2];  // the three lowest, sorted below
  if (b < a) std::swap(a, b);
  if (c < b) std::swap(b, c);
  if (b < a) std::swap(a, b);
  if (count > 3) {
    const int d = vertices[3];
    if (d < c) c = d;
    if (c < b) std::swap(b, c);
    if (b < a) std::swap(a, b);
  }
  return {a, static_cast<long long>(b) << 32 | c};
}

/// 2 pi r: length of the circle through a point of the meridian plane, for axisymmetric blocks.
inline double circumference(double radius) { return 6.283185307179586476925286766559 * radius; }

/// Springs on a side of an element, the elastic coating of a softened contact: they connect each node of the side with an outer node at the
/// same place, which belongs to no element.
struct Coating {
  int element = -1;
  int side = -1;            ///< number in cellInfo(...).sideNodes
  int contact = -1;         ///< place in the list of contacts (ContactSurface::number)
  int begin = 0;            ///< its outer nodes are CellBlock::coatingNodes[begin ...], in the order of the side's nodes
  double normal = 0.0;      ///< stiffness along the side's normal [stress / length]
  double tangential = 0.0;  ///< likewise along the side
};

/// Elements and their nodes, numbered from 0: the part of a mesh needed for assembly. Base of the whole mesh and of the mesh of a
/// subdomain, so that elasticity serves both.
struct CellBlock {
  int dimension = 2;
  std::vector<double> coordinates;  ///< nodes x dimension [length]
  /// Coordinates of the bodies as drawn, where the mesh is a later shape of bodies that move far; empty: it is the drawn mesh itself.
  std::vector<double> drawn;
  std::vector<Cell> cells;        ///< shape of each element
  std::vector<int> offsets{0};    ///< elements + 1
  std::vector<int> connectivity;  ///< nodes of element e: connectivity[offsets[e] .. offsets[e+1])

  /// True for a meridian half plane: x is the distance r >= 0 from the axis, y runs along it, and the body is the full revolution. Set by
  /// makeAxisymmetric(); all integrals over elements or sides then include the factor 2 pi r.
  bool axisymmetric = false;

  std::vector<int> regions;  ///< number of each element's region in the scene, or -1; empty: the scene has no regions

  std::vector<Coating> coatings;  ///< springs of softened contacts; empty for most scenes
  std::vector<int> coatingNodes;  ///< outer nodes of the coatings

  /// Number of nodes without the outer nodes of coatings, which have the highest numbers.
  int bodyNodes() const { return coatingNodes.empty() ? nodes() : *std::min_element(coatingNodes.begin(), coatingNodes.end()); }
  int nodes() const { return static_cast<int>(coordinates.size()) / dimension; }
  int elements() const { return static_cast<int>(cells.size()); }
  Span<const int> nodesOf(int element) const {
    return {connectivity.data() + offsets[element], std::size_t(offsets[element + 1] - offsets[element])};
  }
  Point point(int node) const { return pointFrom(coordinates, node); }
  /// Place of a node on the drawn body.
  Point drawnPoint(int node) const { return pointFrom(drawn.empty() ? coordinates : drawn, node); }
  /// Nodes of a side, vertices first, in the order defined in SideGeometry.hpp.
  std::vector<int> nodesOf(const Side& side) const;
  SideKey keyOf(const Side& side) const;

  /// Nodes of the coated side.
  std::vector<int> innerNodes(const Coating& coating) const { return nodesOf(Side{coating.element, coating.side}); }
  /// Outer nodes of a coating, in the order of innerNodes().
  Span<const int> outerNodes(const Coating& coating) const {
    return {coatingNodes.data() + coating.begin, cellInfo(cells[coating.element]).sideNodes[coating.side].size()};
  }

 private:
  Point pointFrom(const std::vector<double>& values, int node) const {
    Point p{0, 0, 0};
    for (int k = 0; k < dimension; ++k) p[k] = values[std::size_t(node) * dimension + k];
    return p;
  }
};

/// Node under each outer node of the coatings, by outer node. Local.
std::map<int, int> nodesUnderCoatings(const CellBlock& block);

/// The block with every coating as one more element, whose nodes are the inner nodes, then the outer ones: the connectivity of stiffness
/// matrices. Without coatings it is the block itself. Local.
class CoatedBlock {
 public:
  explicit CoatedBlock(const CellBlock& block);
  const CellBlock& block() const { return copy_.cells.empty() ? given_ : copy_; }

 private:
  const CellBlock& given_;
  CellBlock copy_;
};

/// Calls visit(key, side) for every side of an element.
template <typename Visit>
void forEachSide(const CellBlock& block, int element, const Visit& visit) {
  const Span<const int> nodes = block.nodesOf(element);
  const CellInfo& cell = cellInfo(block.cells[element]);
  int number = 0;
  if (block.dimension == 2) {
    for (const std::vector<int>& side : cell.sideNodes) visit(sideKey(nodes[side[0]], nodes[side[1]]), Side{element, number++});
    return;
  }
  int vertices[kMostSideVertices];
  for (const std::vector<int>& side : cell.sideNodes) {
    int count = 0;
    for (const int local : side)
      if (local < cell.vertices) vertices[count++] = nodes[local];
    visit(sideKey(vertices, count), Side{element, number++});
  }
}

}  // namespace suture
