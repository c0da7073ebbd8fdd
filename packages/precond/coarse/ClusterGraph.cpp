#include <suture/base/Dense.hpp>
#include <suture/base/DisjointSets.hpp>
#include <suture/precond/coarse/ClusterGraph.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace suture {

namespace {

/// Do these values of a plane body tell all its rigid motion? Lengths by the extent of the unknowns.
bool fixesMotion(const ClusterGraph& graph, const std::vector<int>& shared) {
  constexpr double least = 1e-6;  // smallest over largest singular value, squared
  if (shared.size() < 3) return false;
  const Point& origin = graph.unknowns[shared[0]].point;
  Matrix motions(static_cast<int>(shared.size()), 3);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const InterfaceLayout::Unknown& u = graph.unknowns[shared[i]];
    const double turned = u.direction[1] * (u.point[0] - origin[0]) - u.direction[0] * (u.point[1] - origin[1]) + u.moment;
    motions.row(static_cast<int>(i)) << u.direction[0], u.direction[1], turned;
  }
  const double size = motions.col(2).cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return false;
  motions.col(2) /= size;
  const Vector values = symmetricEigenpairs(motions.transpose() * motions).values;
  return values(0) > least * values(2);
}

double squareDistance(const Point& a, const Point& b) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/// The two of these that are farthest apart, by unknown: the extremes of the longer direction of their bounding box.
std::pair<int, int> ends(const ClusterGraph& graph, const std::vector<int>& unknowns) {
  const auto farthestFrom = [&](int from) {
    return *std::max_element(unknowns.begin(), unknowns.end(), [&](int a, int b) {
      return squareDistance(graph.unknowns[a].point, graph.unknowns[from].point) <
             squareDistance(graph.unknowns[b].point, graph.unknowns[from].point);
    });
  };
  const int first = farthestFrom(unknowns.front());
  return {first, farthestFrom(first)};
}

}  // namespace

void ClusterGraph::findHolders() {
  holders.assign(unknowns.size(), {});
  for (std::size_t i = 0; i < unknownsOf.size(); ++i)
    for (const int unknown : unknownsOf[i]) holders[unknown].push_back(static_cast<int>(i));
}

ElementGraph fixedNeighbours(const ClusterGraph& graph) {
  const int n = static_cast<int>(graph.unknownsOf.size());
  std::vector<std::vector<int>> neighbours(n);
  for (int i = 0; i < n; ++i) {
    std::map<int, std::vector<int>> shared;  // with local problems of higher number
    for (const int unknown : graph.unknownsOf[i])
      for (const int other : graph.holders[unknown])
        if (other > i) shared[other].push_back(unknown);
    for (const auto& [other, unknowns] : shared)
      if (fixesMotion(graph, unknowns)) {
        neighbours[i].push_back(other);
        neighbours[other].push_back(i);
      }
  }
  ElementGraph result;
  for (auto& own : neighbours) {
    std::sort(own.begin(), own.end());
    result.neighbours.insert(result.neighbours.end(), own.begin(), own.end());
    result.offsets.push_back(static_cast<int>(result.neighbours.size()));
  }
  return result;
}

InterfaceLayout clusterEntities(const ClusterGraph& graph, const std::vector<int>& clusterOf) {
  const int size = static_cast<int>(graph.unknowns.size());
  std::vector<std::vector<int>> sharers(size);
  for (int u = 0; u < size; ++u) {
    for (const int local : graph.holders[u]) sharers[u].push_back(clusterOf[local]);
    std::sort(sharers[u].begin(), sharers[u].end());
    sharers[u].erase(std::unique(sharers[u].begin(), sharers[u].end()), sharers[u].end());
  }

  // Unknowns of two clusters hang together where two local problems, one in each, share both of them.
  DisjointSets chains(size);
  std::map<std::pair<int, int>, int> firstOf;             // local problems of two clusters -> an unknown they share
  std::map<std::pair<int, int>, std::vector<int>> fixed;  // the same -> unknowns of three or more clusters among those they share
  for (int u = 0; u < size; ++u) {
    if (sharers[u].size() < 2) continue;
    for (std::size_t a = 0; a < graph.holders[u].size(); ++a)
      for (std::size_t b = a + 1; b < graph.holders[u].size(); ++b) {
        const std::pair<int, int> pair{graph.holders[u][a], graph.holders[u][b]};
        if (clusterOf[pair.first] == clusterOf[pair.second]) continue;
        if (sharers[u].size() > 2)
          fixed[pair].push_back(u);
        else
          chains.join(firstOf.emplace(pair, u).first->second, u);
      }
  }
  std::map<int, std::vector<int>> members;  // by the first of each chain
  for (int u = 0; u < size; ++u)
    if (sharers[u].size() == 2) members[chains.lowest(u)].push_back(u);
  std::map<int, std::set<int>> touching;  // corners that a chain ends at
  for (const auto& [pair, corners] : fixed)
    if (const auto found = firstOf.find(pair); found != firstOf.end())
      touching[chains.lowest(found->second)].insert(corners.begin(), corners.end());

  InterfaceLayout layout;
  for (int u = 0; u < size; ++u)
    if (sharers[u].size() > 2) layout.corners.push_back(u);
  for (const auto& [first, chain] : members) {
    std::vector<int> all = chain;
    all.insert(all.end(), touching[first].begin(), touching[first].end());
    const auto [one, other] = ends(graph, all);
    InterfaceLayout::Edge edge{{sharers[first][0], sharers[first][1]}, {}};
    for (const int u : chain)
      if (squareDistance(graph.unknowns[u].point, graph.unknowns[one].point) == 0.0 ||
          squareDistance(graph.unknowns[u].point, graph.unknowns[other].point) == 0.0)
        layout.corners.push_back(u);
      else
        edge.unknowns.push_back(u);
    if (!edge.unknowns.empty()) layout.edges.push_back(std::move(edge));
  }
  return layout;
}

}  // namespace suture
