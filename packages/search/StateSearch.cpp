#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/search/Collapse.hpp>
#include <suture/search/DualAscent.hpp>
#include <suture/search/HalfPlaneModel.hpp>
#include <suture/search/StateSearch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double kStateTurned = 1.0;        // turn that counts as zero, relative to the tolerance of forces
constexpr double kStateSharper = 0.1;       // accuracy of the next solve, relative to the turn in the current one
constexpr double kStateForcing = 0.1;       // accuracy of the next solve, relative to the distance from the laws
constexpr double kComparable = 0.5;         // change of the accuracy up to which solutions are comparable with earlier ones
constexpr int kStateHalvings = 9;           // halvings of a step
constexpr double kStateLeastFall = 2e-4;    // least decrease of the squared distance, relative to it and to the step
constexpr double kStateProgress = 1e-6;     // relative decrease of the distance that counts as progress
constexpr int kStatePatience = 12;          // steps without progress, from the initial states
constexpr std::size_t kStateMeetings = 20;  // maximum number of states to which bodies are moved
constexpr double kStateLeastWay = 1e-2;     // first displacement tried, relative to the shortest one after which something may change
constexpr double kStateMostWay = 1e3;       // last displacement tried, relative to the longest such one
constexpr double kStateNoWork = 1e-11;      // work of forces in a motion that counts as zero, relative to the largest force
constexpr double kStateHolds = 0.1;  // displacement along a tangent, relative to the motion, above which a spring there holds the motion
constexpr double kStateTouches = 1e-10;  // force relative to that on the less loaded body, below which a pair only touches
constexpr int kShortPatience = 3;        // steps without progress, from states of the pads
constexpr int kShort = 7;                // maximum number of solves from there
constexpr int kPredicted = 3;            // solves whose next states come from half-planes; later ones differ by single pairs

constexpr double kCollapsed = 1.02;  // friction multiple at a limit equilibrium above which no other states are tried

struct Try {
  double tangential, softness;
  int times;
};
/// Restarts from the pads: first with the initial constants, then with others.
constexpr Try kTries[] = {{0.05, 1.0, 6}, {1.0, 0.5, 5}, {0.2, 2.0, 5}};

std::vector<FrictionCone> cones(const RigidContact& rigid, const LawProjection& projection) {
  std::vector<FrictionCone> all;
  for (int i = 0; i < rigid.pairs(); ++i) all.push_back(projection.cone(static_cast<std::size_t>(i)));
  return all;
}

}  // namespace

StateSearch::StateSearch(const RigidContact& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites,
                         LinearContactSolver& solver, int most, const Vector& normal)
    : rigid_(rigid),
      laws_(laws),
      sites_(sites),
      solver_(solver),
      projection_(rigid, laws, sites, normal),
      pads_(rigid.data(), cones(rigid, projection_)),
      left_(most) {
  isFrictionless_ = true;
  for (std::size_t i = 0; i < rigid_.data().line.size(); ++i)
    isFrictionless_ = isFrictionless_ && !(rigid_.data().canChange[i] && projection_.rubs(i));
}

StateSearch::StateSearch(const RigidContact& rigid, LinearContactSolver& solver, int most)
    : rigid_(rigid),
      bare_(static_cast<std::size_t>(rigid.pairs())),
      laws_(none_),
      sites_(bare_),
      solver_(solver),
      projection_(rigid, none_, bare_),
      pads_(rigid.data(), std::vector<FrictionCone>(bare_.size())),
      isFrictionless_(true),
      left_(most) {}

PairStates StateSearch::start() {
  Matrix t = Matrix::Zero(rigid_.pairs(), 3);
  t.col(0) = rigid_.data().penetration;
  const PadModel::Equilibrium pads = pads_.coulomb(t, rigid_.compliance());
  guess_ = pads.force.col(0);
  return withStabilisingPairs(padStates(pads));
}

/// States that correspond to forces of the pads.
PairStates StateSearch::padStates(const PadModel::Equilibrium& pads) const {
  PairStates all = states_;
  all.resize(static_cast<std::size_t>(rigid_.pairs()));
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (rigid_.isBound(i) && states_.empty()) all[i] = laws_.of(rigid_.data().line[i]).pressed();
    if (!rigid_.data().canChange[i]) continue;
    const auto at = static_cast<Eigen::Index>(i);
    Point force{0, 0, 0}, jump{0, 0, 0};
    for (int k = 0; k < 3; ++k) force[k] = pads.force(at, k), jump[k] = pads.trial(at, k) - pads.force(at, k);
    all[i] = projection_.state(i, all[i], force, jump);
  }
  return all;
}

