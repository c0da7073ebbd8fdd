#include <suture/search/Collapse.hpp>
#include <suture/search/DualAscent.hpp>
#include <suture/search/HalfPlaneModel.hpp>
#include <suture/search/StateSearch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace suture {

namespace {

constexpr double kStateTurned = 1.0;   // turn that counts as zero, relative to the tolerance of forces
constexpr double kStateSharper = 0.1;  // accuracy of the next solve, relative to the turn in the current one
// Accuracy of the next solve, relative to the distance from the laws. A stack of 20 leaves needs 33 solves with .1, 22 with .03, 17 with
// .01, 10 with .001. In 283 random scenes .03 and .01 take 1 and 3 % more conjugate gradient iterations than .1, and 1 and 2 % fewer
// solves.
constexpr double kStateForcing = 0.01;
constexpr double kComparable = 0.5;  // change of the accuracy up to which solutions are comparable with earlier ones
constexpr double kNearStart = 0.75;  // accuracy of the first solve near the solution, as a power of the range of accuracies
constexpr int kStateShorter = 18;    // maximum number of times that a step is shortened
// Ratio of successive steps. Shipped scenes need 668 solves with .5, 665 with .7, 668 with .8, 671 with .9; a bolted joint in 3D 14, 12, 11
// and 12; 300 random scenes with friction 1,419 with .5, 1,425 with .65, 1,342 with .7, and the same ones are solved.
constexpr double kStateRatio = 0.7;
constexpr double kStateLeastFall = 2e-4;  // least decrease of the squared distance, relative to it and to the step
constexpr double kStateProgress = 1e-6;   // relative decrease of the distance that counts as progress
constexpr int kStatePatience = 12;        // steps without progress, from the initial states
constexpr double kStateTouches = 1e-10;   // force relative to that on the less loaded body, below which a pair only touches
constexpr int kShortPatience = 3;         // steps without progress, from states of the pads
constexpr int kShort = 7;                 // maximum number of solves from there
// Tension relative to compression at which pairs bend a body rather than carry its loads. A coin needs 5 to 51 solves with .9, 5 to 78
// with .7 and .8; in 600 random scenes without soft supports .8 and .9 would change one solve of 1,720, .7 would add 41.
constexpr double kPulled = 0.9;
constexpr int kPredicted = 3;  // solves whose next states come from half-planes; later ones differ by single pairs

constexpr double kCollapsed = 1.02;  // friction multiple at a limit equilibrium above which no other states are tried

struct Try {
  double tangential, softness;
  int times;
};
/// Restarts from the pads: first with the initial constants, then with others.
constexpr Try kTries[] = {{0.05, 1.0, 6}, {1.0, 0.5, 5}, {0.2, 2.0, 5}};

}  // namespace

StateSearch::StateSearch(const RigidBodyModel& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites,
                         LinearContactSolver& solver, int most, const Vector& normal)
    : rigid_(rigid),
      laws_(laws),
      sites_(sites),
      solver_(solver),
      projection_(rigid, laws, sites, normal),
      pads_(rigid, laws, projection_),
      stabilising_(rigid, projection_),
      driven_(rigid, projection_, stabilising_),
      left_(most) {}

StateSearch::StateSearch(const RigidBodyModel& rigid, LinearContactSolver& solver, int most)
    : rigid_(rigid),
      bare_(static_cast<std::size_t>(rigid.pairs())),
      laws_(none_),
      sites_(bare_),
      solver_(solver),
      projection_(rigid, none_, bare_),
      pads_(rigid, none_, projection_),
      stabilising_(rigid, projection_),
      driven_(rigid, projection_, stabilising_),
      left_(most) {}

PairStates StateSearch::start() { return stabilised(pads_.start(guess_)); }

/// Largest force known so far.
double StateSearch::largest() const {
  double size = 0.0;
  if (const Vector& work = rigid_.data().work; work.size() > 0) size = work.cwiseAbs().maxCoeff();
  if (guess_.size() > 0) size = std::max(size, guess_.cwiseAbs().maxCoeff());
  if (at_.force.size() > 0) size = std::max(size, at_.force.cwiseAbs().maxCoeff());
  return size;
}

PairStates StateSearch::stabilised(PairStates next) const { return stabilising_.addedTo(std::move(next), largest(), violated_); }

