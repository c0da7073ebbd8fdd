#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/contact/FrictionSearch.hpp>
#include <suture/contact/PadProblem.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double kConstant = 0.05;    // constant, in parts of the stiffness of a pair's nodes: a tenth of the local one, half of it
constexpr double kAcross = 200.0;     // times that constant: largest stiffness across the direction of slip; it only guides the way there
constexpr int kBlockSteps = 3;        // steps that change all violated pairs without lowering their number
constexpr double kTurned = 1.0;       // turn that is none, in parts of the tolerance of forces
constexpr double kSharper = 0.1;      // accuracy of the next solve, in parts of the turn that it makes
constexpr int kMoreBlockSteps = 10;   // the same in a second try
constexpr double kForcing = 0.1;      // accuracy of the next solve, in parts of the distance from the laws
constexpr int kHalvings = 8;          // of a step of descent
constexpr int kRises = 3;             // steps of descent that do not lower the distance from the laws
constexpr double kLeastFall = 1e-4;   // of that distance, in parts of it and of the step
constexpr int kNewtonSolves = 60;     // solves before the fixed point of Tresca problems
constexpr int kTrescaSolves = 1;      // solves of the first Tresca problem: it is a guess
constexpr double kLeastPart = 0.1;    // smallest part of a change of normal forces that is taken
constexpr double kSameForces = 1e-9;  // relative change of normal forces at which a fixed point has been reached

double tangentialSize(const Matrix& values, Eigen::Index pair) { return std::hypot(values(pair, 1), values(pair, 2)); }

/// The state with a bound by a given normal force in place of its own: that of a Tresca problem. `first` and `second` are the tangential
/// trial force.
ContactState frozen(ContactState state, double normal, double first, double second) {
  if (!state.closed()) return state;
  state.bound = state.largest(normal);
  state.friction = 0.0;
  const double size = std::hypot(first, second);
  state.status = size < state.bound || size == 0.0 ? PairStatus::Stick : PairStatus::Slip;
  state.direction = {0, 0, 0};
  if (state.status == PairStatus::Slip) state.direction = {0.0, first / size, second / size};
  return state;
}

}  // namespace

ContactState FrictionSearch::project(std::size_t pair, const ContactState& now, const FrictionAnswer& at) const {
  const auto i = static_cast<Eigen::Index>(pair);
  const FrictionSite& site = sites_[pair];
  const double constant = kConstant * site.tangential, tolerance = at.forceTolerance(i);
  ContactTrial trial;
  trial.place = site.place;
  trial.size = site.size;
  trial.slipped = site.slipped;
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
  const ContactState next = onto(pair, now, trial);
  // Between slip one way and slip the other lies stick: pairs that jump over it cycle where little beside friction holds a body.
  if (now.status == PairStatus::Slip && next.status == PairStatus::Slip &&
      now.direction[1] * next.direction[1] + now.direction[2] * next.direction[2] < 0.0) {
    ContactState between = next;
    between.status = PairStatus::Stick;
    between.direction = {0, 0, 0};
    between.across = 0.0;
    return between;
  }
  return next;
}

/// State of a trial, with the stiffness across its direction.
ContactState FrictionSearch::onto(std::size_t pair, const ContactState& now, const ContactTrial& trial) const {
  ContactState next = laws_.of(rigid_.data().line[pair]).project(trial, now);
  const double first = trial.force[1] + trial.jump[1], second = trial.force[2] + trial.jump[2];
  if (normal_.size() > 0) next = frozen(next, normal_(static_cast<Eigen::Index>(pair)), first, second);
  if (next.status == PairStatus::Slip && rigid_.data().tangents.size() == 2 && next.direction != Point{0, 0, 0}) {
    const double constant = kConstant * sites_[pair].tangential, bound = next.largest(trial.force[0] + trial.jump[0]),
                 beyond = std::hypot(first, second) - bound;
    next.across = constant * (beyond * kAcross > bound ? bound / beyond : kAcross);
  }
  return next;
}

