#include <suture/base/Errors.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/simulation/Restart.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>

#include <map>
#include <utility>
#include <vector>

namespace suture {

namespace {

std::string pathTime(double time) { return "t = " + realText(time); }

}  // namespace

PathState pathStateOf(const SceneParts& parts, const std::vector<PairResult>& pairs) {
  PathState state = parts.path->state(pairs);
  if (const auto since = parts.sinceTime()) state.since = *since, state.reference = parts.reference;
  if (!parts.plan) return state;
  state.changes = parts.plan->phases.changesBefore(parts.path->time());
  for (const auto& [pair, gap] : parts.fits) state.fits.push_back({pair, gap});
  for (const Load& load : parts.scene.model.loads) {
    const Release* release = parts.path->releaseOf(load);
    if (!release || release->remaining(parts.path->time()) == 0.0) continue;
    for (const auto& [node, force] : load.forces) state.released.push_back({release->begin(), node, force});
  }
  return state;
}

void restore(SceneParts& parts, const PathState& state) {
  parts.reference = state.reference;
  std::map<double, std::map<GlobalId, Point>> forces;
  for (const PathState::Released& one : state.released) forces[one.removal][one.node] = one.force;
  for (auto& [removal, ofNodes] : forces) parts.path->release(parts.plan->phases.release(removal), std::move(ofNodes), parts.scene.model);
}

void requireReference(const SceneParts& parts, const PathState& state) {
  const double since = parts.scene.settings().sublist("Output").get<double>("Displacements Since"), time = parts.path->time();
  if (since > 0.0 && time > since && state.since != since)
    throw InputError("Output/Displacements Since", "the checkpoint is at " + pathTime(time) + ", after " + pathTime(since) +
                                                       ", and has no displacements of that time; run the scene from its beginning");
}

Solution lastSolution(SceneParts& parts, const Start& start, const PathState& state) {
  const Comm& comm = parts.run.comm();
  requireReference(parts, state);
  const double time = parts.path->time();
  if (parts.sinceTime() == time) parts.reference = start.displacement;
  std::vector<PairForce> forces;
  const auto stateOf = [&](int pair) {
    const auto found = start.status.find(pair);
    return found != start.status.end() ? found->second : ContactState();
  };
  if (comm.getRank() == 0)
    for (const PathState::Pair& pair : state.pairs) forces.push_back({pair.id, stateOf(pair.id), pair.force, pair.tangential});
  parts.path->setTime(time, parts.scene.model, parts.cut.meshes, parts.constraints);
  std::vector<const SubdomainMesh*> meshes;
  for (const SubdomainMesh& mesh : parts.cut.meshes) meshes.push_back(&mesh);
  Solution solution;
  solution.displacement = start.displacement;
  solution.converged = true;
  solution.pairs = pairResults(comm, meshes, solution.displacement, forces);
  solution.energy = parts.path->rows.back().energy;
  return solution;
}

std::string continuesText(const SceneParts& parts) {
  return "continues at " + pathTime(parts.path->time()) + ", after load step " + std::to_string(parts.path->rows.size());
}

void requireSameChanges(const PathState& state, const Phases* phases, const std::string& path) {
  if (state.empty()) return;
  const double time = state.rows.back().time;
  const std::string expected = phases ? phases->changesBefore(time) : Phases::kNoChange,
                    found = state.changes.empty() ? Phases::kNoChange : state.changes;
  if (found != expected)
    throw InputError(path,
                     "a checkpoint at " + pathTime(time) + " after other changes: " + found + "; expected, as in this scene: " + expected);
}

void requireSameMotion(const PathState& state, bool movesFar, const std::string& path) {
  if ((state.moved != nullptr) == movesFar) return;
  throw InputError(path, movesFar ? "a checkpoint without bodies that move far; expected one of a scene with Motion = Moving"
                                  : "a checkpoint of bodies that move far; expected a scene with Motion = Moving");
}

}  // namespace suture
