#include <suture/base/Collective.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/simulation/JudgeStage.hpp>
#include <suture/simulation/Restart.hpp>
#include <suture/simulation/SceneParts.hpp>
#include <suture/simulation/SoftenedContacts.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <algorithm>
#include <cmath>
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

void SceneParts::fitPairs() {
  for (ContactPair& pair : constraints.pairs)
    if (const auto fit = fits.find(pair.id); fit != fits.end()) pair.gap += fit->second;
}

std::optional<double> SceneParts::sinceTime() const {
  const double time = scene.settings().sublist("Output").get<double>("Displacements Since");
  return time > 0.0 && path && path->time() >= time ? std::optional<double>(time) : std::nullopt;
}

std::vector<Vector> SceneParts::comparable(const std::vector<Vector>& displacement) const {
  std::vector<Vector> all = displacement;
  for (std::size_t s = 0; drawn && s < all.size(); ++s)
    for (Eigen::Index i = 0; i < all[s].size(); ++i) all[s][i] = cut.meshes[s].fromDrawn(displacement[s], i);
  return all;
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

namespace {

bool isStressed(const ElasticModel& model) {
  return std::any_of(model.loads.begin(), model.loads.end(), [](const Load& load) { return load.kind == Load::Kind::InitialStress; });
}

}  // namespace

std::vector<BodyForces> inSituForces(const SceneParts& parts) {
  const ElasticModel& model = parts.scene.model;
  if (!isStressed(model)) return {};
  const std::size_t bodies = model.bodies.size();
  std::vector<double> mine(3 * bodies, 0.0), all(3 * bodies);  // by body: size, integrals of stress and of stress over stiffness
  collectively(parts.run.comm(), "finding the initial stresses", [&] {
    for (const SubdomainMesh& mesh : parts.cut.meshes) {
      const Matrix stresses = elementStresses(mesh, model, Vector::Zero(Eigen::Index(mesh.nodes()) * mesh.dimension));
      for (int e = 0; e < mesh.elements(); ++e) {
        const double size = std::abs(signedSize(mesh, e)), stress = size * stresses.row(e).norm();
        double* sums = mine.data() + 3 * static_cast<std::size_t>(mesh.body);
        sums[0] += size, sums[1] += stress, sums[2] += stress / model.materialOf(mesh, e, mesh.body).young;
      }
    }
  });
  Teuchos::reduceAll(parts.run.comm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  std::vector<BodyForces> forces(bodies);
  for (std::size_t b = 0; b < bodies; ++b) {
    const double length = std::pow(all[3 * b], 1.0 / model.dimension);
    if (!(length > 0.0)) continue;
    forces[b].force = all[3 * b + 1] / length;
    forces[b].deformation = all[3 * b + 2] * length / all[3 * b];
  }
  return forces;
}

std::optional<Start> inSituStart(const SceneParts& parts) {
  if (!isStressed(parts.scene.model) || !parts.scene.laws.restrictSliding()) return std::nullopt;
  Start start;
  start.carried = inSituForces(parts);
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
  parts.meanSupports.removeFrom(meshes);
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
          std::nullopt,
          joined};
}

void writeState(const SceneParts& parts, const Solution& solution) {
  writeCheckpoint(parts.run.comm(), checkpointIn(parts.run.folder()), parts.cut.whole.hash, parts.cut.meshes, solution,
                  parts.followsPath() ? pathStateOf(parts, solution.pairs) : PathState());
}

std::string checkpointIn(const std::string& folder) { return (std::filesystem::path(folder) / "checkpoint.h5").string(); }

}  // namespace suture
