#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <suture/answer/values/SingularExtremes.hpp>
#include <suture/answer/values/SingularPlaces.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>

namespace suture {

namespace {

constexpr double kEqualPressure = 1e-6;  // relative difference of pressures that count as equal; the first such pair is reported

/// Nodes at the location of a stress: the node itself, or those of the element. The same on all ranks. Collective.
std::vector<int> nodesOf(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const Extreme& at) {
  std::vector<int> mine;
  for (const SubdomainMesh& mesh : meshes) {
    if (mesh.body != at.body) continue;
    const auto node = std::lower_bound(mesh.globalNodes.begin(), mesh.globalNodes.end(), at.id);
    if (node != mesh.globalNodes.end() && *node == at.id && mesh.point(int(node - mesh.globalNodes.begin())) == at.place)
      mine.push_back(int(at.id));
    const auto element = std::lower_bound(mesh.globalElements.begin(), mesh.globalElements.end(), at.id);
    if (element == mesh.globalElements.end() || *element != at.id) continue;
    const int local = int(element - mesh.globalElements.begin());
    if (centreOf(mesh, local) != at.place) continue;
    for (const int one : mesh.nodesOf(local)) mine.push_back(int(mesh.globalNodes[std::size_t(one)]));
  }
  return unionOverRanks(comm, mine);
}

constexpr double kFixesOnly = 1e-6;  // force of a point support over the largest resultant, below which it only fixes the position

/// True if a condition at a point exerts a force on one of some nodes of the mesh, ascending. The same on all ranks. Collective.
bool haveConditionAtPoint(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Reactions& reactions,
                          const std::vector<int>& nodes) {
  double largest = 0.0;
  for (const auto* list : {&reactions.supports, &reactions.loads, &reactions.springs})
    for (const Resultant& one : *list) largest = std::max(largest, norm(one.force));
  const auto carries = [&](const Support& support) {
    const auto condition = static_cast<std::size_t>(support.condition);
    return condition < reactions.supports.size() && norm(reactions.supports[condition].force) > kFixesOnly * largest;
  };
  const auto isAmong = [&](GlobalId node) { return std::binary_search(nodes.begin(), nodes.end(), int(node)); };
  int mine = 0, all = 0;
  for (const Load& load : model.loads) mine = mine || (load.kind == Load::Kind::PointForce && load.node >= 0 && isAmong(load.node));
  for (const SubdomainMesh& mesh : meshes)
    for (const Support& support : mesh.supports)
      mine = mine || (support.atPoint && carries(support) && isAmong(mesh.globalNodes[std::size_t(support.node)]));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all != 0;
}

/// Id of the pair with the largest pressure; -1: none. \param closed  receives the closed pairs, ascending, on rank 0. Collective.
int mostPressed(const Comm& comm, const Solution& solution, std::vector<int>& closed) {
  int pressed = -1;
  if (comm.getRank() == 0) {
    const PairResult* pair = largestPressure(solution);
    if (pair && pair->pressure > 0.0) pressed = pair->id;
    for (const PairResult& one : solution.pairs)
      if (one.state.closed()) closed.push_back(one.id);
    std::sort(closed.begin(), closed.end());
  }
  broadcastBytes(comm, &pressed, sizeof pressed);
  return pressed;
}

const Extreme& stressOf(const Extremes& extremes, const std::string& key) {
  if (key == "von_mises") return extremes.vonMises;
  if (key == "tension") return extremes.tension;
  if (key == "compression") return extremes.compression;
  throw InternalError("no extreme '" + key + "'");
}

}  // namespace

const PairResult* largestPressure(const Solution& solution) {
  double most = 0.0;
  for (const auto* list : {&solution.pairs, &solution.onAxis})
    for (const PairResult& pair : *list) most = std::max(most, pair.pressure);
  for (const auto* list : {&solution.pairs, &solution.onAxis})
    for (const PairResult& pair : *list)
      if (pair.pressure >= most * (1.0 - kEqualPressure)) return &pair;
  return nullptr;
}

std::map<std::string, std::string> singularExtremes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                                    const Solution& solution, const std::vector<std::string>& keys) {
  std::vector<PlaceInQuestion> places;
  std::vector<std::string> kept;
  std::vector<int> closed;
  for (const std::string& key : keys) {
    if (key == "pressure") {
      const int pair = mostPressed(comm, solution, closed);
      if (pair >= 0) places.push_back({{}, pair}), kept.push_back(key);
    } else if (const Extreme& at = stressOf(solution.extremes, key); at.exists() && at.value != 0.0) {
      places.push_back({nodesOf(comm, meshes, at), -1}), kept.push_back(key);
    }
  }
  const std::vector<std::string> found = singularities(comm, meshes, places, closed);
  std::map<std::string, std::string> all;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    if (!found[i].empty()) all[kept[i]] = found[i];
    if (places[i].pair < 0 && haveConditionAtPoint(comm, meshes, model, solution.verification.reactions, places[i].nodes))
      all[kept[i]] = "where a condition acts on a single node";
  }
  return all;
}

}  // namespace suture
