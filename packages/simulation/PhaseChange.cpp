#include <suture/answer/verdict/NodalForces.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/base/Point.hpp>
#include <suture/simulation/PhaseChange.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

// Neither constant is critical: with ten times and a tenth of each, energies, largest displacements and pressures of a driven tunnel, a
// lined tunnel and an excavation agree in all 16 digits, and the imbalance of work of the driven tunnel changes in its fifth digit.
/// Imbalance of a node relative to the largest one, below which it is the accuracy of the solution before and no released force.
constexpr double kReleased = 1e-6;
/// Largest imbalance relative to the internal forces, below which nothing is released.
constexpr double kBalancedForces = 1e-10;

struct NodeVector {
  GlobalId node;
  Point value;
};

std::vector<PairForce> forcesOf(const PathState& path, const Start& start) {
  std::vector<PairForce> forces;
  for (const PathState::Pair& pair : path.pairs) {
    const auto state = start.status.find(pair.id);
    forces.push_back({pair.id, state == start.status.end() ? ContactState() : state->second, pair.force, pair.tangential});
  }
  return forces;
}

/// The part of a nodal force that no prescribed component takes up.
Point freePart(const NodeRule* rule, Point force, int dimension) {
  for (int k = 0; rule && k < dimension; ++k)
    if (rule->fixed[static_cast<std::size_t>(k)]) {
      const Point& axis = rule->axes[static_cast<std::size_t>(k)];
      force = minus(force, scaled(dot(axis, force), axis));
    }
  return force;
}

/// Body and name of each region, in the order of ElasticModel::materialOfRegion.
std::vector<std::pair<std::string, std::string>> regionNames(const Parameters& bodies) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const std::string& body : sublistNames(bodies))
    if (bodies.sublist(body).isSublist("Regions"))
      for (const std::string& region : sublistNames(bodies.sublist(body).sublist("Regions"))) names.emplace_back(body, region);
  return names;
}

}  // namespace

/// Nodal vectors of all ranks, on rank 0. Collective.
std::map<int, Point> PhaseChange::byWholeNode(const SceneParts& parts, const std::vector<Vector>& values) const {
  std::vector<NodeVector> mine;
  for (std::size_t s = 0; s < values.size(); ++s) {
    const SubdomainMesh& mesh = parts.cut.meshes[s];
    for (int node = 0; node < mesh.nodes(); ++node) {
      if (!counts(mesh, node)) continue;
      NodeVector value{mesh.globalNodes[static_cast<std::size_t>(node)], {0, 0, 0}};
      for (int k = 0; k < mesh.dimension; ++k)
        value.value[static_cast<std::size_t>(k)] = values[s][Eigen::Index(node) * mesh.dimension + k];
      mine.push_back(value);
    }
  }
  std::map<int, Point> all;
  const std::vector<int>& whole = parts.phase->nodeOfWhole();
  for (const NodeVector& one : joinOnRoot(parts.run.comm(), mine)) all[whole[static_cast<std::size_t>(one.node)]] = one.value;
  return all;
}

PhaseChange::PhaseChange(const SceneParts& before, const Solution& solution) {
  displacement_ = byWholeNode(before, solution.displacement);
  path_ = before.path->state(solution.pairs);
  if (const auto since = before.sinceTime()) {
    reference_ = byWholeNode(before, before.reference);
    path_.since = *since;
  }
  const std::vector<int>& whole = before.phase->nodeOfWhole();
  for (std::size_t i = 0; i < solution.pairs.size(); ++i) {
    const PairResult& pair = solution.pairs[i];
    const auto fit = before.fits.find(pair.id);
    pairs_[{before.scene.contacts[static_cast<std::size_t>(pair.line)], whole[static_cast<std::size_t>(pair.node)]}].push_back(
        {pair, path_.pairs[i].past, fit == before.fits.end() ? std::nullopt : std::optional<double>(fit->second)});
  }
  const std::vector<std::pair<std::string, std::string>> regions = regionNames(before.scene.settings().sublist("Bodies"));
  for (const LeastSafety& least : path_.safety)
    safety_.emplace_back(least.region < 0 ? std::make_pair(before.scene.model.bodies[static_cast<std::size_t>(least.body)], std::string())
                                          : regions[static_cast<std::size_t>(least.region)],
                         least);
  for (std::size_t b = 0; b < path_.carried.size(); ++b) carried_[before.scene.model.bodies[b]] = path_.carried[b];
  takePending(before);
}

/// Forces of parts removed before the phase that ends, by node of the whole mesh.
void PhaseChange::takePending(const SceneParts& before) {
  const std::vector<int>& whole = before.phase->nodeOfWhole();
  for (const Load& load : before.scene.model.loads) {
    const Release* release = before.path->releaseOf(load);
    if (!release || release->remaining(before.path->time()) == 0.0) continue;
    std::map<int, Point>& forces = pending_.emplace_back(*release, std::map<int, Point>()).second;
    if (before.run.comm().getRank() != 0) continue;
    for (const auto& [node, force] : load.forces) forces[whole[static_cast<std::size_t>(node)]] = force;
  }
}

