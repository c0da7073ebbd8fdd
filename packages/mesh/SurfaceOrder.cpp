#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/mesh/SurfaceOrder.hpp>

#include <set>

namespace suture {

namespace {

using Ways = std::map<int, int>;  // node -> the next one

/// The run through a node, which is its lowest. \param next, previous  successor and predecessor of every node
SurfaceRun runThrough(int lowest, const Surface& surface, const Ways& next, const Ways& previous) {
  int first = lowest;
  for (auto at = previous.find(first); at != previous.end() && at->second != lowest; at = previous.find(first)) first = at->second;
  SurfaceRun run;
  run.closed = previous.count(first) > 0;  // only in a ring does the first node have a predecessor
  if (run.closed) first = lowest;
  double arc = 0;
  for (int node = first;;) {
    run.nodes.push_back(node);
    run.arc.push_back(arc);
    const auto following = next.find(node);
    if (following == next.end() || following->second == first) return run;
    arc += norm(minus(surface.at(following->second).position, surface.at(node).position));
    node = following->second;
  }
}

}  // namespace

std::vector<SurfaceRun> runsOf(const Surface& surface) {
  if (surface.dimension() != 2) throw InternalError("only a 2D surface has runs");
  std::vector<SurfaceRun> runs;
  if (!surface.branchings().empty()) return runs;
  Ways next, previous;
  for (int side = 0; side < surface.sides(); ++side) {
    const std::vector<int>& nodes = surface.nodesOf(side);
    for (const auto& [from, to] : sideSteps(static_cast<int>(nodes.size()), 2))
      next[nodes[from]] = nodes[to], previous[nodes[to]] = nodes[from];
  }
  std::set<int> seen;
  for (const auto& entry : surface.nodes()) {
    if (seen.count(entry.first)) continue;
    runs.push_back(runThrough(entry.first, surface, next, previous));
    seen.insert(runs.back().nodes.begin(), runs.back().nodes.end());
  }
  return runs;
}

std::vector<OrderedNode> inOrder(const Surface& surface, const std::function<bool(int)>& wanted) {
  std::vector<OrderedNode> all;
  if (surface.dimension() == 3) {
    for (const auto& entry : surface.nodes())
      if (wanted(entry.first)) all.push_back({entry.first, 0.0});
    return all;
  }
  for (const SurfaceRun& run : runsOf(surface)) {
    const std::size_t n = run.nodes.size();
    std::size_t begin = 0;
    while (run.closed && begin < n && wanted(run.nodes[(begin + n - 1) % n])) ++begin;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t at = (begin + i) % n;
      if (wanted(run.nodes[at])) all.push_back({run.nodes[at], run.arc[at]});
    }
  }
  return all;
}

}  // namespace suture
