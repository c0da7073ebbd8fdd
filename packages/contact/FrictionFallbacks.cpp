// FrictionSearch: ways to states where Newton's method by the laws does not end, or has no linear problems to ask for.
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/ForceScale.hpp>
#include <suture/contact/FrictionSearch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace suture {

namespace {

constexpr double kSameForces = 1e-9;     // relative change of normal forces at which a fixed point has been reached
constexpr Eigen::Index kMixed = 5;       // problems before the last one that the next bounds are mixed with
constexpr double kTelling = 1e-4;        // relative change of bounds from which on they tell the contraction
constexpr double kGrown = 2.0;           // growth of the change from which on those before tell nothing
constexpr double kSameAsSolved = 0.1;    // part of the accuracy of solves that no change need fall below
constexpr double kOtherConstant = 0.05;  // constant along normals of the second try: other combinations are nearest
constexpr int kSecondTry = 30;           // solves from pairs that all stick
constexpr int kMoreBlockSteps = 10;      // steps of the second try that change all violated pairs without lowering their number
constexpr int kFewBlockSteps = 3;        // the same along the path of falling friction
constexpr int kPathSolves = 12;          // solves of a step along the path of falling friction
constexpr int kLastSolves = 30;          // solves of the last step along that path, to the final accuracy
constexpr double kRough = 1e6;           // multiple of friction with which all closed pairs stick
/// First multiples along that path, until one settles: where a body hangs on friction alone, it needs little of it.
constexpr std::array<double, 5> kMultiples{kRough, 4.0, 2.0, 1.4, 1.2};
constexpr double kUnloading = 0.1;   // part of the path's largest force, of which normal forces are less where bodies are unloaded
constexpr double kShortStep = 1e-3;  // relative change of friction of the shortest step along that path

}  // namespace

/// Closes all pairs, and lets those stick whose laws restrict sliding.
void FrictionSearch::stick() {
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (rigid_.data().able[i]) states_[i] = laws_.of(rigid_.data().line[i]).rows(2) > 1 ? PairStatus::Stick : PairStatus::Slip;
  holders_.assign(states_.size(), 0);
  spent_ = holders_;
  met_.clear();
}

/// Tries from the other side, from pairs that all stick; by pivots, where pairs are few; and along the path of falling friction. \param
/// first  how the first try ended
FrictionSearch::End FrictionSearch::tryAgain(End first) {
  stick();
  normalConstant_ = kOtherConstant;
  tolerance_ = oracle_.loosest();
  patience_ = kMoreBlockSteps;
  End end = limited(kSecondTry, oracle_.tightest());
  if (end != End::Settled && goesOn() && oracle_.drags()) end = solveByPivots();
  if (end != End::Settled && goesOn()) end = lowerFriction();
  if (end == End::Failed) end = End::Exhausted;  // the fixed point may have other linear problems
  return end != End::Settled && first == End::Slides ? first : end;
}

/// Largest tangential force of a closed pair, in parts of what its law allows.
double FrictionSearch::mobilisation() {
  const PairStates own = projected(states_, answer_);
  double most = 0.0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (!rigid_.data().able[i] || !states_[i].closed() || laws_.of(rigid_.data().line[i]).rows(2) < 2) continue;
    const auto at = static_cast<Eigen::Index>(i);
    const double allowed = own[i].largest(answer_.force(at, 0));
    most = std::max(most, allowed > 0.0 ? std::hypot(answer_.force(at, 1), answer_.force(at, 2)) / allowed : 0.0);
  }
  return most;
}

/// Follows a path of falling friction: begins with a multiple of it, the first of some that settles, and lowers that to one. Few pairs
/// change in each step; one that does not end is halved.
FrictionSearch::End FrictionSearch::lowerFriction() {
  End end = End::Exhausted;
  double from = kRough;
  for (const double multiple : kMultiples) {
    stick();
    from = scale_ = multiple;
    tolerance_ = oracle_.loosest();
    patience_ = kFewBlockSteps;
    end = limited(kPathSolves, oracle_.loosest());
    if (end == End::Settled || end == End::Failed || !goesOn()) break;
  }
  scale_ = 1.0;
  if (end != End::Settled) return end;
  double reached = std::log(std::clamp(mobilisation(), 1.0, from)), step = reached;
  PairStates kept = states_;
  while (true) {
    const double next = std::max(0.0, reached - step);
    scale_ = std::exp(next);
    tolerance_ = oracle_.loosest();
    patience_ = kFewBlockSteps;
    end = limited(next > 0.0 ? kPathSolves : kLastSolves, next > 0.0 ? oracle_.loosest() : oracle_.tightest());
    const bool isLast = next == 0.0;
    if (end == End::Settled && isLast) break;
    if (end == End::Settled) {
      reached = next;
      kept = states_;
      step *= 2.0;
      continue;
    }
    step *= 0.5;
    if (end == End::Failed || !goesOn() || step < kShortStep) break;
    states_ = kept;
    holders_.assign(states_.size(), 0);
    spent_ = holders_;
    met_.clear();
  }
  scale_ = 1.0;
  return end;
}

