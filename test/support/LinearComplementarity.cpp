#include <support/LinearComplementarity.hpp>
#include <suture/algebra/dense/Decompositions.hpp>

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

namespace suture {

namespace {

constexpr double kPivot = 1e-10;      // smallest pivot, relative to the largest entry of its column
constexpr double kTie = 1e-11;        // difference of two ratios, relative to the largest value, up to which the larger pivot is taken
constexpr double kHolds = 1e-9;       // violation of a condition treated as round-off, relative to the largest value
constexpr Eigen::Index kPivots = 30;  // maximum number of pivots per unknown

}  // namespace

std::optional<Vector> linearComplementarity(const Matrix& m, const Vector& q) {
  const Eigen::Index n = q.size(), artificial = 2 * n, right = artificial + 1;
  if (n == 0 || q.minCoeff() >= 0.0) return Vector::Zero(n);
  // A generic covering vector: along its path no two values reach zero together, except by round-off.
  std::mt19937 engine(1);
  Matrix tableau(n, right + 1);  // columns of w, z, the artificial unknown, the right-hand side
  tableau.leftCols(n).setIdentity();
  tableau.middleCols(n, n) = -m;
  for (Eigen::Index i = 0; i < n; ++i)
    tableau(i, artificial) = -1.0 - static_cast<double>(engine()) / static_cast<double>(std::mt19937::max());
  tableau.col(right) = q;
  std::vector<Eigen::Index> basic(static_cast<std::size_t>(n));
  std::iota(basic.begin(), basic.end(), Eigen::Index{0});
  Eigen::Index row = 0, entering = artificial;
  q.cwiseQuotient(tableau.col(artificial)).maxCoeff(&row);
  for (Eigen::Index step = 0; step < kPivots * n; ++step) {
    const Eigen::Index leaving = basic[static_cast<std::size_t>(row)];
    tableau.row(row) /= tableau(row, entering);
    Vector factors = tableau.col(entering);
    factors(row) = 0.0;
    const Eigen::RowVectorXd pivot = tableau.row(row);
    tableau.noalias() -= factors * pivot;
    basic[static_cast<std::size_t>(row)] = entering;
    if (leaving == artificial) {
      std::vector<Eigen::Index> in;
      for (const Eigen::Index column : basic)
        if (column >= n) in.push_back(column - n);
      // Recomputed from the data, because pivots accumulate round-off.
      Vector z = Vector::Zero(n);
      if (!in.empty()) z(in) = leastSquares(m(in, in), -q(in));
      const Vector w = m * z + q;
      const double size = std::max({z.cwiseAbs().maxCoeff(), w.cwiseAbs().maxCoeff(), q.cwiseAbs().maxCoeff()});
      if (z.minCoeff() < -kHolds * size || w.minCoeff() < -kHolds * size) return {};
      return z.cwiseMax(0.0);
    }
    entering = leaving < n ? leaving + n : leaving - n;
    const auto column = tableau.col(entering);
    const auto values = tableau.col(right);
    const double least = kPivot * column.cwiseAbs().maxCoeff(), size = kTie * values.cwiseAbs().maxCoeff();
    double ratio = 0.0;
    row = -1;
    for (Eigen::Index i = 0; i < n; ++i) {
      if (!(column(i) > least)) continue;
      const double own = std::max(values(i), 0.0) / column(i);
      const bool tied = row >= 0 && std::abs(own - ratio) * std::max(column(i), column(row)) <= size;
      const bool ends = basic[static_cast<std::size_t>(i)] == artificial;
      if (row < 0 || (tied ? ends || (basic[static_cast<std::size_t>(row)] != artificial && column(i) > column(row)) : own < ratio)) {
        ratio = own;
        row = i;
      }
    }
    if (row < 0) return {};
  }
  return {};
}

}  // namespace suture
