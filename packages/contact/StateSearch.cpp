#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/contact/PadProblem.hpp>
#include <suture/contact/StateSearch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double kStateTurned = 1.0;        // turn that is none, in parts of the tolerance of forces
constexpr double kStateSharper = 0.1;       // accuracy of the next solve, in parts of the turn that it makes
constexpr double kStateForcing = 0.1;       // accuracy of the next solve, in parts of the distance from the laws
constexpr double kComparable = 0.5;         // change of the accuracy up to which balances are compared with those before
constexpr int kStateHalvings = 9;           // halvings of a step
constexpr double kStateLeastFall = 2e-4;    // least fall of the squared distance, relative to it and to the step
constexpr double kStateProgress = 1e-6;     // relative fall of the distance that is one
constexpr int kStatePatience = 12;          // steps without a nearer balance, from the start
constexpr std::size_t kStateMeetings = 20;  // states that bodies meet on their way
constexpr double kStateLeastWay = 1e-2;     // first way tried, in parts of the shortest one after which something may change
constexpr double kStateMostWay = 1e3;       // last way tried, in parts of the longest such one
constexpr double kStateNoWork = 1e-11;      // work of forces in a motion that is none, relative to the largest
constexpr double kStateHolds = 0.1;         // way along a tangent, in parts of the motion's own, from which on a spring there holds it
constexpr int kShortPatience = 3;           // from states of the pads
constexpr int kShort = 7;                   // solves from there

struct Try {
  double tangential, softness;
  int times;
};
/// From the pads: the first constants, then others.
constexpr Try kTries[] = {{0.05, 1.0, 6}, {1.0, 0.5, 5}, {0.2, 2.0, 5}};

std::vector<FrictionCone> cones(const RigidContact& rigid, const LawProjection& projection) {
  std::vector<FrictionCone> all;
  for (int i = 0; i < rigid.pairs(); ++i) all.push_back(projection.cone(static_cast<std::size_t>(i)));
  return all;
}

}  // namespace

StateSearch::StateSearch(const RigidContact& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites, FrictionOracle& oracle,
                         int most)
    : rigid_(rigid),
      laws_(laws),
      oracle_(oracle),
      projection_(rigid, laws, sites),
      pads_(rigid.data(), cones(rigid, projection_)),
      left_(most) {}

PairStates StateSearch::start() {
  Matrix t = Matrix::Zero(rigid_.pairs(), 3);
  t.col(0) = rigid_.data().penetration;
  const PadModel::Equilibrium pads = pads_.coulomb(t, rigid_.compliance());
  guess_ = pads.force.col(0);
  return withHolders(padStates(pads));
}