/// Equilibrium on the pads near a solution.
PadModel::Equilibrium StateSearch::padsAt(const Balance& at, double softness) const {
  const Vector compliance = softness * rigid_.compliance();
  if (!isFrictionless_)
    return pads_.coulomb(compliance.asDiagonal() * at.force + at.jump, compliance, at.jump.rightCols(2).rowwise().norm());
  const Vector t = rigid_.compliance().cwiseProduct(at.force.col(0)) + at.jump.col(0);
  const RigidContact::Equilibrium found = rigid_.project(t);  // accurate for light bodies, too
  PadModel::Equilibrium pads;
  pads.found = found.found;
  pads.motion = found.motion;
  pads.force = pads.trial = Matrix::Zero(t.size(), 3);
  pads.force.col(0) = found.force;
  pads.trial.col(0) = rigid_.motions() > 0 ? Vector(t + rigid_.data().rows * found.motion) : t;
  pads.trial.col(0) = pads.trial.col(0).cwiseQuotient(rigid_.compliance()).eval();
  for (Eigen::Index i = 0; i < t.size(); ++i)
    if (found.force(i) > 0.0) pads.trial(i, 0) = found.force(i);
  return pads;
}

/// States of the pads near a solution; they always hold the bodies. False if the pads have no equilibrium.
bool StateSearch::fromPads(const Balance& at, double softness, PairStates& found) const {
  if (at.force.size() == 0) return false;
  const PadModel::Equilibrium pads = padsAt(at, softness);
  if (pads.found) found = padStates(pads);
  return pads.found;
}

/// True if neither loads nor slipping pairs do work in free motions: the position of bodies along them is arbitrary.
bool StateSearch::isNeutral(const PairStates& next, const Matrix& free) const {
  const RigidContact::Pairs& data = rigid_.data();
  if (isFrictionless_)
    return ((free.transpose() * data.work).cwiseAbs().array() <=
            kStateNoWork * (free.cwiseAbs().transpose() * data.work.cwiseAbs()).array())
        .all();
  double size = data.work.size() > 0 ? data.work.cwiseAbs().maxCoeff() : 0.0;  // largest force: the work of loads that balance is round-off
  if (guess_.size() > 0) size = std::max(size, guess_.cwiseAbs().maxCoeff());
  if (at_.force.size() > 0) size = std::max(size, at_.force.cwiseAbs().maxCoeff());
  if ((free.transpose() * data.work).cwiseAbs().maxCoeff() > kStateNoWork * size) return false;
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!data.canChange[i] || next[i].status != PairStatus::Slip || !projection_.rubs(i)) continue;
    for (const Matrix& tangent : data.tangents)
      if ((tangent.row(static_cast<Eigen::Index>(i)) * free).norm() > kDependentRows) return false;
  }
  return true;
}

/// Adds springs along tangents of open pairs, one per free motion. No force does work in these motions, so the springs have no force at
/// equilibrium. In contrast to glued pairs, they close no gap.
void StateSearch::holdBySprings(PairStates& next, Matrix free) const {
  const RigidContact::Pairs& data = rigid_.data();
  while (free.cols() > 0) {
    double most = kStateHolds;
    std::size_t best = next.size();
    Matrix bestWay;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!data.canChange[i] || next[i].closed() || next[i].transverseStiffness > 0.0 || !projection_.rubs(i) ||
          !(projection_.tangentialStiffness(i) > 0.0))
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
    state.transverseStiffness = projection_.tangentialStiffness(best);
    free = (free * nullSpace(along.transpose() * bestWay, kDependentRows)).eval();
  }
}

/// True if states differ from states_, disregarding springs of open pairs.
bool StateSearch::differs(const PairStates& next) const {
  for (std::size_t i = 0; i < next.size(); ++i)
    if (next[i] != states_[i] && (next[i].closed() || states_[i].closed())) return true;
  return false;
}

/// Adds springs to open pairs if a free motion is neutral; otherwise lets open or sliding pairs stick until no motion is free. Linear
/// problems are thus never singular. Pairs whose force then exceeds their law are violated like others, and in the next call other pairs
/// are preferred.
PairStates StateSearch::withStabilisingPairs(PairStates next) const {
  std::vector<char> inVain(next.size(), 0);
  for (const int i : violated_) inVain[static_cast<std::size_t>(i)] = 1;
  const RigidContact::Pairs& data = rigid_.data();
  for (ContactState& state : next)
    if (!state.closed()) state = PairStatus::Open;
  Matrix free = rigid_.loose(next);
  if (free.cols() > 0 && isNeutral(next, free)) {
    if (isFrictionless_) return next;  // held in solveHeld()
    holdBySprings(next, free);
    free = rigid_.loose(next);
  }
  while (free.cols() > 0) {
    double most = kDependentRows;
    std::size_t best = next.size();
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (!data.canChange[i]) continue;
      const auto at = static_cast<Eigen::Index>(i);
      double size = next[i].closed() ? 0.0 : (data.rows.row(at) * free).norm();
      if (next[i].status != PairStatus::Stick && projection_.rubs(i))
        for (const Matrix& tangent : data.tangents) size = std::max(size, (tangent.row(at) * free).norm());
      // Closed pairs first: they hold a body where it is.
      if (!next[i].closed()) size *= 1e-3;
      if (inVain[i]) size *= 1e-2;
      if (size > most) most = size, best = i;
    }
    if (best == next.size()) break;
    next[best].status = projection_.rubs(best) ? PairStatus::Stick : PairStatus::Slip;
    next[best].direction = {0, 0, 0};
    next[best].transverseStiffness = 0.0;
    const Matrix now = rigid_.loose(next);
    if (now.cols() >= free.cols()) break;
    free = now;
  }
  return next;
}