/// Distance of forces from those that the laws project them onto, with jumps that are in balance with them, squared.
/// \param states  gets the states of the projection, or null
double FrictionSearch::violation(const Matrix& force, const Matrix& jump, PairStates* states) const {
  double sum = 0.0;
  if (states) *states = states_;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (!rigid_.data().able[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    ContactTrial trial;
    trial.place = sites_[i].place;
    trial.size = sites_[i].size;
    trial.slipped = sites_[i].slipped;
    for (int k = 0; k <= 2; ++k) {
      trial.force[k] = force(at, k);
      trial.jump[k] = kConstant * (k == 0 ? rigid_.data().stiffness(at) : sites_[i].tangential) * jump(at, k);
    }
    const ContactState next = onto(i, states_[i], trial);
    const double normal = trial.force[0] + trial.jump[0];
    Point allowed{0, 0, 0};
    if (next.closed()) allowed[0] = normal;
    for (int k = 1; k <= 2; ++k)
      if (next.status == PairStatus::Stick)
        allowed[k] = trial.force[k] + trial.jump[k];
      else if (next.status == PairStatus::Slip)
        allowed[k] = next.largest(normal) * next.direction[k];
    for (int k = 0; k <= 2; ++k) sum += (trial.force[k] - allowed[k]) * (trial.force[k] - allowed[k]);
    if (states) (*states)[i] = next;
  }
  return sum;
}

PairStates FrictionSearch::projected(const PairStates& now, const FrictionAnswer& at) const {
  PairStates next = now;
  for (std::size_t i = 0; i < now.size(); ++i)
    if (rigid_.data().able[i]) next[i] = project(i, now[i], at);
  return next;
}

/// Deviation of the force of a pair that slips from the direction of its slip, relative to what is believed of forces.
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
  int patience = patience_;
  Way way = Way::Block;
  nearest_ = std::numeric_limits<double>::infinity();
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
      if (states_[i].status == next[i].status)
        turns = std::max(turns, turn(i, next[i]));
      else if (holders_[i])
        driven = true;
      else
        violated_.push_back(static_cast<int>(i));
    }
    if (violated_.empty() && turns <= kTurned) {
      // A pair that sticks since the start knows no bound yet.
      for (std::size_t i = 0; i < next.size(); ++i)
        if (states_[i].status == PairStatus::Stick && next[i].status == PairStatus::Stick) states_[i] = next[i];
      if (driven && tolerance_ <= last) {  // others may hold the body
        if (outdone_.size() == 0) outdone_ = outdone();
        if (!relieve(next)) return End::Slides;
        tolerance_ = oracle_.loosest();
        fewest = kNone;
        patience = patience_;
        way = Way::Block;
        nearest_ = std::numeric_limits<double>::infinity();
        seen.clear();
        continue;
      }
      if (tolerance_ <= last) return End::Settled;
      // Directions turn by Newton's steps from there on: not all of them need be accurate.
      const double between = std::max(last, std::sqrt(last * oracle_.loosest()));
      const bool turning = std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.across > 0.0; });
      tolerance_ = turning && tolerance_ > between ? between : last;
      ++left_;
      fewest = kNone;
      patience = patience_;
      way = Way::Block;
      seen.clear();
      continue;
    }
    const double own = violation(answer_.force, answer_.jump);
    if (way != Way::Descent && own < nearest_) {
      nearest_ = own;
      force_ = answer_.force;
      jump_ = answer_.jump;
    }
    if (violated_.empty()) {
      // Newton's steps turn pairs ever more exactly: each is worth an accurate solve only in the end.
      tolerance_ = std::max(last, std::min(tolerance_, kSharper * turns * tolerance_));
    } else {
      // States are as good as the distance from the laws: accuracy follows it.
      const double between = std::max(last, std::sqrt(last * oracle_.loosest()));
      if (const double size = answer_.force.norm(); size > 0.0 && tolerance_ > between)
        tolerance_ = std::clamp(kForcing * std::sqrt(own) / size, between, tolerance_);
      if (tolerance_ <= last) tolerance_ = between;
      if (way == Way::Descent) {
        if (!descend(next)) {
          way = Way::Single;
          seen.clear();
        }
      } else if (violated_.size() < fewest) {
        fewest = violated_.size();
        patience = patience_;
        way = Way::Block;
        seen.clear();
      } else if (const bool again = std::find(seen.begin(), seen.end(), states_) != seen.end(); again || --patience <= 0) {
        if (way == Way::Single && again) return End::Exhausted;  // they would go round for ever
        if (way == Way::Block) {
          way = Way::Descent;
          rises_ = 0;
          if (!descend(next)) way = Way::Single;
        }
      }
      seen.push_back(states_);
      if (way == Way::Single)
        for (std::size_t k = 0; k + 1 < violated_.size(); ++k) next[violated_[k]] = states_[violated_[k]];
    }
    states_ = guarded(std::move(next), states_);
  }
}