Point PhaseChange::displacementOf(int node) const {
  const auto found = displacement_.find(node);
  return found == displacement_.end() ? Point{0, 0, 0} : found->second;
}

/// The pair of the last phase that continues in the next one; null: there was none. \param used  number of pairs found by key
const PhaseChange::Pair* PhaseChange::find(const SceneParts& next, const ContactPair& pair, std::map<Key, std::size_t>& used) const {
  const std::vector<int>& whole = next.phase->nodeOfWhole();
  const Key key{next.scene.contacts[static_cast<std::size_t>(pair.line)], whole[static_cast<std::size_t>(pair.node())]};
  const auto found = pairs_.find(key);
  const std::size_t place = used[key]++;
  return found == pairs_.end() || place >= found->second.size() ? nullptr : &found->second[place];
}

void PhaseChange::fit(SceneParts& next, const std::set<std::string>& absentBefore) {
  if (next.run.comm().getRank() != 0) return;
  const std::vector<int>& whole = next.phase->nodeOfWhole();
  std::map<Key, std::size_t> used;
  for (ContactPair& pair : next.constraints.pairs) {
    std::vector<Point> ofEnds;
    bool isPlaced = false;
    for (const PairEnd& end : pair.ends) {
      const int body = next.mesh.bodyOfNode[static_cast<std::size_t>(end.node)];
      isPlaced = isPlaced || absentBefore.count(next.mesh.bodies[static_cast<std::size_t>(body)]) > 0;
      ofEnds.push_back(displacementOf(whole[static_cast<std::size_t>(end.node)]));
    }
    const Pair* old = find(next, pair, used);
    if (isPlaced) {
      double& fit = next.fits[pair.id];
      for (std::size_t e = 0; e < pair.ends.size(); ++e) fit += pair.ends[e].weight * dot(ofEnds[e], pair.normal);
      pair.past.slip = slipOf(pair, ofEnds);
      fitted_[pair.id] = pair.past;
    } else if (old && old->fit) {
      next.fits[pair.id] = *old->fit;
    }
  }
  next.fitPairs();
}

void PhaseChange::takePairs(const SceneParts& next) {
  path_.pairs.clear();
  start_.status.clear();
  if (next.run.comm().getRank() != 0) return;
  std::map<Key, std::size_t> used;
  for (const ContactPair& pair : next.constraints.pairs) {
    if (const Pair* old = find(next, pair, used)) {
      path_.pairs.push_back({pair.id, old->past, old->result.force, old->result.tangential});
      start_.status[pair.id] = old->result.state;
      continue;
    }
    const auto fitted = fitted_.find(pair.id);
    path_.pairs.push_back({pair.id, fitted == fitted_.end() ? ContactPair::Past() : fitted->second, 0.0, {0, 0, 0}});
    if (const ContactLaw& law = next.scene.laws.of(pair.line); !law.separates()) start_.status[pair.id] = law.pressed();
  }
}

namespace {

/// Vectors by node of the whole mesh on rank 0 as vectors by node of the phase's mesh on all ranks, ascending. Collective.
std::vector<NodeVector> inPhase(const SceneParts& next, const std::map<int, Point>& byWholeNode) {
  std::vector<NodeVector> all;
  if (next.run.comm().getRank() == 0) {
    const std::vector<int>& whole = next.phase->nodeOfWhole();
    for (std::size_t node = 0; node < whole.size(); ++node)
      if (const auto found = byWholeNode.find(whole[node]); found != byWholeNode.end()) all.push_back({GlobalId(node), found->second});
  }
  broadcast(next.run.comm(), all);
  return all;
}

}  // namespace

/// Vectors at the nodes of all subdomains; zero where there is none. Collective.
std::vector<Vector> PhaseChange::onMeshes(const SceneParts& next, const std::map<int, Point>& byWholeNode) const {
  const std::vector<NodeVector> all = inPhase(next, byWholeNode);
  std::vector<Vector> values;
  for (const SubdomainMesh& mesh : next.cut.meshes) {
    Vector& own = values.emplace_back(Vector::Zero(Eigen::Index(mesh.nodes()) * mesh.dimension));
    for (int node = 0; node < mesh.nodes(); ++node) {
      const GlobalId wanted = mesh.globalNodes[static_cast<std::size_t>(node)];
      const auto at = std::lower_bound(all.begin(), all.end(), wanted, [](const NodeVector& a, GlobalId b) { return a.node < b; });
      if (at == all.end() || at->node != wanted) continue;
      for (int k = 0; k < mesh.dimension; ++k) own[Eigen::Index(node) * mesh.dimension + k] = at->value[static_cast<std::size_t>(k)];
    }
  }
  return values;
}

