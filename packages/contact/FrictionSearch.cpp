#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/contact/FrictionSearch.hpp>
#include <suture/contact/PadProblem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double kConstant = 0.05;    // of the stiffness of a pair's nodes: a tenth of what the bodies beyond them leave of it, half
constexpr double kAcross = 200.0;     // times that constant: largest stiffness across the direction of slip; it only guides the way there
constexpr int kBlockSteps = 6;        // steps that change all violated pairs without lowering their number
constexpr double kTurned = 1.0;       // of the tolerance of forces: a turn that is none
constexpr double kSharper = 0.1;      // accuracy of the next solve, in parts of the turn that it makes
constexpr int kNewtonSolves = 60;     // before the fixed point of Tresca problems
constexpr int kTrescaSolves = 2;      // of the first Tresca problem: it is a guess
constexpr double kLeastPart = 0.1;    // of a change of the bounds that is taken
constexpr double kSameBounds = 1e-9;  // relative change of the bounds at which a fixed point has been reached

double tangentialSize(const Matrix& values, Eigen::Index pair) { return std::hypot(values(pair, 1), values(pair, 2)); }

}  // namespace

/// The state with a bound by a given normal force in place of its own: that of a Tresca problem. `first` and `second` are the tangential
/// trial force.
ContactState FrictionSearch::frozen(std::size_t pair, ContactState state, double normal, double first, double second) const {
  (void)pair;
  if (!state.closed()) return state;
  state.bound = state.largest(normal);
  state.friction = 0.0;
  const double size = std::hypot(first, second);
  state.status = size < state.bound || size == 0.0 ? PairStatus::Stick : PairStatus::Slip;
  state.direction = {0, 0, 0};
  if (state.status == PairStatus::Slip) state.direction = {0.0, first / size, second / size};
  return state;
}

ContactState FrictionSearch::project(std::size_t pair, const ContactState& now, const FrictionAnswer& at) const {
  const auto i = static_cast<Eigen::Index>(pair);
  const FrictionSite& site = sites_[pair];
  const ContactLaw& law = laws_.of(rigid_.data().line[pair]);
  const double constant = kConstant * site.tangential, tolerance = at.forceTolerance(i);
  ContactTrial trial;
  trial.place = site.place;
  trial.size = site.size;
  // The tolerance goes to the state that the pair has.
  if (now.closed())
    trial.force[0] = at.force(i, 0) + tolerance;
  else
    trial.jump[0] = (at.jump(i, 0) - at.jumpTolerance(i)) * rigid_.data().stiffness(i);
  for (int k = 1; k <= 2; ++k) {
    trial.force[k] = at.force(i, k);
    if (now.status != PairStatus::Stick) trial.jump[k] = constant * at.jump(i, k);
  }
  if (now.status == PairStatus::Stick) {
    const double size = tangentialSize(at.force, i), less = size > 0.0 ? std::max(0.0, 1.0 - tolerance / size) : 0.0;
    for (int k = 1; k <= 2; ++k) trial.force[k] *= less;
  } else if (now.status == PairStatus::Slip) {
    for (int k = 1; k <= 2; ++k) trial.force[k] += tolerance * now.direction[k];
  }
  ContactState next = law.project(trial, now);
  const double first = trial.force[1] + trial.jump[1], second = trial.force[2] + trial.jump[2];
  if (normal_.size() > 0) next = frozen(pair, next, normal_(i), first, second);
  // Between slip one way and slip the other lies stick: pairs that jump over it cycle where little beside friction holds a body.
  if (now.status == PairStatus::Slip && next.status == PairStatus::Slip &&
      now.direction[1] * next.direction[1] + now.direction[2] * next.direction[2] < 0.0) {
    next.status = PairStatus::Stick;
    next.direction = {0, 0, 0};
  }
  if (next.status == PairStatus::Slip && rigid_.data().tangents.size() == 2 && next.direction != Point{0, 0, 0}) {
    const double bound = next.largest(trial.force[0] + trial.jump[0]), beyond = std::hypot(first, second) - bound;
    next.across = constant * (beyond * kAcross > bound ? bound / beyond : kAcross);
  }
  return next;
}

PairStates FrictionSearch::projected(const PairStates& now, const FrictionAnswer& at) const {
  PairStates next = now;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (rigid_.data().able[i]) next[i] = project(i, now[i], at);
  return next;
}

