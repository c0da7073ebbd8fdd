#include <suture/answer/error/ExactErrors.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/elasticity/LockingNotes.hpp>
#include <suture/elasticity/loads/LoadList.hpp>
#include <suture/elasticity/loads/ResolveLoads.hpp>
#include <suture/motion/TakeOutLift.hpp>
#include <suture/report/Checkpoint.hpp>
#include <suture/report/Report.hpp>
#include <suture/report/Summary.hpp>
#include <suture/report/answers/Probes.hpp>
#include <suture/report/answers/SingularNotes.hpp>
#include <suture/report/answers/Transmissions.hpp>
#include <suture/simulation/JudgeStage.hpp>
#include <suture/simulation/LoadControl.hpp>
#include <suture/simulation/NestedLevels.hpp>
#include <suture/simulation/PathFollower.hpp>
#include <suture/simulation/PhaseChange.hpp>
#include <suture/simulation/ReadStage.hpp>
#include <suture/simulation/RepeatedSolver.hpp>
#include <suture/simulation/Restart.hpp>
#include <suture/simulation/SoftenedContacts.hpp>
#include <suture/simulation/Stages.hpp>
#include <suture/simulation/accuracy/ForceIntervals.hpp>
#include <suture/simulation/moving/MotionCheck.hpp>
#include <suture/simulation/moving/MovingSolver.hpp>
#include <suture/solver/MemoryEstimate.hpp>
#include <suture/solver/SolverSchema.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>

#include <filesystem>

