#pragma once
#include <suture/mesh/Surface.hpp>

#include <functional>
#include <vector>

namespace suture {

/// Nodes of a plane surface that follow each other, with the body on the left.
struct SurfaceRun {
  std::vector<int> nodes;
  std::vector<double> arc;  ///< length of the way from the first node [length]
  bool closed = false;      ///< a ring; it begins at its lowest node, which is not repeated at the end
};
/// The connected runs of a plane surface, in ascending order of their lowest nodes; none if it branches. Local.
std::vector<SurfaceRun> runsOf(const Surface& surface);

/// A node in the order in which a surface's nodes are listed.
struct OrderedNode {
  int node;
  double arc;  ///< way along its run in the plane [length]; zero in space
};
/// The nodes of a surface that are wanted: in the plane along its runs, in space ascending. A ring of which some are not wanted begins
/// behind one of these, so that neighbours follow each other. Local.
std::vector<OrderedNode> inOrder(const Surface& surface, const std::function<bool(int)>& wanted);

}  // namespace suture
