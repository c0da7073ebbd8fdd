#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <suture/answer/bound/NonnegativeFit.hpp>

namespace suture {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

constexpr double kConverged = 1e-13;  // largest misfit relative to the largest target
constexpr double kRoundOff = 1e-15;   // no further step below it
constexpr int kMostSteps = 150;       // most feasible problems need less than 40
constexpr double kLeastShift =
    1e-14;                       // relative to the diagonal of H, whose rows are scaled: keeps rows without a positive unknown regular
constexpr double kShift = 1e-3;  // part of the diagonal per relative misfit: shorter steps far from the solution
constexpr int kMostTrials = 40;
constexpr double kFlatSlope = 0.3;  // a step is accepted if the slope of the dual function fell to this part of its start

/// H = C S C^T + shift on a sparsity pattern that does not change, and its factorisation. S selects columns.
class SelectedNormal {
 public:
  explicit SelectedNormal(const Sparse& columns) : columns_(columns) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < columns.outerSize(); ++j)
      for (Sparse::InnerIterator a(columns, j); a; ++a)
        for (Sparse::InnerIterator b(columns, j); b; ++b)
          if (a.row() >= b.row()) entries.emplace_back(a.row(), b.row(), 0.0);
    for (int i = 0; i < columns.rows(); ++i) entries.emplace_back(i, i, 0.0);
    matrix_.resize(columns.rows(), columns.rows());
    matrix_.setFromTriplets(entries.begin(), entries.end());
    matrix_.makeCompressed();
    for (int j = 0; j < columns.outerSize(); ++j)
      for (Sparse::InnerIterator a(columns, j); a; ++a)
        for (Sparse::InnerIterator b(columns, j); b; ++b)
          if (a.row() >= b.row()) places_.push_back(static_cast<int>(&matrix_.coeffRef(a.row(), b.row()) - matrix_.valuePtr()));
    factor_.analyzePattern(matrix_);
  }

  /// (C S C^T + shift)^-1 rhs, S = diag(scale).
  Vector solve(const Vector& scale, double shift, const Vector& rhs) {
    std::fill_n(matrix_.valuePtr(), matrix_.nonZeros(), 0.0);
    std::size_t at = 0;
    for (int j = 0; j < columns_.outerSize(); ++j)
      for (Sparse::InnerIterator a(columns_, j); a; ++a)
        for (Sparse::InnerIterator b(columns_, j); b; ++b)
          if (a.row() >= b.row()) matrix_.valuePtr()[places_[at++]] += scale(j) * a.value() * b.value();
    matrix_.diagonal().array() += shift;
    factor_.factorize(matrix_);
    return factor_.solve(rhs);
  }

 private:
  const Sparse& columns_;
  Sparse matrix_;            // lower triangle
  std::vector<int> places_;  // products of the entries of each column: their places in the values of matrix_
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>> factor_;
};

/// True if y proves that C x = b has no solution x >= 0, and none within other limits above zero. Each solution has  m.x = sum of b,  m the
/// sums of the columns. If all of them are positive,  b.y = x.C^T y <= (sum of b) max_i (C^T y)_i / m_i.
bool provesInfeasible(const Vector& work, const Vector& sums, const Vector& products, const Vector& targets) {
  if (sums.minCoeff() <= 0) return false;
  return targets.dot(work) > targets.sum() * (products.array() / sums.array()).maxCoeff() + 1e-9 * targets.cwiseAbs().dot(work.cwiseAbs());
}

/// Limits of the unknowns.
struct Limits {
  Vector low, high;

