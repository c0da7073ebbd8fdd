#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/simulation/LoadControl.hpp>
#include <suture/simulation/accuracy/ChangedAmount.hpp>
#include <suture/simulation/accuracy/ForceIntervals.hpp>

#include <Teuchos_Array.hpp>
#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr const char* kAll = "All";
constexpr int kRounds = 3;                   // pairs of solutions
constexpr double kNearBest = 2.0;            // a change that differs from the best one by less is kept
constexpr double kSmaller = 3.0;             // ratio of changes, after one without a strict bound
constexpr double kLargestChange = 100.0;     // factor of a change from one round to the next
constexpr double kRoundOffOfEnergy = 1e-12;  // relative to the energies of which an energy is the sum
constexpr double kRoundOffOfForce = 1e-9;    // relative to the largest force
constexpr double kSmallForce = 1e-3;         // share of the largest force: the smallest one from which a change is derived
constexpr double kNoResultant = 1e-9;        // share of the sum of nodal forces that is round-off

bool anyRank(const Comm& comm, bool mine) {
  const int own = mine;
  int all = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, own, Teuchos::outArg(all));
  return all != 0;
}

/// Nodal forces of a load: their work in a solution and in the motion that was taken out of it, their resultant and the sum of their norms.
struct WorkOfLoad {
  double work = 0.0, ofLift = 0.0, resultant = 0.0, size = 0.0;
};

WorkOfLoad workOf(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, int number,
                  const std::vector<Vector>& displacement) {
  double sums[6] = {0, 0, 0, 0, 0, 0}, all[6];
  collectively(comm, "measuring a load", [&] {
    for (std::size_t m = 0; m < meshes.size(); ++m)
      forEachLoad(meshes[m], model, [&](int load, const Vector& forces) {
        if (load != number) return;
        const int d = meshes[m].dimension;
        const double ofLift = meshes[m].lift.motion.size() > 0 ? forces.dot(meshes[m].lift.motion) : 0.0;
        sums[0] += forces.dot(displacement[m]) + ofLift, sums[1] += ofLift;
        for (Eigen::Index i = 0; i < forces.size(); i += d) {
          for (int k = 0; k < d; ++k) sums[2 + k] += forces[i + k];
          sums[5] += forces.segment(i, d).norm();
        }
      });
  });
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 6, sums, all);
  return {all[0], all[1], norm(Point{all[2], all[3], all[4]}), all[5]};
}

}  // namespace

std::vector<std::string> strictBarsOf(const Parameters& settings) {
  const auto names = settings.sublist("Output").get<Teuchos::Array<std::string>>("Strict Error Bars");
  return {names.begin(), names.end()};
}

void checkStrictBars(const Parameters& settings, const std::vector<std::string>& conditions, const std::vector<std::string>& contacts) {
  std::vector<std::string> known = conditions;
  known.insert(known.end(), contacts.begin(), contacts.end());
  Problems problems;
  for (const std::string& name : strictBarsOf(settings))
    if (name != kAll && std::find(known.begin(), known.end(), name) == known.end())
      problems.add("Output/Strict Error Bars", unknownName("boundary condition or contact", name, known));
  problems.throwIfAny();
}

ForceIntervals::ForceIntervals(SceneParts& parts, std::unique_ptr<Method>& method, const Solution& solution)
    : parts_(parts), method_(method), solution_(solution) {
  const Comm& comm = parts.run.comm();
  std::string names;
  for (const std::string& name : parts.cut.whole.conditions) names += name + '\n';
  names = broadcast(comm, names);
  for (std::size_t begin = 0; begin < names.size();) {
    const std::size_t end = names.find('\n', begin);
    conditions_.push_back(names.substr(begin, end - begin));
    begin = end + 1;
  }
  const int lines = static_cast<int>(parts.scene.contacts.size());
  for (int line = 0; line < lines; ++line) {
    Pressed own;
    if (comm.getRank() == 0) {
      own.normal = normalOf(solution.pairs, line);
      own.force = contactResultants(solution.pairs, lines, parts.scene.model.axisymmetric)[static_cast<std::size_t>(line)].pressing;
    }
    broadcastBytes(comm, &own, sizeof own);
    contacts_.push_back(own);
  }
}