namespace suture {

namespace {

/// Plan of a scene whose bodies are removed or placed on its path; null: there are none. Collective.
std::shared_ptr<const PhasePlan> planOf(const RunContext& run, const Scene& scene) {
  Phases phases(scene);
  if (phases.empty()) return nullptr;
  return timed(run.timers(), "read", [&] {
    auto mesh = std::make_shared<const Mesh>(readBodies(run.comm(), scene));
    return std::make_shared<const PhasePlan>(PhasePlan{std::move(phases), scene, std::move(mesh)});
  });
}

/// Parts of one phase of a plan. Collective.
std::unique_ptr<SceneParts> partsOfPhase(const RunContext& run, std::shared_ptr<const PhasePlan> plan, int number) {
  auto phase = std::make_unique<const PhaseScene>(run.comm(), plan->whole, plan->phases, number, plan->mesh);
  auto parts = std::make_unique<SceneParts>(run, phase->scene());
  parts->plan = std::move(plan);
  parts->phase = std::move(phase);
  parts->phaseNumber = number;
  return parts;
}

}  // namespace

MeshedScene read(RunContext run, Scene scene) {
  checkMotion(scene);
  if (scene.accuracy) run.monitor().beginLevel();
  if (std::shared_ptr<const PhasePlan> plan = planOf(run, scene)) return MeshedScene::of(partsOfPhase(run, std::move(plan), 0));
  return MeshedScene::of(std::make_unique<SceneParts>(std::move(run), std::move(scene)));
}

MeshedScene MeshedScene::of(std::unique_ptr<SceneParts> given) {
  MeshedScene result;
  result.parts_ = std::move(given);
  SceneParts& parts = *result.parts_;
  if (parts.scene.accuracy) parts.given = std::make_shared<const Scene>(parts.scene);
  result.method_ = makeMethod(parts.scene.settings(), !parts.scene.contacts.empty());
  parts.isWhole = result.method_->needsWholeMesh() || !isCut(parts.scene);
  if (!parts.isWhole) return result;
  timed(parts.run.timers(), "read", [&] {
    parts.mesh = readBodies(parts.run.comm(), parts.scene);
    parts.constraints = readConstraints(parts.run.comm(), parts.mesh, parts.scene);
    if (parts.given) parts.whole = std::make_shared<const Mesh>(parts.mesh);
  });
  return result;
}

PartitionedScene cut(MeshedScene meshed) {
  PartitionedScene result(std::move(meshed));
  SceneParts& parts = *result.parts_;
  const Comm& comm = parts.run.comm();
  if (movesFar(parts.scene)) collectivelyOnRoot(comm, "checking the motion of bodies", [&] { checkSupports(parts.scene, parts.mesh); });
  parts.cut = timed(parts.run.timers(), "partition", [&] { return cutMesh(comm, parts.scene, parts.mesh, parts.constraints); });
  parts.size = parts.cut.whole.size;
  if (movesFar(parts.scene)) parts.drawn = std::make_shared<const DrawnScene>(DrawnScene{parts.mesh, parts.constraints, parts.scene.model});
  resolveLoads(comm, parts.cut.meshes, parts.scene.model);
  if (parts.scene.steps.empty()) return result;
  parts.path = std::make_unique<LoadPath>(comm, parts.scene.steps, parts.cut.whole.prescribed);
  parts.path->setTime(parts.firstTime(), parts.scene.model, parts.cut.meshes, parts.constraints);
  return result;
}

namespace {

/// Refuses a scene without a solution, and finds auxiliary supports of bodies that mean displacements hold. Contact that holds a body may
/// open while the means are sought, so it does not count; with load steps it must, because forces of means are found only once. Collective.
MeanSupports supportsOf(const SceneParts& parts) {
  const MeanSupports::Where where = parts.scene.steps.empty() ? MeanSupports::Where::Everywhere : MeanSupports::Where::Needed;
  MeanSupports supports =
      MeanSupports::find(parts.run.comm(), parts.mesh, parts.constraints, parts.scene.model, parts.cut.partition.bodiesAreConnected, where);
  requireOneStep(parts.scene, supports);
  return supports;
}

/// Finds the amounts of controlled loads, and holds the nodes of auxiliary supports accordingly. Collective.
void findAmounts(SceneParts& parts) {
  const Vector held = controlLoads(parts.run.commPtr(), parts.scene, parts.meanSupports, parts.cut.meshes, parts.run.monitor());
  if (parts.meanSupports.empty()) return;
  parts.meanSupports.addTo(parts.cut.meshes, held);
  collectivelyOnRoot(parts.run.comm(), "adding supports", [&] { parts.meanSupports.addTo(parts.constraints, held); });
}

}  // namespace

CheckedScene check(PartitionedScene partitioned) {
  SceneParts& parts = *partitioned.parts_;
  const Comm& comm = parts.run.comm();
  const Scene& scene = parts.scene;
  timed(parts.run.timers(), "partition", [&] {
    checkElements(comm, parts.cut.meshes, scene.model);
    if (parts.isWhole) parts.meanSupports = supportsOf(parts);
  });
  OverlapNotes overlaps = timed(parts.run.timers(), "partition", [&] { return OverlapNotes(comm, parts.cut.meshes, scene); });
  locateProbes(comm, parts.cut.meshes, scene.model.bodies, readProbes(scene.settings(), scene.model.bodies));
  readTransmissions(scene.settings());
  checkExactSolution(comm, parts.cut.meshes, scene.model, scene.settings().sublist("Contact"));
  const double limit = scene.settings().sublist("Subdomain").get<double>("Memory Limit");
  parts.megabytes = checkMemory(comm, partitioned.method_->megabytes(comm, parts.cut.meshes, parts.size.dofs), limit);
  return {std::move(partitioned), std::move(overlaps)};
}

PreparedScene prepare(CheckedScene checked) {
  PreparedScene result(std::move(checked));
  result.prepareMethod();
  return result;
}

void PreparedScene::prepareMethod() {
  SceneParts& parts = *parts_;
  Scene& scene = parts.scene;
  Timers& timers = parts.run.timers();
  if (hasControlledLoads(scene)) timed(timers, "control", [&] { findAmounts(parts); });
  if (!parts.path)
    parts.liftWork = timed(timers, "partition", [&] {
      return takeOutLift(parts.run.comm(), scene.model, parts.cut.meshes, parts.constraints, !scene.laws.restrictSliding());
    });
  parts.run.monitor().shiftEnergy(-parts.liftWork);
  if (parts.drawn) return;  // each round prepares its own method
  if (!method_->needsWholeMesh()) forget(parts.mesh, parts.constraints, parts.cut.partition);
  const bool isCoupled = scene.steps.empty() && parts.path;
  const bool changes = parts.followsPath() || isCoupled || !strictBarsOf(scene.settings()).empty();
  method_ = preparedMethod(parts, std::move(method_), changes);
  parts.size.interfaceDofs = method_->interfaceUnknowns();
}

PreparedScene PreparedScene::nextPhase(const SceneParts& parts, const Solution& solution) {
  const int number = parts.phaseNumber + 1;
  PhaseChange change(parts, solution);
  MeshedScene meshed = MeshedScene::of(partsOfPhase(parts.run, parts.plan, number));
  change.fit(*meshed.parts_, parts.plan->phases.absent(number - 1));
  PartitionedScene partitioned = cut(std::move(meshed));
  SceneParts& next = *partitioned.parts_;
  change.goOn(next);
  next.path->setTime(next.firstTime(), next.scene.model, next.cut.meshes, next.constraints);
  PreparedScene prepared = prepare(check(std::move(partitioned)));
  prepared.start_ = change.start();
  prepared.restart_ = change.path();
  return prepared;
}

void PreparedScene::remark() const {
  RunMonitor& monitor = parts_->run.monitor();
  const auto add = [&](const std::vector<std::string>& notes) {
    for (const std::string& note : notes) monitor.note(note);
  };
  const Scene& scene = parts_->scene;
  add(scene.file.notes);
  add(parts_->cut.partition.notes);
  add(lockingNotes(scene.model));
  add(loadNotes(scene.model));
  add(looseTolerances(scene.settings()));
  add(overlaps_->drawn(scene));
}

void PreparedScene::startFrom(const std::string& restart) {
  SceneParts& parts = *parts_;
  if (!restart.empty() && parts.scene.accuracy)
    throw InputError("--restart", restart + " belongs to one mesh, but Accuracy/Error makes a sequence of meshes; leave out one of them");
  if (restart.empty() && parts.drawn) return;
  if (!restart.empty() && parts.plan) {
    goOnInPhase(restart);
    return;
  }
  if (!restart.empty()) {
    start_ = readCheckpoint(parts.run.comm(), restart, parts.cut.whole.hash, parts.cut.meshes, &restart_);
    requireSameChanges(restart_, nullptr, restart);
    requireSameMotion(restart_, parts.drawn != nullptr, restart);
    restore(parts, restart_);
  } else if (!parts.scene.levels.empty() && method_->takesStart())
    start_ = startFromLevels(parts.run.commPtr(), parts.scene, parts.cut.meshes, parts.run.monitor());
  else if (method_->takesStart() && parts.scene.settings().sublist("Outer Solver").get<std::string>("Start") == "Nested")
    throw InputError("Outer Solver/Start", "Nested, but the scene has no coarser levels (Scene::levels)");
}

/// Replaces the scene by another one.
void PreparedScene::adopt(PreparedScene other) {
  parts_ = std::move(other.parts_);
  method_ = std::move(other.method_);
  overlaps_.emplace(std::move(*other.overlaps_));
  start_ = std::move(other.start_);
  restart_ = std::move(other.restart_);
}

/// Replaces the scene by the phase in which a checkpoint was written, or by the next one if it was written at its end.
void PreparedScene::goOnInPhase(const std::string& restart) {
  const RunContext run = parts_->run;
  const std::shared_ptr<const PhasePlan> plan = parts_->plan;
  PathState state = readPath(run.comm(), restart);
  requireSameChanges(state, &plan->phases, restart);
  const double time = state.rows.back().time;
  const int number = plan->phases.phaseAt(time);
  method_.reset();
  MeshedScene meshed = MeshedScene::of(partsOfPhase(run, plan, number));
  for (const PathState::Fit& fit : state.fits) meshed.parts_->fits[fit.pair] = fit.gap;
  meshed.parts_->fitPairs();
  PartitionedScene partitioned = cut(std::move(meshed));
  SceneParts& parts = *partitioned.parts_;
  Start start = readCheckpoint(run.comm(), restart, parts.cut.whole.hash, parts.cut.meshes, &state);
  restore(parts, state);
  if (time < plan->phases.end(number) || number + 1 == plan->phases.count()) {
    adopt(prepare(check(std::move(partitioned))));
    start_ = std::move(start);
    restart_ = std::move(state);
    return;
  }
  parts.path->goOnFrom(state);
  run.monitor().note(continuesText(parts));
  adopt(nextPhase(parts, lastSolution(parts, start, state)));
}

namespace {

/// Writes checkpoints as often as the settings request.
Method::Keep checkpoints(const SceneParts& parts) {
  const double every = 60.0 * parts.scene.settings().sublist("Output").get<double>("Checkpoint Every");
  if (every <= 0.0 || !parts.run.writes()) return {};
  return [&parts, every, last = Timers::now()](const std::function<Solution()>& solution) mutable {
    const Comm& comm = parts.run.comm();
    int due = comm.getRank() == 0 && Timers::now() - last >= every;
    broadcastBytes(comm, &due, sizeof due);
    if (due == 0) return;
    writeState(parts, solution());
    last = Timers::now();
  };
}

}  // namespace

SolvedScene solve(PreparedScene prepared) {
  std::optional<Start> start = std::move(prepared.start_);
  if (!start && !prepared.parts_->drawn && prepared.method_->takesStart()) start = inSituStart(*prepared.parts_);
  PathState restart = std::move(prepared.restart_);
  SolvedScene result(std::move(prepared));
  if (result.parts_->followsPath())
    result.followPath(std::move(start), std::move(restart));
  else
    result.solveAtOnce(start);
  return result;
}

void SolvedScene::solveAtOnce(const std::optional<Start>& start) {
  const RunContext& run = parts_->run;
  solution_ = method_->solve(run.monitor(), run.timers(), start ? &*start : nullptr, checkpoints(*parts_));
  solution_.energy -= parts_->liftWork;
}

void SolvedScene::followPath(std::optional<Start> start, PathState restart) {
  int outer = 0, pcg = 0, other = 0;  // counts of earlier phases
  for (;;) {
    std::unique_ptr<StepSolver> solver;
    if (parts_->drawn)
      solver = std::make_unique<MovingSolver>(*parts_, parts_->drawn);
    else
      solver = std::make_unique<RepeatedSolver>(*parts_, std::move(method_), std::move(start));
    PathFollower follower(*parts_, *solver, std::move(restart));
    solution_ = follower.follow();
    solution_.iterations += outer;
    solution_.pcgTotal += pcg;
    solution_.otherApplications += other;
    method_ = solver->takeMethod();
    doubts_.add(follower.doubts());
    unfinished_ = follower.unfinished();
    if (!unfinished_.empty() || !parts_->plan || parts_->phaseNumber + 1 == parts_->plan->phases.count()) break;
    outer = solution_.iterations, pcg = solution_.pcgTotal, other = solution_.otherApplications;
    restart = enterNextPhase(start);
  }
  isJudged_ = !parts_->path->rows.empty();  // step by step
}

/// Replaces the scene by its next phase, with the state at the end of the present one. \param start  receives the start of its solver
PathState SolvedScene::enterNextPhase(std::optional<Start>& start) {
  method_.reset();
  PreparedScene prepared = PreparedScene::nextPhase(*parts_, solution_);
  parts_ = std::move(prepared.parts_);
  method_ = std::move(prepared.method_);
  overlaps_.emplace(std::move(*prepared.overlaps_));
  start = std::move(prepared.start_);
  return std::move(prepared.restart_);
}

JudgedScene judge(SolvedScene solved) {
  SceneParts& parts = *solved.parts_;
  Solution& solution = solved.solution_;
  const Comm& comm = parts.run.comm();
  const std::vector<std::string> strictBars = strictBarsOf(parts.scene.settings());
  std::unique_ptr<Method> method = std::move(solved.method_);  // kept for strict error bars only
  const Subdomains own = method && strictBars.empty() ? method->takeSubdomains() : Subdomains();
  const Subdomains& subdomains = method && !strictBars.empty() ? method->subdomains() : own;
  if (strictBars.empty()) method.reset();
  if (!solved.isJudged_) judgeSolution(parts, subdomains, solution);
  boundError(comm, parts.cut.meshes, subdomains, parts.scene, parts.cut.whole.parts, parts.followsPath(), solution, parts.run.timers());
  // Once per run: load steps and coupled solves share the mesh.
  estimateMesh(comm, parts.cut.meshes, subdomains, parts.scene, parts.path.get(), solution, parts.run.timers());
  const std::optional<EntryResults> joined = entryResults(parts, solution);
  const std::vector<ContactPiece>& pieces = joined ? joined->pieces : parts.cut.whole.pieces;
  const Solution& shown = joined ? joined->solution : solution;
  const auto add = [&](const std::vector<std::string>& notes) {
    for (const std::string& note : notes) parts.run.monitor().note(note);
  };
  add(meshNotes(solution));
  add(pressureNotes(comm, pieces, shown));
  add(plausibilityNotes(comm, parts.cut.meshes, parts.scene.model, pieces, shown));
  if (!parts.followsPath()) solved.doubts_.add(solution.verification);
  add(solved.doubts_.warnings());
  if (solution.converged)
    add(timed(parts.run.timers(), "verify", [&] { return solved.overlaps_->added(comm, parts.scene, solution.displacement); }));
  add(singularNotes(comm, parts.cut.meshes, parts.scene.model, shown));
  if (wantsErrorBars(parts.scene.settings()))
    timed(parts.run.timers(), "estimate", [&] { findErrorBars(comm, parts.cut.meshes, parts.scene, pieces, shown, solution); });
  if (!strictBars.empty() && method) solution.intervals = ForceIntervals(parts, method, solution).find(strictBars);
  add(safetyNotes(parts.scene.model, solution.safety));
  if (joined) add(overclosureNotes(parts.scene.lines, shown, parts.scene.model.dimension));
  return JudgedScene(std::move(solved));
}

ExitCode endingOf(const Solution& solution, const std::string& unfinished) {
  return unfinished.empty() && solution.isValid() ? ExitCode::Done : solution.stopped ? ExitCode::Stopped : ExitCode::Numerical;
}

ExitCode JudgedScene::ending() const {
  const ExitCode code = endingOf(solution_, unfinished_);
  return code == ExitCode::Done && accuracy_ && !accuracy_->isMet() ? ExitCode::Numerical : code;
}

Run JudgedScene::asRun(const Invocation& invocation) const {
  Run run = runOf(*parts_, solution_, invocation);
  run.accuracy = accuracy_;
  return run;
}

std::string JudgedScene::summary(const Invocation& invocation) const {
  const Run run = asRun(invocation);
  return summaryText(run, runFigures(run), ending());
}

RunResult JudgedScene::report(const Invocation& invocation) const {
  const RunContext& context = parts_->run;
  if (!context.writes()) throw InternalError("report() without an output folder: call RunContext::writeInto() first");
  giveBackFreedMemory();  // for the files
  const ExitCode code = ending();
  const Parameters& output = parts_->scene.settings().sublist("Output");
  // First, because a stop request must be honoured before the remaining steps.
  const bool isKept = parts_->followsPath() && !parts_->path->rows.empty();  // by the last step
  if (!isKept && !parts_->drawn && (endingOf(solution_, unfinished_) != ExitCode::Done || output.get<bool>("Checkpoint")))
    writeState(*parts_, solution_);
  const Run run = asRun(invocation);
  const Written written = writeReport(run, code);
  if (!isKept && code == ExitCode::Done && !output.get<bool>("Checkpoint") && output.get<double>("Checkpoint Every") > 0.0 &&
      context.comm().getRank() == 0) {
    std::error_code ignored;
    std::filesystem::remove(checkpointIn(context.folder()), ignored);
  }
  if (std::ostream* console = context.monitor().console()) printFooter(*console, run, written.figures);
  return {code, solution_.failure, written.summary};
}

void JudgedScene::writeTo(const std::string& folder) const {
  const RunFolder locked(parts_->run.comm(), folder);
  Run run = asRun();
  run.folder = folder;
  if (!run.steps.empty() && wantsFields(parts_->scene.settings())) writeStepFields(run, run.steps);
  writeReport(run, ending());
}

std::vector<Matrix> JudgedScene::nodalStresses() const {
  if (wantsNodalStresses(parts_->scene.settings())) return solution_.nodalStresses;
  return recoveredStresses(parts_->run.comm(), meshes(), parts_->scene.model, solution_);
}

std::vector<Probe> JudgedScene::probes() const { return readProbes(parts_->scene.settings(), parts_->scene.model.bodies); }

std::vector<std::vector<ProbeValue>> JudgedScene::valuesAt(const std::vector<Probe>& probes, const std::vector<Matrix>& nodal) const {
  return probeValues(runOf(*parts_, solution_), probes, nodal);
}

}  // namespace suture
