#include <suture/base/Errors.hpp>
#include <suture/subdomain/ConstrainedInverse.hpp>
#include <suture/subdomain/SparseMatrix.hpp>

#include <Eigen/Cholesky>
#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <cmath>

namespace suture {

namespace {

/// x <- x - 2 v v^T x on the rows of the reflection's support.
struct Reflection {
  std::vector<int> support;
  Vector v;  // of length one

  void onRows(Matrix& x) const {
    Eigen::RowVectorXd product = Eigen::RowVectorXd::Zero(x.cols());
    for (std::size_t k = 0; k < support.size(); ++k) product += v(static_cast<int>(k)) * x.row(support[k]);
    for (std::size_t k = 0; k < support.size(); ++k) x.row(support[k]) -= 2.0 * v(static_cast<int>(k)) * product;
  }
  void onColumns(Matrix& x) const {
    Vector product = Vector::Zero(x.rows());
    for (std::size_t k = 0; k < support.size(); ++k) product += v(static_cast<int>(k)) * x.col(support[k]);
    for (std::size_t k = 0; k < support.size(); ++k) x.col(support[k]) -= 2.0 * v(static_cast<int>(k)) * product;
  }
};

constexpr double kZero = 1e-14;

}  // namespace

ConstrainedInverse::ConstrainedInverse(Matrix schur, const Matrix& constraints, const std::string& what) {
  const int n = static_cast<int>(schur.rows()), m = static_cast<int>(constraints.rows());
  Matrix rows = constraints;
  std::vector<int> primal;
  std::vector<char> taken(n, 0);
  std::vector<Reflection> reflections;
  // Rows with a single entry first: they take their unknown, whatever the others do.
  std::vector<int> order;
  const auto entries = [&](int row) { return (rows.row(row).array().abs() > kZero).count(); };
  for (const bool single : {true, false})
    for (int row = 0; row < m; ++row)
      if ((entries(row) == 1) == single) order.push_back(row);
  for (const int row : order) {
    std::vector<int> support;
    double square = 0.0;
    for (int j = 0; j < n; ++j)
      if (!taken[j] && std::abs(rows(row, j)) > kZero) {
        support.push_back(j);
        square += rows(row, j) * rows(row, j);
      }
    if (support.empty() || std::sqrt(square) < 1e-10 * constraints.row(row).norm())
      throw NumericalError(what + ": a primal constraint follows from the others");
    const int pivot =
        *std::max_element(support.begin(), support.end(), [&](int a, int b) { return std::abs(rows(row, a)) < std::abs(rows(row, b)); });
    primal.push_back(pivot);
    if (support.size() > 1) {
      Reflection reflection{support, Vector(static_cast<int>(support.size()))};
      const double length = rows(row, pivot) > 0.0 ? -std::sqrt(square) : std::sqrt(square);
      for (std::size_t k = 0; k < support.size(); ++k)
        reflection.v(static_cast<int>(k)) = rows(row, support[k]) - (support[k] == pivot ? length : 0.0);
      reflection.v.normalize();
      reflection.onColumns(rows);
      reflection.onColumns(schur);
      reflection.onRows(schur);
      reflections.push_back(std::move(reflection));
    }
    taken[pivot] = 1;
  }

  // In the new coordinates: the constraints fix the primal ones, lower triangular in the order they were taken.
  Matrix triangle(m, m);
  for (int a = 0; a < m; ++a)
    for (int b = 0; b < m; ++b) triangle(a, b) = b <= a ? rows(order[a], primal[b]) : 0.0;
  const std::vector<int> dual = complement(n, [&] {
    std::vector<int> sorted = primal;
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }());
  const int d = static_cast<int>(dual.size());
  Matrix dd(d, d), dp(d, m), pp(m, m);
  for (int j = 0; j < d; ++j)
    for (int i = 0; i < d; ++i) dd(i, j) = schur(dual[i], dual[j]);
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < d; ++i) dp(i, j) = schur(dual[i], primal[j]);
    for (int i = 0; i < m; ++i) pp(i, j) = schur(primal[i], primal[j]);
  }
  double smallest = 1.0;
  const Vector diagonal = dd.diagonal();
  Teuchos::LAPACK<int, double> lapack;
  int info = 0;
  if (d > 0) {
    lapack.POTRF('L', d, dd.data(), d, &info);
    for (int i = 0; info == 0 && i < d; ++i) smallest = std::min(smallest, dd(i, i) * dd(i, i) / diagonal(i));
    // A mechanism leaves rounding instead of a zero; legitimate pivots are small where stiffness jumps within the subdomain.
    if (info != 0 || !(smallest > 1e-14))
      throw NumericalError(what + ": its corners and edge constraints leave a mechanism (is it attached at single points only?)");
    Matrix response = dp;
    dd.triangularView<Eigen::Lower>().solveInPlace(response);
    pp -= response.transpose() * response;
    dd.triangularView<Eigen::Lower>().transpose().solveInPlace(response);
    dp = response;
    lapack.POTRI('L', d, dd.data(), d, &info);
  }

  basis_ = Matrix::Zero(n, m);
  Matrix toPrimal = Matrix::Identity(m, m);  // of the order taken, from that of the rows given
  triangle.triangularView<Eigen::Lower>().solveInPlace(toPrimal);
  Matrix inOrder(m, m);
  for (int a = 0; a < m; ++a) inOrder.col(order[a]) = toPrimal.col(a);
  const Matrix below = dp * inOrder;
  for (int a = 0; a < m; ++a) basis_.row(primal[a]) = inOrder.row(a);
  for (int i = 0; i < d; ++i) basis_.row(dual[i]) = -below.row(i);
  const Matrix energy = inOrder.transpose() * (0.5 * (pp + pp.transpose())) * inOrder;
  energy_ = 0.5 * (energy + energy.transpose());

  Matrix inverse = Matrix::Zero(n, n);
  for (int j = 0; j < d; ++j)
    for (int i = j; i < d; ++i) inverse(dual[i], dual[j]) = inverse(dual[j], dual[i]) = dd(i, j);
  for (auto reflection = reflections.rbegin(); reflection != reflections.rend(); ++reflection) {
    reflection->onRows(basis_);
    reflection->onRows(inverse);
    reflection->onColumns(inverse);
  }
  inverse_ = PackedSymmetric(inverse);
}

}  // namespace suture