/// True if states differ from states_, disregarding springs of open pairs.
bool StateSearch::differs(const PairStates& next) const {
  for (std::size_t i = 0; i < next.size(); ++i)
    if (next[i] != states_[i] && (next[i].closed() || states_[i].closed())) return true;
  return false;
}

/// True if the last solution contains little information about contact on softly held bodies: their closed pairs bend bodies towards each
/// other, so that tension balances compression, or, once that has happened, more pairs would close than are closed. \param next  states by
/// the laws
bool StateSearch::arePulled(const PairStates& next) {
  if (!isFrictionless() || !rigid_.soft()) return false;
  const double tension = -answer_.force.col(0).cwiseMin(0.0).sum(), compression = answer_.force.col(0).cwiseMax(0.0).sum();
  const bool areNow = tension > kPulled * compression;
  werePulled_ = werePulled_ || areNow;
  int closed = 0, closing = 0;
  for (std::size_t i = 0; i < next.size(); ++i) {
    closed += states_[i].closed();
    closing += next[i].closed() && !states_[i].closed();
  }
  return areNow || (werePulled_ && closing > closed);
}

/// States that hold the bodies: if the forces of `next` cannot balance the loads, the states that driven bodies reach, or those of the pads
/// at the current solution.
PairStates StateSearch::held(PairStates next) {
  if (rigid_.motions() == 0 && !rigid_.soft()) return next;
  if (isFrictionless()) {
    PairStates other;
    const bool isLoose = pads_.loosens(next);
    return stabilised(isLoose && pads_.near(at_, 1.0, states_, other) ? std::move(other) : std::move(next));
  }
  std::vector<Eigen::Matrix3d> active(next.size(), Eigen::Matrix3d::Zero());
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!rigid_.data().canChange[i] || !next[i].closed()) continue;
    const ContactState& state = next[i];
    if (state.status == PairStatus::Stick && projection_.restrictsSliding(i))
      active[i].setIdentity();
    else
      active[i].col(0) = Eigen::Vector3d(1.0, state.friction * state.direction[1], state.friction * state.direction[2]).normalized();
  }
  PairStates other;
  if (driven_.advance(states_, at_, next, largest(), violated_, other)) return other;
  if (!pads_.model().balances(active) && pads_.near(at_, 1.0, states_, other)) {
    other = stabilised(std::move(other));
    if (other != states_) return other;
  }
  return stabilised(std::move(next));
}

/// Solves for states_. Without friction, motions in which no force does work are held by closing open pairs, which then carry no force.
/// Along these motions the bodies are then moved to where open pairs penetrate least.
ContactAnswer StateSearch::solveHeld() {
  const Matrix free = isFrictionless() && rigid_.motions() > 0 ? rigid_.loose(states_) : Matrix();
  const std::vector<int> stabilisingPairs = free.cols() > 0 ? rigid_.stabilisingPairs(closedSet(states_), free) : std::vector<int>();
  PairStates held = states_;
  for (const int i : stabilisingPairs) held[static_cast<std::size_t>(i)] = PairStatus::Slip;
  ContactAnswer answer = solver_.solve(held, tolerance_);
  if (!answer.solved || free.cols() == 0) return answer;
  for (const int i : stabilisingPairs) answer.force.row(i).setZero();
  const ClosedSet closed = closedSet(states_);
  const Vector motion = free * rigid_.settle(closed, answer.jump.col(0), free);
  if (motion.isZero(0.0)) return answer;
  const Vector moved = rigid_.data().rows * motion;
  for (std::size_t i = 0; i < closed.size(); ++i)
    if (!closed[i]) answer.jump(static_cast<Eigen::Index>(i), 0) += moved(static_cast<Eigen::Index>(i));
  solver_.move(motion);
  return answer;
}

/// Holders have moved bodies until their gaps close. Moves these back, along motions that change no force, to the least motion: large ones
/// cost digits.
void StateSearch::moveLeast() {
  const Vector motion = isFrictionless() ? solver_.motion() : Vector();
  if (motion.size() != rigid_.motions() || motion.size() == 0) return;
  const Vector force = normalForces(), scale = rigid_.bodyScale(closedSet(states_), force);
  ClosedSet carrying(states_.size(), 0);
  for (std::size_t i = 0; i < carrying.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    carrying[i] = states_[i].closed() && force(at) > std::max(answer_.forceTolerance(at), kStateTouches * scale(at));
  }
  const Vector further = rigid_.leastMotion(carrying, motion, answer_.jump.col(0)) - motion;
  if (!further.isZero(0.0)) solver_.move(further);
}

