#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/RigidValues.hpp>
#include <suture/precond/coarse/ClusterGraph.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace suture {

namespace {

/// True if the values of these unknowns determine all rigid motions of a body. Rotations are scaled by the extent of the unknowns.
bool fixesMotion(const ClusterGraph& graph, const std::vector<int>& shared) {
  constexpr double least = 1e-6;  // smallest over largest singular value, squared
  const int d = graph.dimension, count = rigidMotions(d);
  if (static_cast<int>(shared.size()) < count) return false;
  const Point& origin = graph.unknowns[shared[0]].point;
  Matrix motions(static_cast<int>(shared.size()), count);
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const InterfaceLayout::Unknown& u = graph.unknowns[shared[i]];
    const std::array<double, 6> values = rigidValues(d, minus(u.point, origin), u.direction, u.moment);
    for (int k = 0; k < count; ++k) motions(static_cast<int>(i), k) = values[k];
  }
  const double size = motions.rightCols(count - d).cwiseAbs().maxCoeff();
  if (!(size > 0.0)) return false;
  motions.rightCols(count - d) /= size;
  const Vector values = symmetricEigenpairs(motions.transpose() * motions).values;
  return values(0) > least * values(count - 1);
}

double squareDistance(const Point& a, const Point& b) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sum;
}

/// The two unknowns that are farthest apart, approximately: the farthest from the first one, and the farthest from that.
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
    std::map<int, std::vector<int>> shared;  // by the other local problem, of higher number
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

std::vector<InterfaceLayout::Entity> clusterEntities(const ClusterGraph& graph, const std::vector<int>& clusterOf) {
  EntityGraph entities;
  std::map<std::pair<int, int>, std::vector<GlobalId>> shared;  // two local problems in different clusters -> unknowns they share
  for (int u = 0; u < static_cast<int>(graph.unknowns.size()); ++u) {
    std::vector<int> sharers;
    for (const int local : graph.holders[u]) sharers.push_back(clusterOf[local]);
    std::sort(sharers.begin(), sharers.end());
    sharers.erase(std::unique(sharers.begin(), sharers.end()), sharers.end());
    if (sharers.size() < 2) continue;
    entities.addNode(u, std::move(sharers));
    for (std::size_t a = 0; a < graph.holders[u].size(); ++a)
      for (std::size_t b = a + 1; b < graph.holders[u].size(); ++b) {
        const std::pair<int, int> pair{graph.holders[u][a], graph.holders[u][b]};
        if (clusterOf[pair.first] != clusterOf[pair.second]) shared[pair].push_back(u);
      }
  }
  for (const auto& [pair, unknowns] : shared) {
    const auto [a, b] = std::minmax(clusterOf[pair.first], clusterOf[pair.second]);
    entities.addSet(unknowns, {a, b}, graph.dimension == 2 ? EntityKind::Edge : EntityKind::Face);
  }
  std::vector<SeamEntity> found = entities.entities();

  std::vector<InterfaceLayout::Entity> all;
  for (const SeamEntity& entity : found) {
    all.push_back({entity.kind, entity.sharers, entity.nodes, {}});
    if (entity.kind != EntityKind::Edge) continue;
    std::vector<int> line(entity.nodes.begin(), entity.nodes.end());
    for (const int vertex : entity.boundary) line.insert(line.end(), found[vertex].nodes.begin(), found[vertex].nodes.end());
    const auto [one, other] = ends(graph, line);
    for (const GlobalId u : entity.nodes)
      if (squareDistance(graph.unknowns[u].point, graph.unknowns[one].point) == 0.0 ||
          squareDistance(graph.unknowns[u].point, graph.unknowns[other].point) == 0.0)
        all.back().ends.push_back(u);
  }
  std::stable_sort(all.begin(), all.end(), [](const InterfaceLayout::Entity& a, const InterfaceLayout::Entity& b) {
    return std::make_pair(a.kind, a.unknowns.front()) < std::make_pair(b.kind, b.unknowns.front());
  });
  return all;
}

}  // namespace suture