/// States that the forces of pads mean.
PairStates StateSearch::padStates(const PadModel::Equilibrium& pads) const {
  PairStates all = states_;
  all.resize(static_cast<std::size_t>(rigid_.pairs()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (rigid_.isBound(i) && states_.empty()) all[i] = laws_.of(rigid_.data().line[i]).pressed();
    if (!rigid_.data().able[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    Point force{0, 0, 0}, jump{0, 0, 0};
    for (int k = 0; k < 3; ++k) force[k] = pads.force(at, k), jump[k] = pads.trial(at, k) - pads.force(at, k);
    all[i] = projection_.state(i, all[i], force, jump);
  }
  return all;
}

/// States of the pads beside a balance: always such that the bodies are held. False where the pads know none.
bool StateSearch::fromPads(const Balance& at, double softness, PairStates& found) const {
  const Vector compliance = softness * rigid_.compliance();
  const PadModel::Equilibrium pads =
      pads_.coulomb(compliance.asDiagonal() * at.force + at.jump, compliance, at.jump.rightCols(2).rowwise().norm());
  if (pads.found) found = padStates(pads);
  return pads.found;
}

/// True if neither loads nor pairs that slip do work in loose motions: nothing tells bodies where to go along them.
bool StateSearch::isNeutral(const PairStates& next, const Matrix& free) const {
  const RigidContact::Pairs& data = rigid_.data();
  double size = data.work.size() > 0 ? data.work.cwiseAbs().maxCoeff() : 0.0;  // largest force: the work of loads that balance is round-off
  if (guess_.size() > 0) size = std::max(size, guess_.cwiseAbs().maxCoeff());
  if (at_.force.size() > 0) size = std::max(size, at_.force.cwiseAbs().maxCoeff());
  if ((free.transpose() * data.work).cwiseAbs().maxCoeff() > kStateNoWork * size) return false;
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!data.able[i] || next[i].status != PairStatus::Slip || !projection_.rubs(i)) continue;
    for (const Matrix& tangent : data.tangents)
      if ((tangent.row(static_cast<Eigen::Index>(i)) * free).norm() > kDependentRows) return false;
  }
  return true;
}

/// Gives open pairs springs that hold loose motions, one along a tangent for each: as nothing does work in the motions they have no force
/// in balance, and they close no gap, as pairs that are glued would.
void StateSearch::holdBySprings(PairStates& next, Matrix free) const {
  const RigidContact::Pairs& data = rigid_.data();
  while (free.cols() > 0) {
    double most = kStateHolds;
    std::size_t best = next.size();
    Matrix bestWay;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!data.able[i] || next[i].closed() || next[i].across > 0.0 || !projection_.rubs(i) || !(projection_.tangentialStiffness(i) > 0.0))
        continue;
      Matrix way(static_cast<Eigen::Index>(data.tangents.size()), free.cols());
      for (Eigen::Index k = 0; k < way.rows(); ++k)
        way.row(k) = data.tangents[static_cast<std::size_t>(k)].row(static_cast<Eigen::Index>(i)) * free;
      if (const double size = way.norm(); size > most) most = size, best = i, bestWay = way;
    }
    if (best == next.size()) return;
    const Eigenpairs axes = symmetricEigenpairs(bestWay * bestWay.transpose());
    const Vector along = axes.vectors.rightCols(1);
    ContactState& state = next[best];
    state.direction = {0.0, along.size() == 2 ? along(1) : 0.0, -along(0)};  // acrossSlip() is the tangent
    state.across = projection_.tangentialStiffness(best);
    free = (free * nullSpace(along.transpose() * bestWay, kDependentRows)).eval();
  }
}

/// True if states are others than states_, springs of open pairs aside.
bool StateSearch::differs(const PairStates& next) const {
  for (std::size_t i = 0; i < next.size(); ++i)
    if (next[i] != states_[i] && (next[i].closed() || states_[i].closed())) return true;
  return false;
}

/// Open pairs with springs where a loose motion is neutral; else open or sliding pairs that stick where states leave a motion loose: linear
/// problems are never singular. They are violated pairs like others if they carry what their laws do not allow; then others are tried
/// first.
PairStates StateSearch::withHolders(PairStates next) const {
  std::vector<char> inVain(next.size(), 0);
  for (const int i : violated_) inVain[static_cast<std::size_t>(i)] = 1;
  const RigidContact::Pairs& data = rigid_.data();
  for (ContactState& state : next)
    if (!state.closed()) state = PairStatus::Open;
  Matrix free = rigid_.loose(next);
  if (free.cols() > 0 && isNeutral(next, free)) {
    holdBySprings(next, free);
    free = rigid_.loose(next);
  }
  while (free.cols() > 0) {
    double most = kDependentRows;
    std::size_t best = next.size();
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!data.able[i]) continue;
      const auto at = static_cast<Eigen::Index>(i);
      double size = next[i].closed() ? 0.0 : (data.rows.row(at) * free).norm();
      if (next[i].status != PairStatus::Stick && projection_.rubs(i))
        for (const Matrix& tangent : data.tangents) size = std::max(size, (tangent.row(at) * free).norm());
      // Closed pairs first: those that touch hold a body as they are.
      if (!next[i].closed()) size *= 1e-3;
      if (inVain[i]) size *= 1e-2;
      if (size > most) most = size, best = i;
    }
    if (best == next.size()) break;
    next[best].status = projection_.rubs(best) ? PairStatus::Stick : PairStatus::Slip;
    next[best].direction = {0, 0, 0};
    next[best].across = 0.0;
    const Matrix now = rigid_.loose(next);
    if (now.cols() >= free.cols()) break;
    free = now;
  }
  return next;
}