/// Next states corrected by the half-plane model near the ends of contact zones.
PairStates StateSearch::predicted(PairStates next) const {
  const ClosedSet flipped = closedSet(next),
                  set = HalfPlaneModel(rigid_).closedSet(closedSet(states_), flipped, answer_.force.col(0), answer_.jump.col(0));
  for (std::size_t i = 0; i < next.size(); ++i)
    if (set[i] != flipped[i]) next[i] = set[i] ? PairStatus::Slip : PairStatus::Open;
  return next;
}

/// Solves for states_; `next` receives the states that the laws give. False if the solve failed.
bool StateSearch::solve(PairStates& next, double& turns) {
  --left_;
  ++solves_;
  ContactAnswer answer = solveHeld();
  if (!answer.solved) return false;
  answer_ = std::move(answer);
  next = projection_.atSolution(states_, answer_);
  violated_.clear();
  turns = 0.0;
  for (std::size_t i = 0; i < next.size(); ++i)
    if (states_[i].status == next[i].status)
      turns = std::max(turns, projection_.turn(i, next[i], answer_));
    else
      violated_.push_back(static_cast<int>(i));
  return true;
}

/// Tolerance of the solves that follow a solve of the final accuracy. If that has disproved states of an inaccurate solve, later solves are
/// more accurate: equally inaccurate ones would find the same states again.
double StateSearch::between() const {
  const double last = solver_.tightest();
  return std::max(last, std::min(disproved_, std::sqrt(last * solver_.loosest())));
}

/// The accuracy of states is limited by the distance from the laws, and that of solves follows it. If only slip turns, a tenth of the turn
/// is sufficient.
void StateSearch::sharpen(double distance, double turns) {
  const double last = solver_.tightest(), between = this->between();
  if (violated_.empty()) {
    tolerance_ = std::max(last, std::min(tolerance_, kStateSharper * turns * tolerance_));
    return;
  }
  double size = 0.0;
  for (Eigen::Index i = 0; i < answer_.force.rows(); ++i) size += answer_.force.row(i).squaredNorm() / rigid_.data().stiffness(i);
  if (size > 0.0 && tolerance_ > between) tolerance_ = std::clamp(kStateForcing * std::sqrt(distance / size), between, tolerance_);
  if (tolerance_ <= last) tolerance_ = between;
}

/// Step from the current state towards the solution: the longest tried one that reduces the distance; if none does, the whole step with
/// friction, and the one that comes nearest to the laws without.
/// \param next  receives the states there. False if they are still those of the last solve.
bool StateSearch::step(PairStates& next) {
  double part = 1.0;
  bool lower = false;
  ContactBalance to{answer_.force, answer_.jump, projection_.distance(states_, answer_.force, answer_.jump)};
  ContactBalance nearest = to;
  double nearestPart = 1.0;
  for (int shorter = 0; shorter < kStateShorter && !lower; ++shorter) {
    if (shorter > 0) {
      part *= kStateRatio;
      to = at_.towards(answer_.force, answer_.jump, part);
      to.distance = projection_.distance(states_, to.force, to.jump);
    }
    lower = to.distance < (1.0 - kStateLeastFall * part) * at_.distance;
    if (to.distance < nearest.distance) nearest = to, nearestPart = part;
  }
  if (!lower) to = nearest, part = nearestPart;
  // With friction the distance has local minima, which full steps leave. Without friction they only lead away.
  const bool whole = part == 1.0 || (!lower && !isFrictionless() && nearest.distance >= at_.distance);
  at_ = whole ? ContactBalance{answer_.force, answer_.jump, projection_.distance(states_, answer_.force, answer_.jump)} : to;
  if (whole) return true;
  next = projection_.states(states_, at_.force, at_.jump);
  return differs(next);
}

