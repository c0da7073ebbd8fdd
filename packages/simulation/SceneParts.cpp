#include <suture/base/Collective.hpp>
#include <suture/simulation/JudgeStage.hpp>
#include <suture/simulation/SceneParts.hpp>
#include <suture/simulation/SoftenedContacts.hpp>

#include <algorithm>
#include <filesystem>

namespace suture {

CutScene SceneParts::forMethod(bool changes) const {
  const bool needsLaw = !scene.model.exact.empty() || wantsErrorEstimate(scene.settings());
  return {run.commPtr(),    mesh,        constraints,    cut.partition, cut.meshes, scene.model,
          scene.settings(), scene.kinds, scene.contacts, scene.laws,    needsLaw,   changes};
}

std::vector<double> SceneParts::times() const {
  std::vector<double> all = scene.steps.times();
  if (plan) all.erase(std::upper_bound(all.begin(), all.end(), plan->phases.end(phaseNumber)), all.end());
  return all;
}

std::optional<double> SceneParts::sinceTime() const {
  const double time = scene.settings().sublist("Output").get<double>("Displacements Since");
  return time > 0.0 && path && path->time() >= time ? std::optional<double>(time) : std::nullopt;
}

double SceneParts::firstTime() const {
  const std::vector<double>& all = scene.steps.times();
  return *std::upper_bound(all.begin(), all.end() - 1, begin());
}

std::unique_ptr<Method> preparedMethod(const SceneParts& parts, std::unique_ptr<Method> method, bool changes) {
  if (!method) method = makeMethod(parts.scene.settings(), !parts.scene.contacts.empty());
  method->prepare(parts.forMethod(changes), parts.run.timers());
  return method;
}

Start startOf(const Comm& comm, const Solution& solution) {
  struct PairStatusOf {
    int id;
    ContactState state;
  };
  std::vector<PairStatusOf> states;
  for (const PairResult& pair : solution.pairs) states.push_back({pair.id, pair.state});
  broadcast(comm, states);
  Start start{solution.displacement, {}};
  for (const PairStatusOf& pair : states) start.status[pair.id] = pair.state;
  return start;
}

std::optional<Start> inSituStart(const SceneParts& parts) {
  const std::vector<Load>& loads = parts.scene.model.loads;
  const bool isStressed = std::any_of(loads.begin(), loads.end(), [](const Load& load) { return load.kind == Load::Kind::InitialStress; });
  if (!isStressed || !parts.scene.laws.restrictSliding()) return std::nullopt;
  Start start;
  for (const SubdomainMesh& mesh : parts.cut.meshes) {
    start.displacement.push_back(Vector::Zero(Eigen::Index(mesh.nodes()) * mesh.dimension));
    for (const ContactRow& row : mesh.contactRows) start.status[row.pair.id] = parts.scene.laws.of(row.pair.line).pressed();
  }
  return start;
}

void judgeSolution(SceneParts& parts, const Subdomains& subdomains, Solution& solution) {
  const Comm& comm = parts.run.comm();
  Timers& timers = parts.run.timers();
  std::vector<SubdomainMesh>& meshes = parts.cut.meshes;
  const std::vector<ContactPiece>& pieces = parts.cut.whole.pieces;
  const Scene& scene = parts.scene;
  const LoadPath* path = parts.path.get();
  timed(timers, "verify", [&] { settleMotions(comm, meshes, pieces, scene, path, solution, parts.run.monitor()); });
  findErrors(comm, meshes, scene, solution, timers);
  timed(timers, "verify", [&] { verifySolution(comm, meshes, pieces, subdomains, scene, path, solution); });
  timed(timers, "verify", [&] { findAnswers(comm, meshes, scene, solution); });
}

std::optional<EntryResults> entryResults(const SceneParts& parts, const Solution& solution) {
  if (parts.scene.lines.empty()) return std::nullopt;
  return resultsOfEntries(parts.scene.lines, solution, parts.cut.whole.pieces, parts.size);
}

Run runOf(const SceneParts& parts, const Solution& solution, const Invocation& invocation) {
  const Solution* results = &solution;
  const std::vector<ContactPiece>* pieces = &parts.cut.whole.pieces;
  const ProblemSize* size = &parts.size;
  std::shared_ptr<const EntryResults> joined;
  if (std::optional<EntryResults> own = entryResults(parts, solution)) {
    joined = std::make_shared<const EntryResults>(*std::move(own));
    results = &joined->solution;
    pieces = &joined->pieces;
    size = &joined->size;
  }
  return {parts.run.comm(),
          parts.plan ? parts.plan->whole.file : parts.scene.file,
          parts.scene.model,
          *pieces,
          parts.cut.meshes,
          *size,
          *results,
          parts.run.monitor(),
          parts.run.timers(),
          parts.meshHash(),
          invocation,
          parts.run.folder(),
          parts.cut.whole.conditions,
          parts.scene.entries(),
          parts.path ? parts.path->rows : std::vector<StepRow>(),
          parts.contactsOfPath(),
          joined};
}

void writeState(const SceneParts& parts, const Solution& solution) {
  writeCheckpoint(parts.run.comm(), checkpointIn(parts.run.folder()), parts.cut.whole.hash, parts.cut.meshes, solution,
                  parts.followsPath() ? parts.path->state(solution.pairs) : PathState());
}

std::string checkpointIn(const std::string& folder) { return (std::filesystem::path(folder) / "checkpoint.h5").string(); }

}  // namespace suture