/// Moves bodies that `next` leaves unconstrained rigidly along the excess of the loads over its forces, until the laws give states that
/// hold them better; forces stay in equilibrium. False if there are none, or only states reached before.
bool StateSearch::advance(const PairStates& next, PairStates& found) {
  const RigidContact::Pairs& data = rigid_.data();
  const Matrix free = rigid_.loose(next);
  if (free.cols() == 0) return false;
  Vector beyond = Vector::Zero(rigid_.motions()), parts = beyond;
  const auto add = [&](const Vector& forces) {
    beyond += forces;
    parts += forces.cwiseAbs();
  };
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!data.canChange[i]) continue;
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
  double least = std::numeric_limits<double>::infinity(), most = 0.0;  // displacements after which something may change
  for (std::size_t i = 0; i < next.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    if (!data.canChange[i] || !(way.row(at).norm() > kDependentRows)) continue;
    const double length = states_[i].closed() ? at_.force.row(at).norm() / data.stiffness(at) : std::abs(at_.jump(at, 0));
    if (length > 0.0) least = std::min(least, length);
    most = std::max(most, length);
  }
  for (double length = kStateLeastWay * least; length <= kStateMostWay * most; length *= 2.0) {
    found = projection_.states(states_, at_.force, at_.jump + length * way);
    if (rigid_.loose(found).cols() >= free.cols()) continue;
    found = withStabilisingPairs(std::move(found));
    if (std::find(met_.begin(), met_.end(), found) != met_.end()) continue;
    met_.push_back(found);
    return met_.size() <= kStateMeetings;
  }
  return false;
}

/// States that hold the bodies: if the forces of `next` cannot balance the loads, the states that driven bodies reach, or those of the pads
/// at the current solution.
PairStates StateSearch::held(PairStates next) {
  if (rigid_.motions() == 0) return next;
  if (isFrictionless_) {
    PairStates other;
    const bool isLoose = rigid_.loosens(next);
    return withStabilisingPairs(isLoose && fromPads(at_, 1.0, other) ? std::move(other) : std::move(next));
  }
  std::vector<Eigen::Matrix3d> active(next.size(), Eigen::Matrix3d::Zero());
  for (std::size_t i = 0; i < next.size(); ++i) {
    if (!rigid_.data().canChange[i] || !next[i].closed()) continue;
    const ContactState& state = next[i];
    if (state.status == PairStatus::Stick && projection_.rubs(i))
      active[i].setIdentity();
    else
      active[i].col(0) = Eigen::Vector3d(1.0, state.friction * state.direction[1], state.friction * state.direction[2]).normalized();
  }
  PairStates other;
  if (advance(next, other)) return other;
  if (!pads_.balances(active) && fromPads(at_, 1.0, other)) {
    other = withStabilisingPairs(std::move(other));
    if (other != states_) return other;
  }
  return withStabilisingPairs(std::move(next));
}

