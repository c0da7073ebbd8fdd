#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/ForceScale.hpp>
#include <suture/condensed/TrescaFixedPoint.hpp>
#include <suture/search/Collapse.hpp>

#include <algorithm>

namespace suture {

namespace {

constexpr double kSameForces = 1e-9;   // relative change of normal forces at which the fixed point has converged
constexpr double kSameAsSolved = 0.1;  // fraction of the solver accuracy below which no change is required
constexpr Eigen::Index kMixed = 5;     // number of previous problems mixed into the next bounds
constexpr double kTelling = 1e-4;      // relative change of bounds above which the contraction is estimated
constexpr int kRough = 20;             // maximum number of problems before states settle
constexpr int kRoughSolves = 2;        // solves of each of these: bounds of other states than those of the solution are not worth more
constexpr double kGrown = 2.0;         // growth of the change above which earlier problems are discarded

/// Appends a column; at most kMixed older ones are kept.
void remember(Matrix& all, const Vector& last) {
  const Eigen::Index kept = std::min<Eigen::Index>(all.cols(), kMixed);
  Matrix more(last.size(), kept + 1);
  more << all.rightCols(kept), last;
  all = std::move(more);
}

}  // namespace

/// Bounds of the next problem, from the normal forces that the last one found. False if they do not change.
bool TrescaFixedPoint::next(Vector& normal, const Vector& found, double same) {
  const Vector change = found - normal;
  if (changes_.cols() > 0 && change.norm() > kGrown * changes_.rightCols(1).norm()) bounds_ = changes_ = Matrix(normal.size(), 0);
  remember(bounds_, normal);
  remember(changes_, change);
  const Eigen::Index before = bounds_.cols() - 1;
  Vector step = change;
  if (before > 0) {
    const Matrix ofBounds = bounds_.rightCols(before) - bounds_.leftCols(before),
                 ofChanges = changes_.rightCols(before) - changes_.leftCols(before);
    // Small changes are dominated by mixing and round-off and are not used to estimate the contraction.
    if (const double size = ofBounds.rightCols(1).norm(); size > kTelling * normal.norm())
      contraction_ = std::max(contraction_, (ofBounds + ofChanges).rightCols(1).norm() / size);
    step -= (ofBounds + ofChanges) * leastSquares(ofChanges, change);
  }
  if (change.norm() <= same * found.norm() + rigid_.rounding().norm()) return false;
  normal = (normal + step).cwiseMax(0.0);
  return true;
}

StateSearch::Result TrescaFixedPoint::solve(const PairStates& start, const Vector& normal, int most) {
  StateSearch search(rigid_, laws_, sites_, solver_, std::min(most, left_), normal);
  StateSearch::Result result = search.run(start, bounds_.cols() > 0 ? StateSearch::Start::Solution : StateSearch::Start::Guess);
  left_ -= result.solves;
  solves_ += result.solves;
  return result;
}

StateSearch::Result TrescaFixedPoint::run(PairStates start) {
  const LawProjection laws(rigid_, laws_, sites_);
  StateSearch pads(rigid_, laws_, sites_, solver_, left_);
  StateSearch::Result result;
  Vector normal;
  if (std::none_of(start.begin(), start.end(), [](const ContactState& state) { return state.closed(); })) {
    start = pads.start();
    normal = pads.guess();
  }
  result.states = start;
  result.slides = pads.unbalanced(start);
  if (result.slides.size() > 0) return result;
  if (normal.size() == 0) {
    // Normal forces of the given states, whose bounds are those of an earlier solution.
    for (ContactState& state : start) state.friction = 0.0;
    const ContactAnswer answer = solver_.solve(start, solver_.tightest());
    --left_;
    ++solves_;
    if (answer.solved) normal = answer.force.col(0).cwiseMax(0.0);
    result.solves = solves_;
    if (!answer.solved) return result;
  }
  for (int k = 0; k < kRough && !result.converged && left_ > 0 && solver_.goesOn(); ++k) {
    result = solve(start, normal, kRoughSolves);
    if (result.normal.size() == 0) break;
    start = result.states;
    normal = result.normal;
  }
  const double same = std::max(kSameForces, kSameAsSolved * solver_.tightest());
  bool settled = false;  // the bounds of the last problem follow from its own normal forces
  while (left_ > 0 && solver_.goesOn()) {
    result = solve(start, normal, left_);
    if (result.normal.size() == 0) break;
    start = result.states;
    bool depends = false;  // the bound of some pair depends on its normal force
    for (std::size_t i = 0; i < start.size() && !depends; ++i)
      depends = rigid_.data().canChange[i] && start[i].closed() && laws.restrictsSliding(i) && laws.cone(i).friction != 0.0;
    settled = result.converged && (!depends || !next(normal, result.normal, same));
    if (settled || !result.converged) break;
  }
  result.converged = settled;
  if (!result.converged && result.normal.size() > 0) {
    const Collapse::Result found = Collapse(rigid_, laws_, sites_, solver_).find(result.states, result.normal, Collapse::kSolves);
    solves_ += found.solves;
    result.slides = found.motion;
    result.multiple = found.multiple;
    if (found.motion.size() > 0) result.alternating.clear();
  }
  result.solves = solves_;
  if (result.converged) result.contraction = contraction_;
  return result;
}

}  // namespace suture
