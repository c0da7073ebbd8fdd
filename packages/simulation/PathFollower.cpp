#include <suture/base/Collective.hpp>
#include <suture/base/Progress.hpp>
#include <suture/report/Figures.hpp>
#include <suture/report/Report.hpp>
#include <suture/report/answers/Answers.hpp>
#include <suture/simulation/PathFollower.hpp>
#include <suture/simulation/Restart.hpp>
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
// critical: with .5, .75, 1 and without plan (and before steps were extrapolated) a fault needs 502, 646, 588, 696 iterations of conjugate
// gradients, a stick-slip cycle 1,534, 1,440, 1,555, 1,551, a pad that is unloaded 222, 230, 177, 435.
constexpr double kPlanned = 0.5;
constexpr double kSameLoads = 1e-6;  // relative difference of changes of loads that counts as round-off of their expressions
constexpr double kWork = 100.0;      // allowed imbalance of work, in accuracies of a solution

std::string timeText(double time) {
  std::ostringstream text;
  text << "t = " << time;
  return text.str();
}

std::string stoppedAfter(double time) { return "stopped on request, after " + timeText(time); }

}  // namespace

PathFollower::PathFollower(SceneParts& parts, StepSolver& solver, PathState restart)
    : parts_(parts), solver_(solver), restart_(std::move(restart)), meter_(*parts.run.commPtr()) {}

/// The verified solution at the time of the path; any failure makes it not converged, with the reason. Parameters as of
/// RepeatedSolver::solve().
Solution PathFollower::solveStep(const Solution* before, bool isPrepared, double time) {
  Solution solution;
  brokeDown_ = false;
  try {
    std::vector<Vector> expected;
    const double part = before ? continues(time) : 0.0;
    const bool isExpected = part != 0.0 && solver_.keepsPairs();
    for (std::size_t i = 0; isExpected && i < lastChange_.size(); ++i) expected.push_back(before->displacement[i] + part * lastChange_[i]);
    solution = solver_.solve(before, isPrepared, isExpected ? &expected : nullptr, part);
    solution.sinceTime = parts_.sinceTime();
    if (solution.sinceTime) solution.since = parts_.comparable(solution.displacement);
    for (std::size_t i = 0; i < solution.since.size(); ++i) solution.since[i] -= parts_.reference[i];
    if (solution.converged) {
      judgeSolution(parts_, solver_.method().subdomains(), solution);
      timed(timers(), "verify", [&] { solver_.verify(solution); });
    }
  } catch (const NumericalError& error) {
    brokeDown_ = true;
    solution.converged = false;
    solution.failure = error.what();
  }
  return solution;
}

/// Changes of the loads up to a time, in units of those in the last step, if all of them change in the same proportion: as long as no pair
/// changes, the displacements change like the loads. Zero: they do not, or friction of the last step was in the other direction.
double PathFollower::continues(double time) const {
  if (lastBegin_ < 0.0) return 0.0;
  const std::vector<double> before = path().factorsAt(lastBegin_), now = path().factorsAt(path().time()), next = path().factorsAt(time);
  double square = 0.0, product = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    square += (now[i] - before[i]) * (now[i] - before[i]);
    product += (now[i] - before[i]) * (next[i] - now[i]);
  }
  const double part = square > 0.0 ? product / square : 0.0;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (std::abs(next[i] - now[i] - part * (now[i] - before[i])) > kSameLoads * std::abs(part) * std::sqrt(square)) return 0.0;
  return part < 0.0 && parts_.scene.laws.restrictSliding() ? 0.0 : part;
}

/// States of the pairs at the end of the last step, if there is friction: few sticking pairs indicate that a body begins to slide.
std::string PathFollower::lastStates() const {
  if (path().rows.empty() || !scene().laws.restrictSliding()) return "";
  const StepRow& last = path().rows.back();
  return "; at " + timeText(last.time) + " " + std::to_string(last.sticking) + " of " + std::to_string(last.active) +
         " closed pairs stick and " + std::to_string(last.slipping) + " slip";
}

/// Continues the path of a checkpoint. \param before  receives the solution of its last step
void PathFollower::goOnFromStart(Solution& before) {
  path().goOnFrom(restart_);
  before = solver_.goOnFrom(restart_);
  if (!solver_.keepsPairs() && path().rows.size() > 1) lastBegin_ = path().time() - path().rows.back().length;
  const double tolerance = requestedAccuracy(scene().settings(), before);
  meter_.goOnFrom({parts_.cut.meshes, scene().model, before.displacement, before.pairs, parts_.cut.whole.pieces, tolerance},
                  path().rows.back().work);
  if (parts_.phaseNumber > 0 && path().time() == parts_.begin())
    monitor().note(timeText(path().time()) + ": " + parts_.plan->phases.changes(parts_.phaseNumber));
  else
    monitor().note(continuesText(parts_));
}