/// Solves Tresca problems, each with the bounds that the one before gives, mixed with those of others before so that their changes cancel
/// as far as they can (Anderson; Walker and Ni 2011): with states that stay the changes are linear in the bounds.
FrictionSearch::End FrictionSearch::fixedPoint(const Vector& start) {
  const double same = std::max(kSameForces, kSameAsSolved * oracle_.tightest());
  normal_ = start;
  Matrix bounds(start.size(), 0), changes = bounds;  // one column for each of the last problems
  const auto remember = [](Matrix& all, const Vector& last) {
    const Eigen::Index kept = std::min<Eigen::Index>(all.cols(), kMixed);
    Matrix next(last.size(), kept + 1);
    next << all.rightCols(kept), last;
    all = std::move(next);
  };
  while (true) {
    tolerance_ = oracle_.tightest();
    End end = settle(oracle_.tightest());
    if (end != End::Settled && !oracle_.drags() && goesOn()) end = tryAgain(end);
    if (end != End::Settled) return end;
    if (!dependOnNormals()) return End::Settled;  // the bounds are those of the laws
    const Vector change = normalForces() - normal_;
    if (changes.cols() > 0 && change.norm() > kGrown * changes.rightCols(1).norm()) bounds = changes = Matrix(start.size(), 0);
    remember(bounds, normal_);
    remember(changes, change);
    const Eigen::Index before = bounds.cols() - 1;
    Vector step = change;
    if (before > 0) {
      const Matrix ofBounds = bounds.rightCols(before) - bounds.leftCols(before),
                   ofChanges = changes.rightCols(before) - changes.leftCols(before);
      // Small changes are those of mixed bounds and of rounding: they tell nothing of the map.
      if (const double size = ofBounds.rightCols(1).norm(); size > kTelling * normal_.norm())
        contraction_ = std::max(contraction_, (ofBounds + ofChanges).rightCols(1).norm() / size);
      step -= (ofBounds + ofChanges) * leastSquares(ofChanges, change);
    }
    if (change.norm() <= same * (normal_ + change).norm() + rigid_.rounding().norm()) return End::Settled;
    normal_ = (normal_ + step).cwiseMax(0.0);
  }
}

/// True if a bound by the law of some pair depends on its normal force.
bool FrictionSearch::dependOnNormals() {
  Vector none;
  normal_.swap(none);
  const PairStates own = projected(states_, answer_);
  normal_.swap(none);
  return std::any_of(own.begin(), own.end(), [](const ContactState& state) { return state.closed() && state.friction != 0.0; });
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

/// Solves by the fixed point alone, from given normal forces; where none are given, from those of the start's states.
FrictionSearch::End FrictionSearch::solveAsTresca(const Vector& normal) {
  for (ContactState& state : states_) state.friction = 0.0;
  Vector bounds = normal;
  if (bounds.size() == 0) {
    ++solves_, --left_;
    answer_ = oracle_.solve(states_, tolerance_);
    if (!answer_.solved) return End::Failed;
    bounds = normalForces();
  }
  // Bounds that fall to nothing with the loads do so by a part in each problem; without friction it is seen at once.
  if (bounds.sum() * kRoundedForce <= kUnloading * rigid_.rounding().maxCoeff()) {
    normal_ = Vector::Zero(bounds.size());
    tolerance_ = oracle_.tightest();
    if (settle(oracle_.tightest()) == End::Settled) {
      bounds = normalForces();
      if ((bounds - answer_.forceTolerance).maxCoeff() <= 0.0) return End::Settled;
    }
  }
  const End end = fixedPoint(bounds);
  if (end != End::Settled && outdone_.size() == 0) outdone_ = outdone();
  if (end != End::Settled && outdone_.size() == 0 && collapses()) return End::Slides;
  return end;
}

}  // namespace suture