/// Moves bodies that `next` leaves loose rigidly along what the loads have beyond its forces, until the laws answer with states that hold
/// them better: forces stay in balance on the way. False where there are none, or none but those of a way before.
bool StateSearch::drag(const PairStates& next, PairStates& found) {
  const RigidContact::Pairs& data = rigid_.data();
  const Matrix free = rigid_.loose(next);
  if (free.cols() == 0) return false;
  Vector beyond = Vector::Zero(rigid_.motions()), parts = beyond;
  const auto add = [&](const Vector& forces) {
    beyond += forces;
    parts += forces.cwiseAbs();
  };
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!data.able[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const ContactState& state = next[i];
    if (!state.closed()) add(at_.force(at, 0) * data.rows.row(at).transpose());
    for (std::size_t k = 0; k < data.tangents.size(); ++k) {
      const auto component = static_cast<Eigen::Index>(k + 1);
      const double allowed = !state.closed() ? 0.0
                             : state.status == PairStatus::Stick && projection_.rubs(i)
                                 ? at_.force(at, component)
                                 : state.largest(at_.force(at, 0)) * state.direction[k + 1];
      add((at_.force(at, component) - allowed) * data.tangents[k].row(at).transpose());
    }
  }
  Vector motion = free * (free.transpose() * beyond);
  if (!(motion.norm() > kStateNoWork * parts.norm())) return false;
  motion.normalize();
  Matrix way = Matrix::Zero(at_.jump.rows(), 3);
  way.col(0) = data.rows * motion;
  for (std::size_t k = 0; k < data.tangents.size(); ++k) way.col(static_cast<Eigen::Index>(k + 1)) = data.tangents[k] * motion;
  double least = std::numeric_limits<double>::infinity(), most = 0.0;  // ways after which something may change
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (!data.able[i] || !(way.row(at).norm() > kDependentRows)) continue;
    const double length = states_[i].closed() ? at_.force.row(at).norm() / data.stiffness(at) : std::abs(at_.jump(at, 0));
    if (length > 0.0) least = std::min(least, length);
    most = std::max(most, length);
  }
  for (double length = kStateLeastWay * least; length <= kStateMostWay * most; length *= 2.0) {
    found = projection_.states(states_, at_.force, at_.jump + length * way);
    if (rigid_.loose(found).cols() >= free.cols()) continue;
    found = withHolders(std::move(found));
    if (std::find(met_.begin(), met_.end(), found) != met_.end()) continue;
    met_.push_back(found);
    return met_.size() <= kStateMeetings;
  }
  return false;
}

/// States that hold the bodies: where the forces of `next` cannot balance the loads, those that bodies meet on their way, or those of the
/// pads at the present balance.
PairStates StateSearch::held(PairStates next) {
  if (rigid_.motions() == 0) return next;
  std::vector<Eigen::Matrix3d> active(next.size(), Eigen::Matrix3d::Zero());
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!rigid_.data().able[i] || !next[i].closed()) continue;
    const ContactState& state = next[i];
    if (state.status == PairStatus::Stick && projection_.rubs(i))
      active[i].setIdentity();
    else
      active[i].col(0) = Eigen::Vector3d(1.0, state.friction * state.direction[1], state.friction * state.direction[2]).normalized();
  }
  PairStates other;
  if (drag(next, other)) return other;
  if (!pads_.balances(active) && fromPads(at_, 1.0, other)) {
    other = withHolders(std::move(other));
    if (other != states_) return other;
  }
  return withHolders(std::move(next));
}