std::vector<ForceInterval> ForceIntervals::find(const std::vector<std::string>& names) {
  const bool isForAll = std::find(names.begin(), names.end(), kAll) != names.end();
  const auto isWanted = [&](const std::string& name) { return isForAll || std::find(names.begin(), names.end(), name) != names.end(); };
  const std::string why = whyNone();
  std::vector<ForceInterval> all;
  for (std::size_t c = 0; c < conditions_.size(); ++c) {
    if (!isWanted(conditions_[c])) continue;
    all.push_back({conditions_[c], false});
    all.back().reason = why;
    addCondition(static_cast<int>(c), all.back());
  }
  for (std::size_t line = 0; line < contacts_.size(); ++line) {
    if (!isWanted(parts_.scene.contacts[line])) continue;
    all.push_back({parts_.scene.contacts[line], true});
    all.back().reason = why;
    if (why.empty()) addContact(static_cast<int>(line), all.back());
  }
  return all;
}

/// Reason against all intervals; empty: none.
std::string ForceIntervals::whyNone() const {
  if (!solution_.isValid()) return "the solution is not valid";
  if (parts_.path) return "the solution follows load steps, or belongs to a coupled scene";
  if (hasControlledLoads(parts_.scene)) return "the amounts of some loads follow from the solution";
  if (!solution_.bound || !solution_.bound->exists || !solution_.bound->strict)
    return "the error has no strict bound" +
           (solution_.bound && !solution_.bound->reasons.empty() ? ": " + solution_.bound->reasons.front() : std::string());
  return "";
}

void ForceIntervals::addCondition(int condition, ForceInterval& all) {
  bool holds = false;
  for (const SubdomainMesh& mesh : parts_.cut.meshes)
    holds =
        holds || std::any_of(mesh.supports.begin(), mesh.supports.end(), [&](const Support& one) { return one.condition == condition; });
  if (anyRank(parts_.run.comm(), holds)) {
    addSupport(condition, all);
    return;
  }
  const std::vector<Load>& loads = parts_.scene.model.loads;
  const auto load = std::find_if(loads.begin(), loads.end(), [&](const Load& one) { return one.name == all.name; });
  if (load != loads.end())
    addLoad(static_cast<int>(load - loads.begin()), all);
  else if (all.reason.empty())
    all.reason = "it prescribes neither displacements nor a load";
}

void ForceIntervals::addSupport(int condition, ForceInterval& all) {
  const std::vector<Resultant>& supports = solution_.verification.reactions.supports;
  Point force =
      static_cast<std::size_t>(condition) < supports.size() ? supports[static_cast<std::size_t>(condition)].force : Point{0, 0, 0};
  broadcastBytes(parts_.run.comm(), &force, sizeof force);
  for (int k = 0; k < parts_.scene.model.dimension && all.reason.empty(); ++k) {
    const auto axis = static_cast<std::size_t>(k);
    bool holds = false;
    for (const SubdomainMesh& mesh : parts_.cut.meshes)
      for (const Support& support : mesh.supports) holds = holds || (support.condition == condition && support.direction[axis] != 0.0);
    Interval found;
    if (!anyRank(parts_.run.comm(), holds)) {
      all.force[axis] = Interval{0.0, 0.0};
      continue;
    }
    all.reason = intervalOf({Amount::Kind::Support, condition, k}, force[axis], found);
    if (all.reason.empty()) all.force[axis] = found;
  }
}

void ForceIntervals::addContact(int line, ForceInterval& all) {
  const Pressed& contact = contacts_[static_cast<std::size_t>(line)];
  Interval found;
  all.reason = intervalOf({Amount::Kind::Contact, line, 0}, contact.force, found);
  if (!all.reason.empty()) return;
  found.low = std::max(found.low, 0.0);
  found.high = std::max(found.high, 0.0);
  for (int k = 0; k < parts_.scene.model.dimension; ++k) {
    const double n = contact.normal[static_cast<std::size_t>(k)], a = n * found.low + 0.0, b = n * found.high + 0.0;  // no -0
    all.force[static_cast<std::size_t>(k)] = Interval{std::min(a, b), std::max(a, b)};
  }
}

void ForceIntervals::addLoad(int load, ForceInterval& all) {
  const WorkOfLoad found = workOf(parts_.run.comm(), parts_.cut.meshes, parts_.scene.model, load, solution_.displacement);
  if (!(found.resultant > kNoResultant * found.size)) {
    if (all.reason.empty()) all.reason = "its resultant is zero";
    return;
  }
  all.displacement = found.work / found.resultant;
  if (!all.reason.empty()) return;
  Interval derivative;
  all.reason = intervalOf({Amount::Kind::Load, load, 0}, -found.work, derivative);
  if (all.reason.empty()) all.ofDisplacement = Interval{-derivative.high / found.resultant, -derivative.low / found.resultant};
}

