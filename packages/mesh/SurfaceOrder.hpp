#pragma once
#include <suture/mesh/Surface.hpp>

#include <functional>
#include <vector>

namespace suture {

/// Consecutive nodes of a 2D surface, with the body on the left.
struct SurfaceRun {
  std::vector<int> nodes;
  std::vector<double> arc;  ///< arc length from the first node [length]
  bool closed = false;      ///< a ring; it begins at its lowest node, which is not repeated at the end
};
/// The connected runs of a 2D surface, in ascending order of their lowest nodes; none if the surface branches. Local.
std::vector<SurfaceRun> runsOf(const Surface& surface);

/// A node in the order in which a surface's nodes are listed.
struct OrderedNode {
  int node;
  double arc;  ///< 2D: arc length along its run [length]; 3D: zero
};
/// The wanted nodes of a surface: in 2D along its runs, in 3D ascending. A ring with unwanted nodes begins after one of these, so that
/// neighbours stay consecutive. Local.
std::vector<OrderedNode> inOrder(const Surface& surface, const std::function<bool(int)>& wanted);

}  // namespace suture