/// Newton steps from states_ until the laws agree with a solution of the final accuracy.
StateSearch::End StateSearch::newton(int most, int patience) {
  int since = 0;
  bool isProof = false;           // the next solve is to prove, at the final accuracy, what a less accurate one found
  std::vector<PairStates> tried;  // without friction, at the current accuracy: a state that recurs leads nowhere new
  isNew_ = true;
  best_.distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most;) {
    if (!goesOn()) return End::Exhausted;
    const double last = solver_.tightest();  // it may change with each solve
    PairStates next;
    double turns = 0.0;
    if (!solve(next, turns)) return End::Failed;
    ++k;
    if (violated_.empty() && turns <= kStateTurned) {
      // A pair that has been sticking since the start does not have a bound yet.
      for (std::size_t i = 0; i < next.size(); ++i)
        if (states_[i].status == PairStatus::Stick && next[i].status == PairStatus::Stick) states_[i] = next[i];
      if (tolerance_ <= last) return End::Settled;
      // The remaining Newton steps only turn directions: not all of them need be accurate.
      const double between = this->between();
      const bool turning =
          std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.transverseStiffness > 0.0; });
      tolerance_ = turning && tolerance_ > between ? between : last;
      isProof = tolerance_ <= last;
      ++left_, --k;
      isNew_ = true;
      best_.distance = std::numeric_limits<double>::infinity();
      since = 0;
      continue;
    }
    if (std::exchange(isProof, false)) disproved_ = std::max(last, std::sqrt(last * between()));
    const bool pulled = arePulled(next);
    if (isFrictionless() && predicts_ && solves_ <= kPredicted) next = predicted(std::move(next));
    const double own = projection_.distance(states_, answer_.force, answer_.jump), before = tolerance_;
    if (isNew_) {
      at_ = {answer_.force, answer_.jump, own};
      if (k == 1 && (patience < kStatePatience || first_.force.size() == 0)) first_ = at_;
      isNew_ = false;
    } else {
      PairStates stepped = next;
      bool moved = step(stepped);
      for (int again = 0; !moved && again < kStateShorter; ++again) moved = step(stepped);  // the same linear problem: no solve
      if (moved) next = stepped;
    }
    sharpen(at_.distance, turns);
    if (at_.distance < (1.0 - kStateProgress) * best_.distance) {
      best_ = at_;
      since = 0;
    } else if (++since > patience) {
      return End::Stalled;
    }
    if (tolerance_ < kComparable * before) isNew_ = true;
    next = held(std::move(next));
    if (pulled && pads_.near({answer_.force, answer_.jump, 0.0}, 1.0, states_, next)) {
      next = stabilised(std::move(next));
      isNew_ = true;  // farther from the laws, and nearer to the solution
    }
    if (isFrictionless()) {
      if (tolerance_ != before) tried.clear();
      tried.push_back(states_);
      if (std::find(tried.begin(), tried.end(), next) != tried.end()) {
        if (tolerance_ <= last) return End::Stalled;
        tolerance_ = last;  // only accurate forces can decide
        isNew_ = true;
      }
      if (!goesOn()) return End::Exhausted;  // with the states of the last solution
    }
    states_ = std::move(next);
  }
  return End::Stalled;
}

/// The motion of the proof opens pairs because of the widths of their cones; the motion of a sliding body keeps closed pairs closed.
Vector StateSearch::unbalanced(const PairStates& states) const {
  const Vector motion = pads_.model().unbalanced();
  if (motion.size() == 0) return motion;
  ClosedSet closed(states.size(), 0);
  for (std::size_t i = 0; i < closed.size(); ++i) closed[i] = states[i].closed() && rigid_.data().canChange[i];
  const Matrix kept = rigid_.loose(closed);
  const Vector slides = kept * (kept.transpose() * motion);
  return slides.norm() > kDependentRows ? slides : motion;
}

/// The first problem is a Tresca problem with bounds from the normal forces of the pads: as good an initial guess as Coulomb's law, and
/// symmetric. The difference of its normal forces from those of the solution measures the contraction of the Tresca fixed point.
void StateSearch::solveByGuess() {
  const bool couples = std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.couplesToNormal(); });
  if (guess_.size() == 0 || !couples || !goesOn()) return;
  const PairStates law = states_;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    states_[i].bound = states_[i].largest(guess_(static_cast<Eigen::Index>(i)));
    states_[i].friction = 0.0;
  }
  PairStates next;
  double turns = 0.0;
  if (solve(next, turns)) {
    tresca_ = normalForces();
    at_ = best_ = first_ = {answer_.force, answer_.jump, 0.0};
    states_ = held(projection_.states(law, answer_.force, answer_.jump));
  } else {
    states_ = law;
  }
}

Vector StateSearch::normalForces() const { return answer_.force.col(0).cwiseMax(0.0); }

/// Contraction of the fixed point of Tresca problems; negative: unknown.
double StateSearch::contraction() const {
  const bool slips = std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.couplesToNormal(); });
  if (!slips) return 0.0;  // no bound affects the solution
  if (tresca_.size() == 0) return -1.0;
  const Vector found = normalForces();
  const double from = (guess_ - found).norm();
  return from > 0.0 ? (tresca_ - found).norm() / from : -1.0;
}

