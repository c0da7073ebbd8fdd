// Simulation of load steps.
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/report/Checkpoint.hpp>
#include <suture/report/Figures.hpp>
#include <suture/report/Report.hpp>
#include <suture/report/answers/Answers.hpp>
#include <suture/simulation/JudgeStage.hpp>
#include <suture/simulation/Simulation.hpp>
#include <suture/simulation/StepLength.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <utility>

namespace suture {

namespace {

constexpr double kSameTime = 1e-9;  // fraction of a step: a time nearer to its end is the end
constexpr double kEasy = 0.5;       // fraction of the largest change, below which the next step is longer
constexpr double kSudden = 0.9;     // fraction of the changes of a step found in its half that marks a sudden change
// Part of the largest change that the next step is planned for: pairs that slip pass their load on, so that more change than predicted. Not
// critical: with .5, .75, 1 and without plan a fault needs 502, 646, 588, 696 iterations of conjugate gradients, a stick-slip cycle 1,534,
// 1,440, 1,555, 1,551, a pad that is unloaded 222, 230, 177, 435.
constexpr double kPlanned = 0.5;
constexpr double kWork = 100.0;  // allowed imbalance of work, in accuracies of a solution

std::string timeText(double time) {
  std::ostringstream text;
  text << "t = " << time;
  return text.str();
}

std::string stoppedAfter(double time) { return "stopped on request, after " + timeText(time); }

/// Initial guess of a step: the solution of the previous step.
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

}  // namespace

/// The solution for the present loads. \param before  initial guess; null: the one found by start() \param isPrepared  the method is
/// prepared for these loads
Solution Simulation::solveFrom(const Solution* before, bool isPrepared) {
  if (!isPrepared && method_->reloads()) {
    method_->reload(timers_);
  } else if (!isPrepared) {
    method_.reset();
    method_ = preparedMethod();
  }
  std::optional<Start> start;
  if (before)
    start = startOf(*comm_, *before);
  else
    start = start_;
  if (start && path_) start->carried = path_->carried();
  return method_->solve(monitor_, timers_, start && method_->takesStart() ? &*start : nullptr);
}

/// The verified solution at the time of the path; any failure makes it not converged, with the reason. Parameters as of solveFrom().
Solution Simulation::solveStep(const Solution* before, bool isPrepared) {
  Solution solution;
  brokeDown_ = false;
  try {
    solution = solveFrom(before, isPrepared);
    if (solution.converged) judge(solution, method_->subdomains());
  } catch (const NumericalError& error) {
    brokeDown_ = true;
    solution.converged = false;
    solution.failure = error.what();
  }
  return solution;
}

/// States of the pairs at the end of the last step, if there is friction: few sticking pairs indicate that a body begins to slide.
std::string Simulation::lastStates() const {
  if (path_->rows.empty() || !scene_.laws.restrictSliding()) return "";
  const StepRow& last = path_->rows.back();
  return "; at " + timeText(last.time) + " " + std::to_string(last.sticking) + " of " + std::to_string(last.active) +
         " closed pairs stick and " + std::to_string(last.slipping) + " slip";
}

/// Continues the path of a checkpoint. \param before  receives the solution of its last step
void Simulation::goOnFromStart(Solution& before) {
  path_->goOnFrom(restart_);
  before.displacement = start_->displacement;
  before.converged = true;
  std::vector<PairForce> forces;
  if (comm_->getRank() == 0)
    for (const PathState::Pair& pair : restart_.pairs) forces.push_back({pair.id, start_->status[pair.id], pair.force, pair.tangential});
  path_->setTime(path_->time(), scene_.model, cut_.meshes, constraints_);
  std::vector<const SubdomainMesh*> meshes;
  for (const SubdomainMesh& mesh : cut_.meshes) meshes.push_back(&mesh);
  before.pairs = pairResults(*comm_, meshes, before.displacement, forces);
  before.energy = path_->rows.back().energy;
  const double tolerance = requestedAccuracy(scene_.settings(), before);
  meter_->goOnFrom({cut_.meshes, scene_.model, before.displacement, before.pairs, cut_.whole.pieces, tolerance}, path_->rows.back().work);
  monitor_.note("continues at " + timeText(path_->time()) + ", after load step " + std::to_string(path_->rows.size()));
}

/// Accepts a step and writes its row, work, fields and checkpoint.
void Simulation::acceptStep(Solution& solution, const Solution* before, StepRow row) {
  const double tolerance = requestedAccuracy(scene_.settings(), solution);
  timed(timers_, "verify", [&] {
    meter_->add({cut_.meshes, scene_.model, solution.displacement, solution.pairs, cut_.whole.pieces, tolerance});
  });
  row.work = meter_->work();
  row.residual = solution.residual;
  row.energy = solution.energy;
  row.changed = before ? changedPairs(before->pairs, solution.pairs) : 0;
  const ContactFigures figures = contactFigures(solution, size_.pieces);
  int states[] = {row.changed, figures.active, figures.friction.sticking, figures.friction.slipping};
  broadcastBytes(*comm_, states, sizeof states);
  row.changed = states[0];
  row.active = states[1];
  row.sticking = states[2];
  row.slipping = states[3];
  if (comm_->getRank() == 0)
    for (const ContactResultant& line :
         contactResultants(solution.pairs, static_cast<int>(scene_.contacts.size()), scene_.model.axisymmetric))
      row.forceOnB.push_back(line.onB.force);
  doubts_.add(solution.verification, ", " + timeText(row.time));
  solution.verification.checks.push_back(
      {"work", row.work.imbalance(), kWork * tolerance, "on the path to " + timeText(row.time), "a smaller Outer Solver/Tolerance"});
  path_->accept(solution.pairs, solution.verification.forces);
  path_->rows.push_back(row);
  monitor_.endStep(row);
  if (!output_) return;
  timed(timers_, "write", [&] {
    if (wantsFields(scene_.settings())) writeStepFields(run(solution), path_->rows);
    collectivelyOnRoot(*comm_, "writing steps.csv",
                       [&] { writeSteps(path_->rows, scene_.contacts, (std::filesystem::path(folder_) / "steps.csv").string()); });
    writeState(solution);
  });
}

void Simulation::followPath() {
  const std::vector<double>& times = scene_.steps.times();
  meter_ = std::make_unique<WorkMeter>(*comm_);
  Solution before;
  bool hasBefore = !restart_.empty();
  path_->length = std::numeric_limits<double>::infinity();
  if (hasBefore) goOnFromStart(before);
  if (path_->time() >= times.back())
    throw InputError("Load Steps/Times", "the checkpoint is at " + timeText(path_->time()) + ", but the last step ends at " +
                                             timeText(times.back()) + "; expected a later end");
  if (output_) collectivelyOnRoot(*comm_, "removing fields of an earlier run", [&] { removeStepFields(folder_, path_->rows.size()); });
  Solution total;  // counts of all steps
  StepRow row;
  bool isPrepared = !hasBefore;
  int changedFirst = 0, changedBefore = 0;  // pairs, in the last two trials of the step
  double began = Timers::now();
  for (auto target = std::upper_bound(times.begin(), times.end(), path_->time()); target != times.end();) {
    const double segment = target == times.begin() ? 0.0 : *(target - 1), whole = *target - segment, begin = path_->time();
    const bool isLast = begin + path_->length >= *target - kSameTime * whole;
    const double time = isLast ? *target : begin + path_->length, length = time - begin;
    monitor_.beginStep(static_cast<int>(path_->rows.size()) + 1);
    path_->setTime(time, scene_.model, cut_.meshes, constraints_);
    Solution solution = solveStep(hasBefore ? &before : nullptr, isPrepared);
    isPrepared = false;
    row.outer += solution.iterations;
    row.pcg += solution.pcgTotal + solution.auxiliary.pcg;
    const bool isSolved = solution.isValid();
    const int stop = solution.stopped || monitor_.stopRequested();
    int anyStop = 0, changed = isSolved && hasBefore ? changedWithin(before.pairs, solution.pairs) : 0;
    Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MAX, stop, Teuchos::outArg(anyStop));
    broadcastBytes(*comm_, &changed, sizeof changed);
    const double allowed = scene_.laws.restrictSliding() ? scene_.steps.largestChange() * size_.pairs : size_.pairs;
    // If half the step changes as many pairs (a body begins to slide), they change at once, and no step is short enough.
    const bool isSudden = isSolved && changed >= kSudden * changedBefore && changedBefore >= kSudden * changedFirst && changedFirst > 0;
    const bool isTooLong = (!isSolved && anyStop == 0) || (changed > allowed && !isSudden);
    changedFirst = std::exchange(changedBefore, changed);
    if (isTooLong && length / 2 >= whole * std::pow(0.5, scene_.steps.halvings()) * (1.0 - kSameTime)) {
      path_->length = length / 2;
      ++row.givenUp;
      continue;
    }
    if (!isSolved) {
      unfinished_ = anyStop ? stoppedAfter(begin)
                            : "load step " + std::to_string(path_->rows.size() + 1) + ", to " + timeText(time) + ": " + solution.failure +
                                  lastStates();
      if (!hasBefore && brokeDown_) throw NumericalError(unfinished_);  // no solution to report
      if (!hasBefore) before = std::move(solution);
      break;
    }
    row.step = static_cast<int>(path_->rows.size()) + 1;
    row.time = time;
    row.length = length;
    row.seconds = Timers::now() - began;
    began = Timers::now();
    if (changed <= kEasy * allowed) path_->length *= 2;
    if (path_->length >= whole) path_->length = std::numeric_limits<double>::infinity();
    acceptStep(solution, hasBefore ? &before : nullptr, row);
    total.iterations += row.outer;
    total.pcgTotal += row.pcg;
    total.otherApplications += solution.otherApplications;
    row = StepRow();
    changedFirst = changedBefore = 0;
    if (hasBefore && !isLast && begin >= segment && scene_.laws.restrictSliding()) {
      double planned = predictedLength(before.pairs, solution.pairs, length, std::max(1, static_cast<int>(std::ceil(kPlanned * allowed))));
      broadcastBytes(*comm_, &planned, sizeof planned);
      path_->length = std::min(path_->length, std::max(planned, whole * std::pow(0.5, scene_.steps.halvings())));
    }
    before = std::move(solution);
    hasBefore = true;
    if (isLast) ++target;
    if (anyStop && target != times.end()) {
      unfinished_ = stoppedAfter(time);
      break;
    }
  }
  solution_ = std::move(before);
  start_.reset();
  if (!path_->rows.empty()) {
    solution_.iterations = total.iterations;
    solution_.pcgTotal = total.pcgTotal;
    solution_.otherApplications = total.otherApplications;
    path_->setTime(path_->time(), scene_.model, cut_.meshes, constraints_);
  }
  if (unfinished_.empty() && !solution_.verification.holds())
    solution_.failure = "the verdict does not hold: " + solution_.verification.failure();
  if (unfinished_.empty()) return;
  solution_.stopped = unfinished_.rfind("stopped", 0) == 0;
  solution_.converged = false;
  solution_.failure = unfinished_;
}

}  // namespace suture
