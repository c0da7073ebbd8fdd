#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/RigidValues.hpp>
#include <suture/partition/cut/MetisCut.hpp>
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

/// Length over width of a bar, in 3D over the larger width, with the same second moments as these local problems.
double slenderness(const ClusterGraph& graph, const std::vector<int>& locals) {
  constexpr double kOfCorners = 1.0 / 3.0;  // second moment of a rectangle over that of its corners
  const int d = graph.dimension;
  Matrix centres(d, static_cast<int>(locals.size())), moments = Matrix::Zero(d, d);
  for (std::size_t k = 0; k < locals.size(); ++k) {
    const std::vector<int>& unknowns = graph.unknownsOf[locals[k]];
    const auto count = static_cast<int>(unknowns.size());
    Matrix points(d, count);
    for (int i = 0; i < count; ++i) points.col(i) = Eigen::Map<const Vector>(graph.unknowns[unknowns[i]].point.data(), d);
    const Vector centre = count > 0 ? Vector(points.rowwise().mean()) : Vector(Vector::Zero(d));
    centres.col(static_cast<int>(k)) = centre;
    points.colwise() -= centre;
    if (count > 0) moments += kOfCorners / count * points * points.transpose();
  }
  centres.colwise() -= Vector(centres.rowwise().mean());
  moments += centres * centres.transpose();
  const Vector values = symmetricEigenpairs(moments).values;
  return values(d - 2) > 0.0 ? std::sqrt(values(d - 1) / values(d - 2)) : 1.0;  // local problems on a line have no width
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

int divideSlender(const ClusterGraph& graph, const ElementGraph& neighbours, int clusters, std::vector<int>& clusterOf) {
  constexpr double kSlender = 8.0 * (1 + 1e-6), kPiece = 4.0;  // length over width: to divide a cluster (8 : 1 is not), and of a piece
  constexpr int kSeed = 1;
  std::vector<std::vector<int>> members(clusters);
  for (std::size_t i = 0; i < clusterOf.size(); ++i) members[clusterOf[i]].push_back(static_cast<int>(i));
  std::vector<int> parts(clusters, 1);
  bool any = false;
  for (int c = 0; c < clusters; ++c)
    if (const double length = slenderness(graph, members[c]); length > kSlender) {
      parts[c] = std::min(static_cast<int>(members[c].size()), static_cast<int>(std::lround(length / kPiece)));
      any = any || parts[c] > 1;
    }
  if (!any) return clusters;
  const std::vector<ElementGraph> graphs = subgraphs(neighbours, clusterOf, clusters);
  int next = 0;
  for (int c = 0; c < clusters; ++c) {
    const std::vector<int> part = metisCut(graphs[c], parts[c], kSeed);
    for (std::size_t k = 0; k < members[c].size(); ++k) clusterOf[members[c][k]] = next + part[k];
    next += parts[c];
  }
  return next;
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