/// Goes from the nearest balance towards the answer until the distance from the laws falls: combinations of balances are in balance, and
/// cost no solve. False where it does not fall any more.
/// \param next  gets the states there
bool FrictionSearch::descend(PairStates& next) {
  for (int repeated = 0; repeated < kHalvings; ++repeated) {
    const Matrix force = answer_.force - force_, jump = answer_.jump - jump_;
    double least = std::numeric_limits<double>::infinity(), best = 1.0, part = 1.0;
    for (int halved = 0; halved <= kHalvings; ++halved, part *= 0.5) {
      const double own = violation(force_ + part * force, jump_ + part * jump);
      if (own < least) least = own, best = part;
      if (own < (1.0 - kLeastFall * part) * nearest_) break;
    }
    if (!(least < nearest_) && ++rises_ > kRises) return false;
    nearest_ = least;
    force_ += best * force;
    jump_ += best * jump;
    if (best == 1.0) return true;
    violation(force_, jump_, &next);
    if (guarded(next, states_) != states_) return true;
  }
  return false;
}

/// Normal forces of the answer, by which a Tresca problem has its bounds.
Vector FrictionSearch::normalForces() const {
  Vector all = Vector::Zero(static_cast<Eigen::Index>(states_.size()));
  for (std::size_t i = 0; i < states_.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (states_[i].closed()) all(at) = std::max(0.0, answer_.force(at, 0));
  }
  return all;
}

/// Solves Tresca problems, each with the bounds that the one before gives: by all of the change of normal forces, or the part of it at
/// which two successive changes would end each other (Aitken).
FrictionSearch::End FrictionSearch::fixedPoint() {
  normal_ = normalForces();
  Vector before;
  double part = 1.0;
  while (true) {
    tolerance_ = oracle_.tightest();
    if (const End end = settle(oracle_.tightest()); end != End::Settled) return end;
    const Vector change = normalForces() - normal_;
    if (before.size() > 0) {
      if (const double squared = before.squaredNorm(); squared > 0.0)
        contraction_ = std::abs((change.dot(before) / squared - (1.0 - part)) / part);
      const Vector difference = change - before;
      if (const double squared = difference.squaredNorm(); squared > 0.0)
        part = std::clamp(-part * before.dot(difference) / squared, kLeastPart, 1.0);
    }
    if (change.norm() <= kSameForces * (normal_ + change).norm()) return End::Settled;
    before = change;
    normal_ += part * change;
  }
}

/// Puts the bounds of the laws themselves in place of those of a Tresca problem.
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

/// Closes all pairs, and lets those stick whose laws restrict sliding.
void FrictionSearch::stick() {
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (rigid_.data().able[i]) states_[i] = laws_.of(rigid_.data().line[i]).rows(2) > 1 ? PairStatus::Stick : PairStatus::Slip;
  holders_.assign(states_.size(), 0);
  spent_ = holders_;
  met_.clear();
}

FrictionSearch::Result FrictionSearch::run(PairStates start, const Vector& normal) {
  holders_.assign(start.size(), 0);
  spent_ = holders_;
  states_ = guarded(start, start);
  patience_ = kBlockSteps;
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
      tresca = normalForces();
      states_ = guarded(projected(states_, answer_), states_);
    }
  }
  if (end != End::Failed) {
    tolerance_ = oracle_.loosest();
    end = limited(kNewtonSolves, oracle_.tightest());
    if (end == End::Settled && tresca.size() > 0) {
      const Vector found = normalForces();
      if (const double from = (normal - found).norm(); from > 0.0) contraction_ = (tresca - found).norm() / from;
    }
  }
  const auto goesOn = [&] { return end != End::Settled && outdone_.size() == 0 && left_ > 0 && oracle_.goesOn(); };
  if (goesOn()) outdone_ = outdone();
  if (goesOn()) {  // from the other side, before it is said
    const End first = end;
    stick();
    tolerance_ = oracle_.loosest();
    patience_ = kMoreBlockSteps;
    end = limited(kNewtonSolves, oracle_.tightest());
    if (end != End::Settled && first == End::Slides) end = first;
  }
  if (end == End::Exhausted && goesOn()) {
    end = fixedPoint();
    thaw();
  }
  Result result;
  result.converged = end == End::Settled;
  result.states = states_;
  result.solves = solves_;
  result.contraction = contraction_;
  if (end == End::Slides)
    result.slides = slides_;
  else if (!result.converged && outdone_.size() > 0) {
    // The motion of the proof opens pairs as their cones are wide; that of a body that slides keeps them.
    ClosedSet closed(states_.size(), 0);
    for (std::size_t i = 0; i < closed.size(); ++i) closed[i] = states_[i].closed() && rigid_.data().able[i];
    const Matrix kept = rigid_.loose(closed);
    result.slides = kept * (kept.transpose() * outdone_);
    if (!(result.slides.norm() > kDependentRows)) result.slides = outdone_;
  }
  if (end == End::Exhausted && result.slides.size() == 0) result.alternating = violated_;
  return result;
}

}  // namespace suture
