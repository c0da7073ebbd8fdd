#pragma once
#include <suture/base/Point.hpp>
#include <suture/base/Types.hpp>
#include <suture/mesh/CellBlock.hpp>

#include <limits>
#include <map>
#include <vector>

namespace suture {

/// Sides that meet at a larger angle make a corner: a ring of eight sides is still round.
constexpr double sharpAngle = 45.001 * 3.14159265358979323846 / 180;

/// A named group of sides seen as lines through nodes: outward normals, tributary lengths and the order of the nodes along it. Plane.
class BoundaryLine {
 public:
  BoundaryLine(const CellBlock& block, const std::vector<Side>& sides);

  struct Node {
    Point weightedNormal{0, 0, 0};                             ///< integral of (outward normal x hat function of the node) [length]
    double tributary = 0.0;                                    ///< integral of the hat function [length]; axisymmetric: times 2 pi r [area]
    double spacing = std::numeric_limits<double>::infinity();  ///< distance to the nearest neighbour along the line [length]
    std::vector<Point> sideNormals;                            ///< unit outward normals of the sides that meet here
  };

  /// Nodes that follow each other, with the body on the left. A closed chain begins at its lowest node, which is not repeated at the end.
  struct Chain {
    std::vector<int> nodes;
    std::vector<double> arc;  ///< length of the way from the first node [length]
    bool closed = false;
  };

  const std::map<int, Node>& nodes() const { return nodes_; }
  const Node& at(int node) const { return nodes_.at(node); }
  /// Unit outward normal, averaged over the sides by their lengths.
  Point normal(int node) const;
  /// Connected chains, in ascending order of their lowest nodes; empty if the line branches.
  const std::vector<Chain>& chains() const { return chains_; }
  /// Nodes that three or more sides of the group share.
  const std::vector<int>& branchings() const { return branchings_; }

 private:
  void addSide(const CellBlock& block, const std::vector<int>& nodes);
  void addTributaryAreas(const CellBlock& block, const std::vector<int>& nodes);
  void makeChains(const CellBlock& block);

  std::map<int, Node> nodes_;
  std::map<int, int> next_, previous_;
  std::vector<int> branchings_;
  std::vector<Chain> chains_;
};

/// A quarter turn to the left, in the plane.
Point turned(const Point& a);

}  // namespace suture