bool FrictionSearch::differs(std::size_t, const ContactState& now, const ContactState& next) const {
  if (now.status != next.status) return true;
  if (now.status != PairStatus::Slip) return false;
  return now.direction[1] * next.direction[1] + now.direction[2] * next.direction[2] < 0.0;
}

/// Of the pairs that held a body before some go on to, where the next states would leave it loose: one a motion, the best determined.
PairStates FrictionSearch::guarded(PairStates next, const PairStates& before) {
  holders_.assign(next.size(), 0);
  Matrix free = rigid_.loose(next);
  const RigidContact::Pairs& data = rigid_.data();
  while (free.cols() > 0) {
    double most = kDependentRows;
    std::size_t best = next.size();
    bool sticks = false;
    for (std::size_t i = 0; i < next.size(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      if (!data.able[i] || !before[i].closed()) continue;
      if (!next[i].closed())
        if (const double size = (data.rows.row(at) * free).norm(); size > most) most = size, best = i, sticks = false;
      if (next[i].status != PairStatus::Stick)
        for (const Matrix& tangent : data.tangents)
          if (const double size = (tangent.row(at) * free).norm(); size > most) most = size, best = i, sticks = true;
    }
    if (best == next.size()) break;
    if (sticks || before[best].status == PairStatus::Stick) {
      next[best].status = PairStatus::Stick;
      next[best].direction = {0, 0, 0};
      next[best].across = 0.0;
    } else {
      next[best] = before[best];
    }
    holders_[best] = 1;
    const Matrix now = rigid_.loose(next);
    if (now.cols() >= free.cols()) break;
    free = now;
  }
  return next;
}

/// By how much the force of a pair that slips is not along its slip, relative to what is believed of it.
double FrictionSearch::turn(std::size_t pair, const ContactState& next) const {
  const auto at = static_cast<Eigen::Index>(pair);
  if (next.status != PairStatus::Slip || !(answer_.forceTolerance(at) > 0.0)) return 0.0;
  const double bound = next.largest(answer_.force(at, 0));
  return std::hypot(answer_.force(at, 1) - bound * next.direction[1], answer_.force(at, 2) - bound * next.direction[2]) /
         answer_.forceTolerance(at);
}

/// Newton's steps from states_ until the laws agree with the answer to the tolerance `last`. States that do not change are solved for more
/// accurately; some that change in an accurate answer, half way back.
FrictionSearch::End FrictionSearch::settle(double last) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::size_t fewest = kNone;
  int patience = kBlockSteps;
  bool single = false;
  std::vector<PairStates> seen;
  while (true) {
    if (left_-- <= 0 || !oracle_.goesOn()) return End::Exhausted;
    ++solves_;
    answer_ = oracle_.solve(states_, tolerance_);
    if (!answer_.solved) return End::Failed;
    PairStates next = projected(states_, answer_);
    violated_.clear();
    double turns = 0.0;
    bool driven = false;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!differs(i, states_[i], next[i]))
        turns = std::max(turns, turn(i, next[i]));
      else if (holders_[i])
        driven = true;
      else
        violated_.push_back(static_cast<int>(i));
    }
    if (violated_.empty() && turns <= kTurned) {
      if (driven && tolerance_ <= last) return End::Slides;
      if (tolerance_ <= last) return End::Settled;
      tolerance_ = last;
      ++left_;
      fewest = kNone;
      patience = kBlockSteps;
      single = false;
      seen.clear();
      continue;
    }
    if (violated_.empty()) {
      // Newton's steps turn pairs ever more exactly: each is worth an accurate solve only in the end.
      tolerance_ = std::max(last, std::min(tolerance_, kSharper * turns * tolerance_));
    } else {
      if (tolerance_ <= last) tolerance_ = std::max(last, std::sqrt(last * oracle_.loosest()));
      if (violated_.size() < fewest) {
        fewest = violated_.size();
        patience = kBlockSteps;
        single = false;
        seen.clear();
      } else if (std::find(seen.begin(), seen.end(), states_) != seen.end()) {
        if (single) return End::Exhausted;  // they would go round for ever
        single = true;
        seen.clear();
      } else if (--patience <= 0) {
        single = true;
      }
      seen.push_back(states_);
      if (single)
        for (std::size_t k = 0; k + 1 < violated_.size(); ++k) next[violated_[k]] = states_[violated_[k]];
    }
    states_ = guarded(std::move(next), states_);
  }
}