/// Accepts a step and writes its row, work, fields and checkpoint.
void PathFollower::acceptStep(Solution& solution, const Solution* before, StepRow row) {
  const double tolerance = requestedAccuracy(scene().settings(), solution);
  timed(timers(), "verify", [&] {
    meter_.add({parts_.cut.meshes, scene().model, solution.displacement, solution.pairs, parts_.cut.whole.pieces, tolerance});
  });
  row.work = meter_.work();
  row.residual = solution.residual;
  row.energy = solution.energy;
  row.changed = before ? changedPairs(before->pairs, solution.pairs) : 0;
  const ContactFigures figures = contactFigures(solution, parts_.size.pieces);
  int states[] = {row.changed, figures.active, figures.friction.sticking, figures.friction.slipping};
  broadcastBytes(comm(), states, sizeof states);
  row.changed = states[0];
  row.active = states[1];
  row.sticking = states[2];
  row.slipping = states[3];
  if (comm().getRank() == 0) {
    const std::vector<std::string> all = parts_.contactsOfPath(), &own = scene().contacts;
    row.forceOnB.assign(all.size(), {0, 0, 0});
    const std::vector<ContactResultant> lines = contactResultants(solution.pairs, static_cast<int>(own.size()), scene().model.axisymmetric);
    for (std::size_t i = 0; i < own.size(); ++i) {  // the springs of a softened contact have one name
      Point& onB = row.forceOnB[static_cast<std::size_t>(std::find(all.begin(), all.end(), own[i]) - all.begin())];
      onB = plus(onB, lines[i].onB.force);
    }
  }
  doubts_.add(solution.verification, ", " + timeText(row.time));
  if (solver_.keepsPairs())
    solution.verification.checks.push_back(
        {"work", row.work.imbalance(), kWork * tolerance, "on the path to " + timeText(row.time), "a smaller Outer Solver/Tolerance"});
  path().accept(solver_.keepsPairs() ? solution.pairs : std::vector<PairResult>(), solution.verification.forces);
  solver_.accept(solution);
  row.frames = solver_.frames();
  if (!solution.rigidGroups.empty()) row.groups = groupsOfStep(runOf(parts_, solution));
  path().rows.push_back(row);
  if (row.time == scene().settings().sublist("Output").get<double>("Displacements Since"))
    parts_.reference = parts_.comparable(solution.displacement);
  for (LeastSafety& one : solution.safety.ofBodies) one.step = row.step, one.time = row.time;
  keepLeast(path().safety, solution.safety.ofBodies);
  monitor().endStep(row);
  if (!parts_.run.writes()) return;
  timed(timers(), "write", [&] {
    if (wantsFields(scene().settings())) writeStepFields(runOf(parts_, solution), path().rows);
    collectivelyOnRoot(comm(), "writing steps.csv", [&] {
      const std::filesystem::path folder(parts_.run.folder());
      writeSteps(path().rows, parts_.contactsOfPath(), (folder / "steps.csv").string());
      if (!row.frames.empty()) writeFrames(path().rows, scene().model.bodies, (folder / "frames.csv").string());
      if (!row.groups.empty()) writeRigidGroups(path().rows, (folder / "rigid_groups.csv").string());
    });
    writeState(parts_, solution);
  });
}