/// Solves for states_. Without friction, motions in which no force does work are held by closing open pairs, which then carry no force.
/// Along these motions the bodies are then moved to where open pairs penetrate least.
ContactAnswer StateSearch::solveHeld() {
  const Matrix free = isFrictionless_ && rigid_.motions() > 0 ? rigid_.loose(states_) : Matrix();
  const std::vector<int> holders = free.cols() > 0 ? rigid_.holders(closedSet(states_), free) : std::vector<int>();
  PairStates held = states_;
  for (const int i : holders) held[static_cast<std::size_t>(i)] = PairStatus::Slip;
  ContactAnswer answer = solver_.solve(held, tolerance_);
  if (!answer.solved || free.cols() == 0) return answer;
  for (const int i : holders) answer.force.row(i).setZero();
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
  const Vector motion = isFrictionless_ ? solver_.motion() : Vector();
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

/// The accuracy of states is limited by the distance from the laws, and that of solves follows it. If only slip turns, a tenth of the turn
/// is sufficient.
void StateSearch::sharpen(double distance, double turns) {
  const double last = solver_.tightest(), between = std::max(last, std::sqrt(last * solver_.loosest()));
  if (violated_.empty()) {
    tolerance_ = std::max(last, std::min(tolerance_, kStateSharper * turns * tolerance_));
    return;
  }
  double size = 0.0;
  for (Eigen::Index i = 0; i < answer_.force.rows(); ++i) size += answer_.force.row(i).squaredNorm() / rigid_.data().stiffness(i);
  if (size > 0.0 && tolerance_ > between) tolerance_ = std::clamp(kStateForcing * std::sqrt(distance / size), between, tolerance_);
  if (tolerance_ <= last) tolerance_ = between;
}

/// Step from the current state towards the solution: the first halving that reduces the distance; if none does, the whole step with
/// friction, and the one that comes nearest to the laws without.
/// \param next  receives the states there. False if they are still those of the last solve.
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
  if (!lower) to = nearest, part = nearestPart;
  // With friction the distance has local minima, which full steps leave. Without friction they only lead away.
  const bool whole = part == 1.0 || (!lower && !isFrictionless_ && nearest.distance >= at_.distance);
  at_ = whole ? Balance{answer_.force, answer_.jump, projection_.distance(states_, answer_.force, answer_.jump)} : to;
  if (whole) return true;
  next = projection_.states(states_, at_.force, at_.jump);
  return differs(next);
}

/// Newton steps from states_ until the laws agree with a solution of the final accuracy.
StateSearch::End StateSearch::newton(int most, int patience) {
  const double last = solver_.tightest();
  int since = 0;
  std::vector<PairStates> tried;  // without friction, at the current accuracy: a state that recurs leads nowhere new
  isNew_ = true;
  best_.distance = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most;) {
    if (!goesOn()) return End::Exhausted;
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
      const double between = std::max(last, std::sqrt(last * solver_.loosest()));
      const bool turning =
          std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.transverseStiffness > 0.0; });
      tolerance_ = turning && tolerance_ > between ? between : last;
      ++left_, --k;
      isNew_ = true;
      best_.distance = std::numeric_limits<double>::infinity();
      since = 0;
      continue;
    }
    if (isFrictionless_ && predicts_ && solves_ <= kPredicted) next = predicted(std::move(next));
    const double own = projection_.distance(states_, answer_.force, answer_.jump), before = tolerance_;
    if (isNew_) {
      at_ = {answer_.force, answer_.jump, own};
      if (k == 1 && (patience < kStatePatience || first_.force.size() == 0)) first_ = at_;
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
    if (isFrictionless_) {
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
  const Vector motion = pads_.unbalanced();
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
  const bool drags = std::any_of(states_.begin(), states_.end(), [](const ContactState& state) { return state.couplesToNormal(); });
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
    if (rigid_.data().canChange[i]) all[i] = projection_.rubs(i) ? PairStatus::Stick : PairStatus::Slip;
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
  const Balance& from = best_.force.size() > 0 ? best_ : first_;
  if (from.force.size() == 0) return End::Stalled;
  const PadModel::Equilibrium pads = padsAt(from, 1.0);
  if (!pads.found) return End::Stalled;
  tolerance_ = solver_.tightest();
  End end = End::Stalled;
  const auto solve = [&](const ClosedSet& closed) -> const ContactAnswer* {
    if (!goesOn()) end = End::Exhausted;
    if (end == End::Exhausted) return nullptr;
    for (std::size_t i = 0; i < closed.size(); ++i)
      if (rigid_.data().canChange[i]) states_[i] = closed[i] ? PairStatus::Slip : PairStatus::Open;
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
      if (k >= 0 && !fromPads(k % 2 == 0 ? best_ : first_, own.softness, next)) break;
      states_ = withStabilisingPairs(std::move(next));
      tolerance_ = std::max(solver_.tightest(), std::sqrt(solver_.tightest() * solver_.loosest()));
      end = k < 0 ? newton(std::numeric_limits<int>::max(), kStatePatience) : newton(kShort, kShortPatience);
    }
  }
  return end;
}

StateSearch::Result StateSearch::run(PairStates start, bool isClose) {
  Result result;
  result.states = states_ = withStabilisingPairs(projection_.isFrozen() ? projection_.refrozen(std::move(start)) : std::move(start));
  if (!projection_.isFrozen()) result.slides = unbalanced(states_);
  if (result.slides.size() > 0) return result;
  tolerance_ = isClose ? solver_.tightest() : solver_.loosest();
  solveByGuess();
  End end = newton(std::numeric_limits<int>::max(), kStatePatience);
  if (end != End::Settled && isFrictionless_)
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
