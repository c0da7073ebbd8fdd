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
#include <suture/report/Units.hpp>
#include <suture/report/answers/Probes.hpp>
#include <suture/report/answers/SingularNotes.hpp>
#include <suture/simulation/JudgeStage.hpp>
#include <suture/simulation/LoadControl.hpp>
#include <suture/simulation/NestedLevels.hpp>
#include <suture/simulation/ReadStage.hpp>
#include <suture/simulation/Simulation.hpp>
#include <suture/solver/MemoryEstimate.hpp>
#include <suture/solver/SolverSchema.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>

#include <filesystem>
#include <set>

namespace suture {

Simulation::Simulation(const CommPtr& comm, Scene scene, RunMonitor& monitor, Timers& timers)
    : comm_(comm),
      scene_(std::move(scene)),
      monitor_(monitor),
      timers_(timers),
      method_(makeMethod(scene_.settings(), !scene_.contacts.empty())),
      isWhole_(method_->needsWholeMesh() || !isCut(scene_)) {}

Simulation::Simulation(const CommPtr& comm, Scene scene, std::unique_ptr<Silence> silence)
    : Simulation(comm, std::move(scene), silence->monitor, silence->timers) {
  silence_ = std::move(silence);
}

Simulation::Simulation(const CommPtr& comm, Scene scene) : Simulation(comm, std::move(scene), std::make_unique<Silence>()) {}

void Simulation::writeInto(const std::string& folder) {
  folder_ = folder;
  output_ = std::make_unique<const RunFolder>(*comm_, folder);
}

const Solution& Simulation::solve() {
  if (order_.has(StageOrder::Judged)) return solution_;
  if (isCoupled()) throw InternalError("solve() on a coupled scene: call solveAgain()");
  read();
  cut();
  check();
  prepare();
  remark();
  start();
  iterate();
  judge();
  return solution_;
}

void Simulation::read() {
  order_.make(StageOrder::Nothing, StageOrder::Read, "read", [&] {
    if (!isWhole_) return;
    mesh_ = timed(timers_, "read", [&] { return readBodies(*comm_, scene_); });
    constraints_ = timed(timers_, "read", [&] { return readConstraints(*comm_, mesh_, scene_); });
  });
}

void Simulation::cut() {
  order_.make(StageOrder::Read, StageOrder::Cut, "cut", [&] { cutScene(); });
}

void Simulation::cutScene() {
  cut_ = timed(timers_, "partition", [&] { return cutMesh(*comm_, scene_, mesh_, constraints_); });
  size_ = cut_.whole.size;
  resolveLoads(*comm_, cut_.meshes, scene_.model);
  if (scene_.steps.empty()) return;
  path_ = std::make_unique<LoadPath>(*comm_, scene_.steps, cut_.whole.prescribed);
  path_->setTime(scene_.steps.times().front(), scene_.model, cut_.meshes, constraints_);
}

namespace {
std::set<int> linesOfGivenGaps(const Scene& scene) {
  std::set<int> lines;
  const Parameters& contacts = scene.settings().sublist("Contact");
  for (std::size_t line = 0; line < scene.contacts.size(); ++line)
    if (contacts.sublist(scene.contacts[line]).isParameter("Initial Gap")) lines.insert(static_cast<int>(line));
  return lines;
}
}  // namespace

void Simulation::check() {
  order_.make(StageOrder::Cut, StageOrder::Checked, "check", [&] { checkScene(); });
}

void Simulation::checkScene() {
  timed(timers_, "partition", [&] {
    checkElements(*comm_, cut_.meshes, scene_.model);
    if (isWhole_) checkSolvability(*comm_, mesh_, constraints_, scene_.model, cut_.partition);
  });
  overlapSearch_ = timed(timers_, "partition", [&] {
    auto search =
        std::make_unique<const OverlapSearch>(cut_.meshes, static_cast<int>(scene_.model.bodies.size()), linesOfGivenGaps(scene_));
    drawnOverlaps_ = search->find(*comm_);
    return search;
  });
  locateProbes(*comm_, cut_.meshes, scene_.model.bodies, readProbes(scene_.settings(), scene_.model.bodies));
  checkExactSolution(*comm_, cut_.meshes, scene_.model, scene_.settings().sublist("Contact"));
  const double limit = scene_.settings().sublist("Subdomain").get<double>("Memory Limit");
  megabytes_ = checkMemory(*comm_, method_->megabytes(*comm_, cut_.meshes, size_.dofs), limit);
}

void Simulation::prepare() {
  order_.make(StageOrder::Checked, StageOrder::Prepared, "prepare", [&] { prepareMethod(); });
}

void Simulation::prepareMethod() {
  if (hasControlledLoads(scene_)) timed(timers_, "control", [&] { controlLoads(comm_, scene_, cut_.meshes, monitor_); });
  if (!path_)
    liftWork_ = timed(timers_, "partition",
                      [&] { return takeOutLift(*comm_, scene_.model, cut_.meshes, constraints_, !scene_.laws.restrictSliding()); });
  monitor_.shiftEnergy(-liftWork_);
  if (!method_->needsWholeMesh()) forget(mesh_, constraints_, cut_.partition);
  method_ = preparedMethod();
  size_.interfaceDofs = method_->interfaceUnknowns();
}

std::unique_ptr<Method> Simulation::preparedMethod() {
  std::unique_ptr<Method> method = method_ ? std::move(method_) : makeMethod(scene_.settings(), !scene_.contacts.empty());
  const bool needsLaw = !scene_.model.exact.empty() || wantsErrorEstimate(scene_.settings());
  method->prepare({comm_, mesh_, constraints_, cut_.partition, cut_.meshes, scene_.model, scene_.settings(), scene_.kinds, scene_.contacts,
                   scene_.laws, needsLaw, followsPath() || isCoupled()},
                  timers_);
  return method;
}

void Simulation::remark() {
  order_.require(StageOrder::Cut, StageOrder::Judged, "remark");
  for (const std::string& note : scene_.file.notes) monitor_.note(note);
  for (const std::string& note : cut_.partition.notes) monitor_.note(note);
  for (const std::string& note : lockingNotes(scene_.model)) monitor_.note(note);
  for (const std::string& note : loadNotes(scene_.model)) monitor_.note(note);
  for (const std::string& note : looseTolerances(scene_.settings())) monitor_.note(note);
  for (const Overlap& overlap : drawnOverlaps_)
    if (overlap.contact < 0) monitor_.note(inWords(overlap, true));  // contacts report their interference
}

std::string Simulation::inWords(const Overlap& overlap, bool drawn) const {
  return suture::inWords(overlap, scene_.model.bodies, scene_.contacts, drawn, unitsOf(scene_.settings()).length);
}

/// Warns of overlaps that the solution created or deepened by half.
void Simulation::noteOverlaps() {
  if (!solution_.converged || !overlapSearch_) return;
  const std::vector<Overlap> found = timed(timers_, "verify", [&] { return overlapSearch_->find(*comm_, solution_.displacement); });
  for (const Overlap& overlap : found) {
    const auto isSame = [&](const Overlap& drawn) {
      return std::minmax(drawn.body, drawn.into) == std::minmax(overlap.body, overlap.into) && drawn.contact == overlap.contact &&
             overlap.depth < 1.5 * drawn.depth;
    };
    if (std::none_of(drawnOverlaps_.begin(), drawnOverlaps_.end(), isSame)) monitor_.note(inWords(overlap, false));
  }
}

void Simulation::startFrom(Start start) {
  order_.require(StageOrder::Prepared, StageOrder::Prepared, "startFrom");
  start_ = std::move(start);
}

void Simulation::start(const std::string& restart) {
  order_.require(StageOrder::Prepared, StageOrder::Prepared, "start");
  if (!restart.empty())
    start_ = readCheckpoint(*comm_, restart, cut_.whole.hash, cut_.meshes, &restart_);
  else if (!scene_.levels.empty() && method_->takesStart())
    start_ = startFromLevels(comm_, scene_, cut_.meshes, monitor_);
  else if (method_->takesStart() && scene_.settings().sublist("Outer Solver").get<std::string>("Start") == "Nested")
    throw InputError("Outer Solver/Start", "Nested, but the scene has no coarser levels (Scene::levels)");
}

void Simulation::iterate() {
  if (isCoupled()) throw InternalError("iterate() on a coupled scene: call solveAgain()");
  order_.make(StageOrder::Prepared, StageOrder::Solved, "iterate", [&] {
    if (followsPath()) {
      followPath();
      return;
    }
    solution_ = method_->solve(monitor_, timers_, start_ ? &*start_ : nullptr, checkpoints());
    solution_.energy -= liftWork_;
    start_.reset();
  });
}

const Solution& Simulation::solution() const {
  if (!order_.has(StageOrder::Solved)) throw InternalError("solution() before iterate()");
  return solution_;
}

void Simulation::judge() {
  order_.make(StageOrder::Solved, StageOrder::Judged, "judge", [&] { judgeSolution(); });
}

void Simulation::judgeSolution() {
  const Subdomains subdomains = method_->takeSubdomains();
  method_.reset();
  if (!isJudged_ && (!followsPath() || path_->rows.empty())) judge(solution_, subdomains);
  // Once per run: load steps and coupled solves share the mesh.
  estimateMesh(*comm_, cut_.meshes, subdomains, scene_, path_.get(), solution_, timers_);
  const std::vector<ContactPiece>& pieces = cut_.whole.pieces;
  for (const std::string& note : meshNotes(solution_)) monitor_.note(note);
  for (const std::string& note : pressureNotes(*comm_, pieces, solution_)) monitor_.note(note);
  for (const std::string& note : plausibilityNotes(*comm_, cut_.meshes, scene_.model, pieces, solution_)) monitor_.note(note);
  if (!followsPath()) doubts_.add(solution_.verification);
  for (const std::string& note : doubts_.warnings()) monitor_.note(note);
  noteOverlaps();
  for (const std::string& note : singularNotes(*comm_, cut_.meshes, solution_)) monitor_.note(note);
}

void Simulation::judge(Solution& solution, const Subdomains& subdomains) {
  const std::vector<ContactPiece>& pieces = cut_.whole.pieces;
  timed(timers_, "verify", [&] { settleMotions(*comm_, cut_.meshes, pieces, scene_, path_.get(), solution, monitor_); });
  findErrors(*comm_, cut_.meshes, scene_, solution, timers_);
  timed(timers_, "verify", [&] { verifySolution(*comm_, cut_.meshes, pieces, subdomains, scene_, path_.get(), solution); });
  timed(timers_, "verify", [&] { findAnswers(*comm_, cut_.meshes, scene_, solution); });
}

ExitCode Simulation::ending() const {
  return unfinished_.empty() && solution_.isValid() ? ExitCode::Done : solution_.stopped ? ExitCode::Stopped : ExitCode::Numerical;
}

namespace {
std::string checkpointIn(const std::string& folder) { return (std::filesystem::path(folder) / "checkpoint.h5").string(); }
}  // namespace

void Simulation::writeState(const Solution& solution) const {
  writeCheckpoint(*comm_, checkpointIn(folder_), cut_.whole.hash, cut_.meshes, solution,
                  followsPath() ? path_->state(solution.pairs) : PathState());
}

Method::Keep Simulation::checkpoints() {
  const double every = 60.0 * scene_.settings().sublist("Output").get<double>("Checkpoint Every");
  if (every <= 0.0 || !output_) return {};
  return [this, every, last = Timers::now()](const std::function<Solution()>& solution) mutable {
    int due = comm_->getRank() == 0 && Timers::now() - last >= every;
    broadcastBytes(*comm_, &due, sizeof due);
    if (due == 0) return;
    writeState(solution());
    last = Timers::now();
  };
}

Run Simulation::run(const Solution& solution, const Invocation& invocation) const {
  return {*comm_,
          scene_.file,
          scene_.model,
          cut_.whole.pieces,
          cut_.meshes,
          size_,
          solution,
          monitor_,
          timers_,
          cut_.whole.hash,
          invocation,
          folder_,
          cut_.whole.conditions,
          scene_.contacts,
          path_ ? path_->rows : std::vector<StepRow>()};
}

std::string Simulation::summary(const Invocation& invocation) const {
  if (!isJudged_) order_.require(StageOrder::Judged, StageOrder::Judged, "summary");
  const Run run = this->run(solution_, invocation);
  return summaryText(run, runFigures(run), ending());
}

RunResult Simulation::report(const Invocation& invocation) {
  if (!output_) throw InternalError("report() without an output folder: call writeInto() first");
  if (!isJudged_) order_.require(StageOrder::Judged, StageOrder::Judged, "report");
  giveBackFreedMemory();  // for the files
  const ExitCode code = ending();
  const Parameters& output = scene_.settings().sublist("Output");
  // First, because a stop request must be honoured before the remaining steps.
  const bool isKept = followsPath() && !path_->rows.empty();  // by the last step
  if (!isKept && (code != ExitCode::Done || output.get<bool>("Checkpoint"))) writeState(solution_);
  const Run run = this->run(solution_, invocation);
  const Written written = writeReport(run, code);
  if (!isKept && code == ExitCode::Done && !output.get<bool>("Checkpoint") && output.get<double>("Checkpoint Every") > 0.0 &&
      comm_->getRank() == 0) {
    std::error_code ignored;
    std::filesystem::remove(checkpointIn(folder_), ignored);
  }
  if (std::ostream* console = monitor_.console()) printFooter(*console, run, written.figures);
  return {code, solution_.failure, written.summary};
}

}  // namespace suture