/// Solves for states_; the states that the laws answer with. False where the solve failed.
bool StateSearch::solve(PairStates& next, double& turns) {
  --left_;
  ++solves_;
  FrictionAnswer answer = oracle_.solve(states_, tolerance_);
  if (!answer.solved) return false;
  answer_ = std::move(answer);
  next = projection_.believed(states_, answer_);
  violated_.clear();
  turns = 0.0;
  for (std::size_t i = 0; i < next.size(); ++i)
    if (states_[i].status == next[i].status)
      turns = std::max(turns, projection_.turn(i, next[i], answer_));
    else
      violated_.push_back(static_cast<int>(i));
  return true;
}

/// States are as good as the distance from the laws: accuracy follows it. Turns of slip need no more than a tenth of themselves.
void StateSearch::sharpen(double distance, double turns) {
  const double last = oracle_.tightest(), between = std::max(last, std::sqrt(last * oracle_.loosest()));
  if (violated_.empty()) {
    tolerance_ = std::max(last, std::min(tolerance_, kStateSharper * turns * tolerance_));
    return;
  }
  double size = 0.0;
  for (Eigen::Index i = 0; i < answer_.force.rows(); ++i) size += answer_.force.row(i).squaredNorm() / rigid_.data().stiffness(i);
  if (size > 0.0 && tolerance_ > between) tolerance_ = std::clamp(kStateForcing * std::sqrt(distance / size), between, tolerance_);
  if (tolerance_ <= last) tolerance_ = between;
}

/// From the present balance towards the answer: the first halving that lowers the distance; the whole step where none does.
/// \param next  gets the states there. False where they are those of the answer still.
bool StateSearch::step(PairStates& next) {
  const Matrix force = answer_.force - at_.force, jump = answer_.jump - at_.jump;
  double part = 1.0;
  bool lower = false;
  Balance to{answer_.force, answer_.jump, projection_.distance(states_, answer_.force, answer_.jump)};
  Balance nearest = to;
  double nearestPart = 1.0;
  for (int halving = 0; halving < kStateHalvings && !lower; ++halving) {
    if (halving > 0) {
      part *= 0.5;
      to = {at_.force + part * force, at_.jump + part * jump};
      to.distance = projection_.distance(states_, to.force, to.jump);
    }
    lower = to.distance < (1.0 - kStateLeastFall * part) * at_.distance;
    if (to.distance < nearest.distance) nearest = to, nearestPart = part;
  }
  const bool whole = !lower ? nearest.distance >= at_.distance : part == 1.0;
  if (!lower) to = nearest, part = nearestPart;
  at_ = whole ? Balance{answer_.force, answer_.jump, projection_.distance(states_, answer_.force, answer_.jump)} : to;
  if (whole) return true;
  next = projection_.states(states_, at_.force, at_.jump);
  return differs(next);
}

/// Newton's steps from states_ until the laws agree with an answer of the final accuracy.
StateSearch::End StateSearch::newton(int most, int patience) {
  const double last = oracle_.tightest();
  int since = 0;
  isNew_ = true;
  best_.distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most;) {
    if (!goesOn()) return End::Exhausted;
    PairStates next;
    double turns = 0.0;
    if (!solve(next, turns)) return End::Failed;
    ++k;
    if (violated_.empty() && turns <= kStateTurned) {
      // A pair that sticks since the start knows no bound yet.
      for (std::size_t i = 0; i < next.size(); ++i)
        if (states_[i].status == PairStatus::Stick && next[i].status == PairStatus::Stick) states_[i] = next[i];
      if (tolerance_ <= last) return End::Settled;
      // Directions turn by Newton's steps from there on: not all of them need be accurate.
      const double between = std::max(last, std::sqrt(last * oracle_.loosest()));
      const bool turning = std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.across > 0.0; });
      tolerance_ = turning && tolerance_ > between ? between : last;
      ++left_, --k;
      isNew_ = true;
      best_.distance = std::numeric_limits<double>::infinity();
      since = 0;
      continue;
    }
    const double own = projection_.distance(states_, answer_.force, answer_.jump), before = tolerance_;
    if (isNew_) {
      at_ = {answer_.force, answer_.jump, own};
      if (k == 1) first_ = at_;
      isNew_ = false;
    } else {
      PairStates stepped = next;
      bool moved = step(stepped);
      for (int again = 0; !moved && again < kStateHalvings; ++again) moved = step(stepped);  // the same linear problem: no solve
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
    states_ = std::move(next);
  }
  return End::Stalled;
}