  explicit Limits(const NonnegativeProblem& problem)
      : low(problem.lowest.size() > 0 ? problem.lowest : Vector(Vector::Zero(problem.start.size()))),
        high(problem.highest.size() > 0 ? problem.highest
                                        : Vector(Vector::Constant(problem.start.size(), std::numeric_limits<double>::infinity()))) {}
  Vector cut(const Vector& z) const { return z.cwiseMax(low).cwiseMin(high); }
  bool isInside(const Vector& z, Eigen::Index i) const { return z[i] > low[i] && z[i] < high[i]; }
  /// Change of a cut value as its argument grows from z to z + d: not a difference of large numbers.
  double change(double z, double d, Eigen::Index i) const {
    if (z <= low[i]) return std::min(std::max(z - low[i] + d, 0.0), high[i] - low[i]);
    if (z >= high[i]) return std::max(std::min(z - high[i] + d, 0.0), low[i] - high[i]);
    return std::min(std::max(d, low[i] - z), high[i] - z);
  }
};

/// Step length t along which the slope of the dual function becomes small. It grows with t:
///   sum_i w_i (x_i(z_i + t d_i) - x_i(z_i)) d_i - work,  `work` = (b - C x).step;  differences, because x is much larger than steps.
double stepLength(const Vector& weights, const Limits& limits, const Vector& z, const Vector& d, double work) {
  const auto slope = [&](double t) {
    double sum = -work;
    for (Eigen::Index i = 0; i < z.size(); ++i) sum += limits.change(z[i], t * d[i], i) * d[i] * weights[i];
    return sum;
  };
  double low = 0, high = 0, t = 1;
  for (int trial = 0; trial < kMostTrials; ++trial) {
    const double now = slope(t);
    if (std::abs(now) <= kFlatSlope * work) return t;
    (now < 0 ? low : high) = t;
    t = high > 0 ? 0.5 * (low + high) : 4 * t;
  }
  return low > 0 ? low : t;
}

}  // namespace

NonnegativeSolution nonnegativeFit(const NonnegativeProblem& problem) {
  const Vector &weights = problem.weights, &start = problem.start;
  const Limits limits(problem);
  const bool isNonnegative = problem.lowest.size() == 0;
  NonnegativeSolution best;
  best.values = limits.cut(start);
  best.misfit = problem.targets - problem.columns * best.values;
  if (problem.targets.size() == 0) return best.converged = true, best;
  const double largest = problem.targets.cwiseAbs().maxCoeff();
  // Rows are scaled so that C W^-1 C^T has the diagonal 1.
  const Sparse squares = problem.columns.cwiseAbs2();
  const Vector diagonal = squares * weights.cwiseInverse();
  const Vector scale = (diagonal.array() > 0).select(diagonal.array().sqrt().inverse(), 1.0);
  const Sparse columns = scale.asDiagonal() * problem.columns;
  const Vector targets = scale.cwiseProduct(problem.targets), sums = problem.columns.transpose() * Vector::Ones(targets.size());
  SelectedNormal normal(columns);
  Vector y = Vector::Zero(targets.size());
  double before = std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector products = columns.transpose() * y, z = start + products.cwiseQuotient(weights), x = limits.cut(z);
    const Vector misfit = targets - columns * x;
    const double now = misfit.cwiseQuotient(scale).cwiseAbs().maxCoeff();
    if (step == 0 || now < best.misfit.cwiseAbs().maxCoeff()) best.values = x, best.misfit = misfit.cwiseQuotient(scale), best.steps = step;
    if (now <= kRoundOff * largest || (now <= kConverged * largest && now > 0.5 * before)) break;
    if (isNonnegative && provesInfeasible(scale.cwiseProduct(y), sums, products, problem.targets)) break;
    const double shift = std::max(kLeastShift, kShift * std::min(1.0, misfit.norm() / targets.norm()));
    Vector active = Vector::Zero(z.size());
    for (Eigen::Index i = 0; i < z.size(); ++i)
      if (limits.isInside(z, i)) active[i] = 1 / weights[i];
    const Vector change = normal.solve(active, shift, misfit);
    if (!change.allFinite()) break;
    const Vector moved = (columns.transpose() * change).cwiseQuotient(weights);
    y += stepLength(weights, limits, z, moved, misfit.dot(change)) * change;
    before = now;
  }
  best.converged = best.misfit.cwiseAbs().maxCoeff() <= kConverged * largest;
  return best;
}

}  // namespace suture