Solution PathFollower::follow() {
  const std::vector<double> times = parts_.times();
  Solution before;
  bool hasBefore = !restart_.empty();
  path().length = std::numeric_limits<double>::infinity();
  if (hasBefore) goOnFromStart(before);
  if (path().time() >= times.back())
    throw InputError("Load Steps/Times", "the checkpoint is at " + timeText(path().time()) + ", but the last step ends at " +
                                             timeText(times.back()) + "; expected a later end");
  if (parts_.run.writes())
    collectivelyOnRoot(comm(), "removing fields of an earlier run", [&] { removeStepFields(parts_.run.folder(), path().rows.size()); });
  Solution total;  // counts of all steps
  StepRow row;
  const Progress::Path progress;
  const double pathBegin = path().time(), pathLength = scene().steps.times().back() - pathBegin;  // with the phases that follow
  bool isPrepared = !hasBefore;
  int changedFirst = 0, changedBefore = 0;  // pairs, in the last two trials of the step
  double began = Timers::now();
  for (auto target = std::upper_bound(times.begin(), times.end(), path().time()); target != times.end();) {
    const double segment = target == times.begin() ? 0.0 : *(target - 1), whole = *target - segment, begin = path().time();
    const bool isLast = begin + path().length >= *target - kSameTime * whole;
    const double time = isLast ? *target : begin + path().length, length = time - begin;
    monitor().beginStep(static_cast<int>(path().rows.size()) + 1);
    path().setTime(time, scene().model, parts_.cut.meshes, parts_.constraints);
    Solution solution = solveStep(hasBefore ? &before : nullptr, isPrepared, time);
    isPrepared = false;
    row.outer += solution.iterations;
    row.pcg += solution.pcgTotal + solution.auxiliary.pcg;
    const bool isSolved = solution.isValid();
    const int stop = solution.stopped || monitor().stopRequested();
    int anyStop = 0, changed = isSolved && hasBefore && solver_.keepsPairs() ? changedWithin(before.pairs, solution.pairs) : 0;
    Teuchos::reduceAll(comm(), Teuchos::REDUCE_MAX, stop, Teuchos::outArg(anyStop));
    broadcastBytes(comm(), &changed, sizeof changed);
    const double allowed = scene().laws.restrictSliding() ? scene().steps.largestChange() * parts_.size.pairs : parts_.size.pairs;
    // If half the step changes as many pairs (a body begins to slide), they change at once, and no step is short enough.
    const bool isSudden = isSolved && changed >= kSudden * changedBefore && changedBefore >= kSudden * changedFirst && changedFirst > 0;
    const bool isTooLong =
        (!isSolved && anyStop == 0) || (changed > allowed && !isSudden) || (isSolved && hasBefore && solver_.isTooLong(solution));
    changedFirst = std::exchange(changedBefore, changed);
    if (isTooLong && length / 2 >= whole * std::pow(0.5, scene().steps.halvings()) * (1.0 - kSameTime)) {
      path().length = length / 2;
      ++row.givenUp;
      continue;
    }
    if (!isSolved) {
      unfinished_ = anyStop ? stoppedAfter(begin)
                            : "load step " + std::to_string(path().rows.size() + 1) + ", to " + timeText(time) + ": " + solution.failure +
                                  lastStates();
      if (!hasBefore && brokeDown_) throw NumericalError(unfinished_);  // no solution to report
      if (!hasBefore) before = std::move(solution);
      break;
    }
    row.step = static_cast<int>(path().rows.size()) + 1;
    row.time = time;
    row.length = length;
    row.seconds = Timers::now() - began;
    began = Timers::now();
    if (changed <= kEasy * allowed) path().length *= 2;
    if (path().length >= whole) path().length = std::numeric_limits<double>::infinity();
    acceptStep(solution, hasBefore ? &before : nullptr, row);
    progress.reach((time - pathBegin) / pathLength);
    total.iterations += row.outer;
    total.pcgTotal += row.pcg;
    total.otherApplications += solution.otherApplications;
    row = StepRow();
    changedFirst = changedBefore = 0;
    if (hasBefore && !isLast && begin >= segment && scene().laws.restrictSliding() && solver_.keepsPairs()) {
      double planned = predictedLength(before.pairs, solution.pairs, length, std::max(1, static_cast<int>(std::ceil(kPlanned * allowed))));
      broadcastBytes(comm(), &planned, sizeof planned);
      path().length = std::min(path().length, std::max(planned, whole * std::pow(0.5, scene().steps.halvings())));
    }
    lastChange_.clear();
    for (std::size_t i = 0; hasBefore && solver_.keepsPairs() && i < before.displacement.size(); ++i)
      lastChange_.push_back(solution.displacement[i] - before.displacement[i]);
    lastBegin_ = hasBefore ? begin : -1.0;
    before = std::move(solution);
    hasBefore = true;
    if (isLast) ++target;
    if (anyStop && target != times.end()) {
      unfinished_ = stoppedAfter(time);
      break;
    }
  }
  Solution result = std::move(before);
  if (!path().rows.empty()) {
    result.iterations = total.iterations;
    result.pcgTotal = total.pcgTotal;
    result.otherApplications = total.otherApplications;
    result.safety.ofBodies = path().safety;
    if (!unfinished_.empty()) solver_.restore(result);
    if (solver_.keepsPairs()) path().setTime(path().time(), scene().model, parts_.cut.meshes, parts_.constraints);
  }
  if (unfinished_.empty() && !result.verification.holds()) result.failure = "the verdict does not hold: " + result.verification.failure();
  if (unfinished_.empty()) return result;
  result.stopped = unfinished_.rfind("stopped", 0) == 0;
  result.converged = false;
  result.failure = unfinished_;
  return result;
}

}  // namespace suture
