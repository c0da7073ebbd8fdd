#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <array>
#include <limits>
#include <map>
#include <vector>

namespace suture {

/// A part of the boundary of bodies: its sides, their neighbours, and normals and sizes at its nodes. A line in 2D, a surface in 3D; for
/// the order of a side's nodes see SideGeometry.hpp. Local.
///
/// Two sides are neighbours if they share a facet: an end point in 2D, an edge (by its two vertices) in 3D. Facet k of a side is its vertex
/// k in 2D, the edge from vertex k to the next vertex in 3D.
class Surface {
 public:
  /// Sides of the elements of a mesh, in this order.
  Surface(const CellBlock& block, const std::vector<Side>& sides);
  /// Sides by their nodes. \param points  of all nodes, by number;  \param dimension  2 or 3
  Surface(int dimension, const std::vector<Point>& points, const std::vector<std::vector<int>>& sides);

  /// The same surface with other nodes. \param to  new number of every node; keeps their order
  void renumber(const std::map<int, int>& to);

  struct Node {
    Point position{0, 0, 0};
    Point drawn{0, 0, 0};           ///< position on the drawn body (CellBlock::drawn)
    Point weightedNormal{0, 0, 0};  ///< sum over sides of outward normal x share of the node [length or area]
    double tributary = 0.0;         ///< integral of the node's shape functions [length or area]; axisymmetric: [area]
    double spacing = std::numeric_limits<double>::infinity();  ///< distance to the nearest adjacent node [length]
    std::vector<Point> sideNormals;                            ///< unit outward normals of the sides that meet at the node
    std::vector<int> beside;                                   ///< adjacent nodes along edges of its sides, ascending
  };
  /// Nodes by number.
  const std::map<int, Node>& nodes() const { return nodes_; }
  const Node& at(int node) const { return nodes_.at(node); }
  /// Unit outward normal, averaged over the sides with their sizes as weights.
  Point normal(int node) const;

  int dimension() const { return dimension_; }
  int sides() const { return static_cast<int>(sides_.size()); }
  /// Nodes of a side.
  const std::vector<int>& nodesOf(int side) const { return sides_[side]; }
  /// Number of a side's facets, equal to that of its vertices.
  int facets(int side) const { return static_cast<int>(neighbours_[side].size()); }

  /// A facet of a side.
  struct Facet {
    int side = -1, facet = -1;
  };
  /// The same facet as seen from the neighbouring side. Its side is -1 on the rim, and where the surface branches.
  const Facet& across(int side, int facet) const { return neighbours_[side][facet]; }
  /// Vertices of facets shared by three or more sides, or by two of opposite orientation, ascending. Empty for valid surfaces.
  const std::vector<int>& branchings() const { return branchings_; }

  /// For each side, the number of its connected part (connected through facets). Parts are numbered in the order of their lowest nodes.
  std::vector<int> parts() const;
  /// Nodes within two steps along edges, ascending, including the node itself.
  std::vector<int> nodesNear(int node) const;

 private:
  void addSide(const std::vector<Point>& points, bool axisymmetric, const std::vector<int>& nodes);
  void findNeighbours();

  int dimension_;
  std::vector<std::vector<int>> sides_;
  std::vector<std::vector<Facet>> neighbours_;
  std::map<int, Node> nodes_;
  std::vector<int> branchings_;
};

}  // namespace suture