/// All pairs closed; those whose laws restrict sliding stick.
PairStates StateSearch::sticking() const {
  PairStates all = states_;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (rigid_.data().canChange[i]) all[i] = projection_.restrictsSliding(i) ? PairStatus::Stick : PairStatus::Slip;
  return all;
}

/// True if bodies slide as a whole beyond doubt: other states would need very different normal forces.
bool StateSearch::collapses(Result& result) {
  if (answer_.force.size() == 0) return false;
  // Runs even if no solves are left for the search, because the reason of failure is worth them.
  const Collapse::Result found = Collapse(rigid_, laws_, sites_, solver_).find(states_, normalForces(), Collapse::kSolves);
  solves_ += found.solves;
  left_ = std::max(0, left_ - found.solves);
  result.slides = found.motion;
  result.multiple = found.multiple;
  return found.multiple > kCollapsed;
}

/// Frictionless contact is a convex problem: from the pads at the best state, the dual energy increases until the laws hold.
StateSearch::End StateSearch::ascend() {
  const ContactBalance& from = best_.force.size() > 0 ? best_ : first_;
  if (from.force.size() == 0) return End::Stalled;
  const PadModel::Equilibrium pads = pads_.equilibrium(from, 1.0);
  if (!pads.found) return End::Stalled;
  End end = End::Stalled;
  const auto solve = [&](const ClosedSet& closed) -> const ContactAnswer* {
    if (!goesOn()) end = End::Exhausted;
    if (end == End::Exhausted) return nullptr;
    for (std::size_t i = 0; i < closed.size(); ++i)
      if (rigid_.data().canChange[i]) states_[i] = closed[i] ? PairStatus::Slip : PairStatus::Open;
    tolerance_ = solver_.tightest();
    PairStates next;
    double turns = 0.0;
    if (this->solve(next, turns)) return &answer_;
    end = End::Failed;
    return nullptr;
  };
  return DualAscent(rigid_, solve).run(pads.force.col(0)) ? End::Settled : end;
}

/// Newton from all pairs sticking, and then from states of the pads, with other constants.
StateSearch::End StateSearch::restart(End end) {
  for (const Try& own : kTries) {
    projection_.setTangential(own.tangential);
    for (int k = &own == kTries ? -1 : 0; k < own.times && end != End::Settled && goesOn(); ++k) {
      PairStates next = sticking();
      if (k >= 0 && !pads_.near(k % 2 == 0 ? best_ : first_, own.softness, states_, next)) break;
      states_ = stabilised(std::move(next));
      tolerance_ = std::max(solver_.tightest(), std::sqrt(solver_.tightest() * solver_.loosest()));
      end = k < 0 ? newton(std::numeric_limits<int>::max(), kStatePatience) : newton(kShort, kShortPatience);
    }
  }
  return end;
}

StateSearch::Result StateSearch::run(PairStates start, Start nearness) {
  Result result;
  result.states = states_ = stabilised(projection_.isFrozen() ? projection_.refrozen(std::move(start)) : std::move(start));
  if (!projection_.isFrozen()) result.slides = unbalanced(states_);
  if (result.slides.size() > 0) return result;
  const double last = solver_.tightest(), first = solver_.loosest();
  tolerance_ = nearness == Start::Guess ? first : last;
  if (nearness == Start::Near && last > 0.0) tolerance_ = last * std::pow(first / last, kNearStart);
  solveByGuess();
  End end = newton(std::numeric_limits<int>::max(), kStatePatience);
  if (end != End::Settled && isFrictionless())
    end = end == End::Stalled ? ascend() : end;
  else if (end != End::Settled && (projection_.isFrozen() || !collapses(result)))
    end = restart(end);
  result.converged = end == End::Settled;
  if (result.converged) {
    moveLeast();
    result.slides.resize(0);
    result.contraction = contraction();
  }
  result.states = states_;
  for (ContactState& state : result.states)
    if (!state.closed()) state = PairStatus::Open;  // without springs
  if (answer_.force.size() > 0) result.normal = normalForces();
  result.solves = solves_;
  if (!result.converged && end != End::Failed && result.slides.size() == 0 && solves_ > 1) result.alternating = violated_;
  return result;
}

}  // namespace suture
