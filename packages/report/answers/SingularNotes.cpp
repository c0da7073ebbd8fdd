#include <Teuchos_CommHelpers.hpp>
#include <suture/answer/values/SingularPlaces.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/report/answers/Answers.hpp>
#include <suture/report/answers/SingularNotes.hpp>

#include <algorithm>

namespace suture {

namespace {

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

}  // namespace

std::vector<std::string> singularNotes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                       const Solution& solution) {
  const Extreme& stress = solution.extremes.vonMises;
  std::vector<PlaceInQuestion> places;
  std::vector<std::string> names;  // on rank 0
  if (stress.exists() && stress.value > 0.0) {
    places.push_back({nodesOf(comm, meshes, stress), -1});
    names.push_back("von Mises stress");
  }
  int pressed = -1;
  Point place{0, 0, 0};
  std::vector<int> closed;
  if (comm.getRank() == 0) {
    const PairResult* pair = largestPressure(solution);
    if (pair && pair->pressure > 0.0) pressed = pair->id, place = pair->position;
    for (const PairResult& one : solution.pairs)
      if (one.state.closed()) closed.push_back(one.id);
    std::sort(closed.begin(), closed.end());
  }
  broadcastBytes(comm, &pressed, sizeof pressed);
  if (pressed >= 0) {
    places.push_back({{}, pressed});
    names.push_back("pressure");
  }
  std::vector<std::string> found = singularities(comm, meshes, places, closed);
  if (stress.exists() && stress.value > 0.0 &&
      haveConditionAtPoint(comm, meshes, model, solution.verification.reactions, places.front().nodes))
    found.front() = "where a condition acts on a single node";
  int dimension = 0, all = 0;
  for (const SubdomainMesh& mesh : meshes) dimension = mesh.dimension;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, dimension, Teuchos::outArg(all));
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i].empty()) continue;
    const std::string at = placeText(places[i].pair < 0 ? stress.place : place, all);
    notes.push_back(broadcast(comm, "the largest " + names[i] + " is at " + at + ", " + found[i] +
                                        ": the exact value there is unbounded, and the computed value grows with mesh refinement"));
  }
  return notes;
}

}  // namespace suture