/// Largest tangential forces by the normal forces of the answer.
Vector FrictionSearch::bounds() const {
  Vector all = Vector::Zero(static_cast<Eigen::Index>(states_.size()));
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (states_[i].closed()) all(at) = std::max(0.0, answer_.force(at, 0));
  }
  return all;
}

/// Tresca problems, each with the bounds that the one before gives: all of the change, or the part of it at which two successive changes
/// would end each other (Aitken).
FrictionSearch::End FrictionSearch::fixedPoint() {
  normal_ = bounds();
  Vector before;
  double part = 1.0;
  while (true) {
    tolerance_ = oracle_.tightest();
    if (const End end = settle(oracle_.tightest()); end != End::Settled) return end;
    const Vector change = bounds() - normal_;
    if (before.size() > 0) {
      if (const double squared = before.squaredNorm(); squared > 0.0)
        contraction_ = std::abs((change.dot(before) / squared - (1.0 - part)) / part);
      const Vector difference = change - before;
      if (const double squared = difference.squaredNorm(); squared > 0.0)
        part = std::clamp(-part * before.dot(difference) / squared, kLeastPart, 1.0);
    }
    if (change.norm() <= kSameBounds * (normal_ + change).norm()) return End::Settled;
    before = change;
    normal_ += part * change;
  }
}

/// The bounds of the laws themselves in place of those of a Tresca problem.
void FrictionSearch::thaw() {
  if (normal_.size() == 0 || answer_.force.size() == 0) return;
  normal_ = Vector();
  const PairStates own = projected(states_, answer_);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (!states_[i].closed() || !own[i].closed()) continue;
    states_[i].bound = own[i].bound;
    states_[i].friction = own[i].friction;
  }
}

/// All closed pairs stick.
void FrictionSearch::stick() {
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (rigid_.data().able[i] && states_[i].closed()) states_[i] = laws_.of(rigid_.data().line[i]).pressed();
  holders_.assign(states_.size(), 0);
}

FrictionSearch::Result FrictionSearch::run(PairStates start, const Vector& normal) {
  states_ = std::move(start);
  holders_.assign(states_.size(), 0);
  tolerance_ = oracle_.loosest();
  End end = End::Settled;
  Vector tresca;
  const auto limited = [&](int most, double last) {
    const int left = left_;
    left_ = std::min(left_, most);
    const int given = left_;
    const End found = settle(last);
    left_ = left - (given - left_);
    return found;
  };
  if (normal.size() > 0) {
    normal_ = normal;
    end = limited(kTrescaSolves, oracle_.loosest());
    normal_ = Vector();
    if (end != End::Failed) {
      tresca = bounds();
      states_ = guarded(projected(states_, answer_), states_);
    }
  }
  if (end != End::Failed) {
    tolerance_ = oracle_.loosest();
    end = limited(kNewtonSolves, oracle_.tightest());
    if (end == End::Settled && tresca.size() > 0) {
      const Vector found = bounds();
      if (const double from = (normal - found).norm(); from > 0.0) contraction_ = (tresca - found).norm() / from;
    }
    if (end == End::Slides) {  // from the other side, before it is said
      stick();
      tolerance_ = oracle_.loosest();
      end = limited(kNewtonSolves, oracle_.tightest());
    }
    if (end == End::Exhausted && left_ > 0 && oracle_.goesOn()) {
      end = fixedPoint();
      thaw();
    }
  }
  Result result;
  result.converged = end == End::Settled;
  result.slides = end == End::Slides;
  result.states = states_;
  result.solves = solves_;
  result.contraction = contraction_;
  if (end == End::Slides) {
    PairStates without = states_;
    for (std::size_t i = 0; i < without.size(); ++i)
      if (holders_[i]) without[i] = projected(states_, answer_)[i];
    const Matrix free = rigid_.loose(without);
    result.motion = free.cols() > 0 ? Vector(free.col(0)) : Vector::Zero(rigid_.motions());
  }
  if (end == End::Exhausted) result.alternating = violated_;
  return result;
}

}  // namespace suture
