// FrictionSearch: fallbacks for states where Newton's method does not converge or does not apply.
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/ForceScale.hpp>
#include <suture/contact/FrictionSearch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace suture {

namespace {

constexpr double kSameForces = 1e-9;     // relative change of normal forces at which the fixed point has converged
constexpr Eigen::Index kMixed = 5;       // number of previous problems mixed into the next bounds
constexpr double kTelling = 1e-4;        // relative change of bounds above which the contraction is estimated
constexpr double kGrown = 2.0;           // growth of the change above which earlier problems are discarded
constexpr double kSameAsSolved = 0.1;    // fraction of the solver accuracy below which no change is required
constexpr double kOtherConstant = 0.05;  // constant along normals in the second try, with which other combinations are closest
constexpr int kSecondTry = 30;           // solves in the second try, which starts with all pairs sticking
constexpr int kMoreBlockSteps = 10;      // steps of the second try that change all violated pairs without reducing their number
constexpr int kFewBlockSteps = 3;        // the same along the path of decreasing friction
constexpr int kPathSolves = 12;          // solves of a step along that path
constexpr int kLastSolves = 30;          // solves of the last step along that path, to the final accuracy
constexpr double kRough = 1e6;           // friction multiple with which all closed pairs stick
/// First multiples along that path, tried until one settles. A body held by friction alone needs a small one.
constexpr std::array<double, 5> kMultiples{kRough, 4.0, 2.0, 1.4, 1.2};
constexpr double kUnloading = 0.1;   // fraction of the path's largest force; bodies with smaller normal forces count as unloaded
constexpr double kShortStep = 1e-3;  // relative change of friction in the shortest step along that path

}  // namespace

/// Closes all pairs; those whose laws restrict sliding stick.
void FrictionSearch::stick() {
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (rigid_.data().able[i]) states_[i] = laws_.of(rigid_.data().line[i]).rows(2) > 1 ? PairStatus::Stick : PairStatus::Slip;
  holders_.assign(states_.size(), 0);
  spent_ = holders_;
  met_.clear();
}

/// Tries again from the other side, with all pairs sticking; then by pivots if pairs are few; then along the path of decreasing friction.
/// \param first  result of the first try
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

/// Largest ratio of a closed pair's tangential force to its bound.
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

/// Follows a path of decreasing friction: starts with the first multiple of friction that settles and reduces it to one. Few pairs change
/// in each step; a step that fails is halved.
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

/// Solves a sequence of Tresca problems with bounds from the previous solutions, accelerated by Anderson mixing (Walker and Ni 2011): as
/// long as states do not change, the changes are linear in the bounds.
FrictionSearch::End FrictionSearch::fixedPoint(const Vector& start) {
  const double same = std::max(kSameForces, kSameAsSolved * oracle_.tightest());
  normal_ = start;
  Matrix bounds(start.size(), 0), changes = bounds;  // one column per previous problem
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
      // Small changes are dominated by mixing and round-off and are not used to estimate the contraction.
      if (const double size = ofBounds.rightCols(1).norm(); size > kTelling * normal_.norm())
        contraction_ = std::max(contraction_, (ofBounds + ofChanges).rightCols(1).norm() / size);
      step -= (ofBounds + ofChanges) * leastSquares(ofChanges, change);
    }
    if (change.norm() <= same * (normal_ + change).norm() + rigid_.rounding().norm()) return End::Settled;
    normal_ = (normal_ + step).cwiseMax(0.0);
  }
}

/// True if the bound of some pair depends on its normal force.
bool FrictionSearch::dependOnNormals() {
  Vector none;
  normal_.swap(none);
  const PairStates own = projected(states_, answer_);
  normal_.swap(none);
  return std::any_of(own.begin(), own.end(), [](const ContactState& state) { return state.closed() && state.friction != 0.0; });
}

/// Replaces the bounds of a Tresca problem by those of the laws.
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

/// Solves by the fixed point alone, from given normal forces or, without these, from those of the initial states.
FrictionSearch::End FrictionSearch::solveAsTresca(const Vector& normal) {
  for (ContactState& state : states_) state.friction = 0.0;
  Vector bounds = normal;
  if (bounds.size() == 0) {
    ++solves_, --left_;
    answer_ = oracle_.solve(states_, tolerance_);
    if (!answer_.solved) return End::Failed;
    bounds = normalForces();
  }
  // Bounds that vanish with the loads decrease by a factor per problem; a frictionless solve finds this at once.
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