/// Motion in which the loads overcome all that pairs can hold. The proof's own motion opens pairs as their cones are wide; that of a body
/// that slides keeps the closed ones.
Vector StateSearch::unbalanced() const {
  const Vector motion = pads_.unbalanced();
  if (motion.size() == 0) return motion;
  ClosedSet closed(states_.size(), 0);
  for (std::size_t i = 0; i < closed.size(); ++i) closed[i] = states_[i].closed() && rigid_.data().able[i];
  const Matrix kept = rigid_.loose(closed);
  const Vector slides = kept * (kept.transpose() * motion);
  return slides.norm() > kDependentRows ? slides : motion;
}

/// The first problem is one of Tresca's, with bounds by the normal forces of the pads: as good as the law's for a guess, symmetric, and
/// what its normal forces differ from those of the solution says how the fixed point of such problems contracts.
void StateSearch::solveByGuess() {
  const bool drags = std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.drags(); });
  if (guess_.size() == 0 || !drags || !goesOn()) return;
  const PairStates law = states_;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    states_[i].bound = states_[i].largest(guess_(static_cast<Eigen::Index>(i)));
    states_[i].friction = 0.0;
  }
  PairStates next;
  double turns = 0.0;
  if (solve(next, turns)) {
    tresca_ = normalForces();
    at_ = {answer_.force, answer_.jump, 0.0};
    states_ = held(projection_.states(law, answer_.force, answer_.jump));
  } else {
    states_ = law;
  }
}

Vector StateSearch::normalForces() const { return answer_.force.col(0).cwiseMax(0.0); }

/// Contraction of the fixed point of Tresca problems; negative: not known.
double StateSearch::contraction() const {
  const bool slips = std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.drags(); });
  if (!slips) return 0.0;  // no bound matters near the solution
  if (tresca_.size() == 0) return -1.0;
  const Vector found = normalForces();
  const double from = (guess_ - found).norm();
  return from > 0.0 ? (tresca_ - found).norm() / from : -1.0;
}

StateSearch::Result StateSearch::run(PairStates start) {
  Result result;
  result.states = states_ = withHolders(std::move(start));
  result.slides = unbalanced();
  if (result.slides.size() > 0) return result;
  tolerance_ = oracle_.loosest();
  solveByGuess();
  End end = newton(std::numeric_limits<int>::max(), kStatePatience);
  for (const Try& own : kTries) {
    projection_.setTangential(own.tangential);
    for (int k = 0; k < own.times && end != End::Settled && goesOn() && answer_.force.size() > 0; ++k) {
      const Balance from = k % 2 == 0 ? best_ : first_;
      PairStates next;
      if (from.force.size() == 0 || !fromPads(from, own.softness, next)) break;
      states_ = withHolders(std::move(next));
      tolerance_ = std::max(oracle_.tightest(), std::sqrt(oracle_.tightest() * oracle_.loosest()));
      end = newton(kShort, kShortPatience);
    }
  }
  result.converged = end == End::Settled;
  if (result.converged) result.contraction = contraction();
  result.states = states_;
  for (ContactState& state : result.states)
    if (!state.closed()) state = PairStatus::Open;  // without springs
  result.solves = solves_;
  if (!result.converged && end != End::Failed) result.alternating = violated_;
  return result;
}

}  // namespace suture