/// Largest force of a support, load or contact. The same on all ranks.
double ForceIntervals::forceScale() const {
  double largest = 0.0;
  for (const auto* list : {&solution_.verification.reactions.supports, &solution_.verification.reactions.loads})
    for (const Resultant& one : *list) largest = std::max(largest, norm(one.force));
  for (const Pressed& contact : contacts_) largest = std::max(largest, contact.force);
  broadcastBytes(parts_.run.comm(), &largest, sizeof largest);
  return largest;
}

Interval ForceIntervals::energiesOf(const ErrorBound& bound) const {
  const double roundOff = kRoundOffOfEnergy * (std::abs(bound.energyUpper) + bound.solutionNorm * bound.solutionNorm);
  return {bound.energyLower - roundOff, bound.energyUpper + roundOff};
}

/// Interval of dJ / d(amount). \param conjugate  its value in the computed solution. Returns the reason if there is none.
std::string ForceIntervals::intervalOf(const Amount& amount, double conjugate, Interval& found) {
  if (std::string why = whyNotChangeable(parts_, amount); !why.empty()) return why;
  const Interval now = energiesOf(*solution_.bound);
  const double gap = 2 * (now.high - now.low), size = solution_.bound->solutionNorm;
  const bool isLoad = amount.kind == Amount::Kind::Load;
  const double scale = isLoad ? std::abs(conjugate) : std::max(std::abs(conjugate), kSmallForce * forceScale());
  if (!(scale > 0.0)) return "nothing acts";
  const double most = isLoad ? 1.0 : solution_.extremes.displacement.value;  // larger ones have more round-off
  double change = std::min(std::sqrt(gap) * size / scale, most);
  bool isFound = false;
  std::string why;
  for (int round = 0; round < kRounds; ++round) {
    Interval more, less;
    why = energiesAt(amount, change, more);
    if (why.empty()) why = energiesAt(amount, -change, less);
    if (!why.empty()) {
      if (isFound) break;
      change /= kSmaller;
      continue;
    }
    const Interval own = isLoad ? Interval{(more.low - now.high) / change, (now.high - less.low) / change}
                                : Interval{(now.low - less.high) / change, (more.high - now.low) / change};
    found = isFound ? found.common(own) : own;
    isFound = true;
    const double curvature = std::abs(more.middle() + less.middle() - 2 * now.middle()) / (change * change);
    double best = curvature > 0.0 ? std::sqrt(gap / curvature) : kLargestChange * change;
    best = std::clamp(best, change / kLargestChange, change * kLargestChange);
    best = std::min(best, most);
    if (best < kNearBest * change && change < kNearBest * best) break;
    change = best;
  }
  const double roundOff = kRoundOffOfForce * (isLoad ? scale : forceScale());
  found.low -= roundOff;
  found.high += roundOff;
  return isFound ? "" : why;
}

/// Energies with a changed amount. Returns the reason if there are none.
std::string ForceIntervals::energiesAt(const Amount& amount, double by, Interval& energies) {
  const Comm& comm = parts_.run.comm();
  Timers& timers = parts_.run.timers();
  double liftWork = parts_.liftWork;
  if (amount.kind == Amount::Kind::Load)
    liftWork += by * workOf(comm, parts_.cut.meshes, parts_.scene.model, amount.number, solution_.displacement).ofLift;
  const ChangedAmount changed(parts_, amount, by);
  try {
    if (method_ && method_->reloads()) {
      method_->reload(timers);
    } else {
      method_.reset();
      method_ = preparedMethod(parts_, nullptr, true);
    }
    const Start start = startOf(comm, solution_);
    Monitor silent;
    Solution solution = method_->solve(silent, timers, method_->takesStart() ? &start : nullptr);
    if (!solution.converged) return "a solution with a changed amount was not found: " + solution.failure;
    solution.energy -= liftWork;
    const ErrorBound bound = timed(timers, "bound", [&] {
      return errorBound(comm,
                        {parts_.cut.meshes,
                         parts_.scene.model,
                         solution.displacement,
                         solution.balancing,
                         solution.pairs,
                         parts_.cut.whole.parts,
                         solution.energy,
                         {},
                         solution.notBalanced},
                        parts_.scene.laws);
    });
    if (!bound.strict) return "the error of a solution with a changed amount has no strict bound: " + bound.reasons.front();
    energies = energiesOf(bound);
  } catch (const NumericalError& error) {
    method_.reset();
    return std::string("a solution with a changed amount was not found: ") + error.what();
  }
  return "";
}

}  // namespace suture