/// Results of bodies on the path, for the bodies and regions that still exist.
void PhaseChange::takeBodies(const Scene& next) {
  const std::vector<std::string>& bodies = next.model.bodies;
  path_.carried.clear();
  for (const std::string& body : bodies) {
    const auto found = carried_.find(body);
    path_.carried.push_back(found == carried_.end() ? BodyForces() : found->second);
  }
  path_.safety.clear();
  const std::vector<std::pair<std::string, std::string>> regions = regionNames(next.settings().sublist("Bodies"));
  for (auto& [name, least] : safety_) {
    const auto body = std::find(bodies.begin(), bodies.end(), name.first);
    const auto region = std::find(regions.begin(), regions.end(), name);
    if (body == bodies.end() || (least.region >= 0 && region == regions.end())) continue;
    path_.safety.push_back(least);
    path_.safety.back().body = static_cast<int>(body - bodies.begin());
    if (least.region >= 0) path_.safety.back().region = static_cast<int>(region - regions.begin());
  }
}

void PhaseChange::goOn(SceneParts& next) {
  const Comm& comm = next.run.comm();
  takePairs(next);
  broadcast(comm, path_.pairs);
  struct StatusOf {
    int id;
    ContactState state;
  };
  std::vector<StatusOf> states;
  for (const auto& [id, state] : start_.status) states.push_back({id, state});
  broadcast(comm, states);
  for (const StatusOf& one : states) start_.status[one.id] = one.state;
  start_.displacement = onMeshes(next, displacement_);
  takeBodies(next.scene);
  next.path->goOnFrom(path_);
  if (next.sinceTime()) next.reference = onMeshes(next, reference_);
  addPending(next);
  addRelease(next);
}

void PhaseChange::addPending(SceneParts& next) const {
  for (const auto& [release, byWholeNode] : pending_) {
    std::map<GlobalId, Point> forces;
    for (const NodeVector& one : inPhase(next, byWholeNode)) forces[one.node] = one.value;
    next.path->release(release, std::move(forces), next.scene.model);
  }
}

/// Forces by which the parts removed now held the others: what is missing to the equilibrium of the others.
void PhaseChange::addRelease(SceneParts& next) const {
  const Comm& comm = next.run.comm();
  const double begin = next.path->time();
  next.path->setTime(begin, next.scene.model, next.cut.meshes, next.constraints);
  std::vector<const SubdomainMesh*> meshes;
  for (const SubdomainMesh& mesh : next.cut.meshes) meshes.push_back(&mesh);
  const std::vector<PairResult> pairs =
      pairResults(comm, meshes, start_.displacement, comm.getRank() == 0 ? forcesOf(path_, start_) : std::vector<PairForce>());
  const SeamExchange seams(comm, next.cut.meshes);
  const NodalForces forces =
      nodalForces(comm, {next.cut.meshes, next.scene.model, start_.displacement, pairs, next.cut.whole.pieces}, seams);
  std::vector<NodeVector> mine;
  double largest[2] = {0.0, 0.0}, most[2];  // imbalance, internal force
  for (std::size_t s = 0; s < next.cut.meshes.size(); ++s) {
    const SubdomainMesh& mesh = next.cut.meshes[s];
    const NodalRows rows{mesh.dimension};
    std::map<int, const NodeRule*> ruleOf;
    for (const NodeRule& rule : mesh.rules) ruleOf[rule.node] = &rule;
    for (int node = 0; node < mesh.nodes(); ++node) {
      if (!counts(mesh, node)) continue;
      const auto sums = forces.nodes[s].col(node);
      NodeVector lacking{mesh.globalNodes[static_cast<std::size_t>(node)], {0, 0, 0}};
      for (int k = 0; k < mesh.dimension; ++k) {
        const double internal = sums[rows.internal() + k];
        lacking.value[static_cast<std::size_t>(k)] = internal - sums[rows.applied() + k] - sums[rows.contact() + k];
        largest[1] = std::max(largest[1], std::abs(internal));
      }
      const auto rule = ruleOf.find(node);
      lacking.value = freePart(rule == ruleOf.end() ? nullptr : rule->second, lacking.value, mesh.dimension);
      largest[0] = std::max(largest[0], norm(lacking.value));
      mine.push_back(lacking);
    }
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, 2, largest, most);
  if (most[0] <= kBalancedForces * most[1]) return;
  std::map<GlobalId, Point> released;
  for (const NodeVector& one : joinEverywhere(comm, mine))
    if (norm(one.value) > kReleased * most[0]) released[one.node] = one.value;
  next.path->release(next.plan->phases.release(begin), std::move(released), next.scene.model);
}

}  // namespace suture
