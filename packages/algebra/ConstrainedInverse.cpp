#include <cblas.h>
#include <suture/algebra/Blas.hpp>
#include <suture/algebra/ConstrainedInverse.hpp>
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/algebra/elimination/PartialCholesky.hpp>
#include <suture/base/Errors.hpp>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace suture {

namespace {

/// H = I - 2 v v^T, v zero off the support.
struct Reflection {
  std::vector<int> support;
  Vector v;  // unit vector

  /// x <- x H
  void onColumns(Matrix& x) const {
    Vector product = Vector::Zero(x.rows());
    for (std::size_t k = 0; k < support.size(); ++k) product += v(static_cast<int>(k)) * x.col(support[k]);
    for (std::size_t k = 0; k < support.size(); ++k) x.col(support[k]) -= 2.0 * v(static_cast<int>(k)) * product;
  }
};

/// Q = H_1 ... H_m = I - V T V^T, T upper triangular (Schreiber and Van Loan 1989): matrix products instead of vector operations.
class Rotation {
 public:
  Rotation(int size, const std::vector<Reflection>& reflections)
      : v_(Matrix::Zero(size, reflections.size())), t_(Matrix::Zero(v_.cols(), v_.cols())) {
    for (int k = 0; k < v_.cols(); ++k) {
      for (std::size_t i = 0; i < reflections[k].support.size(); ++i)
        v_(reflections[k].support[i], k) = reflections[k].v(static_cast<int>(i));
      t_(k, k) = 2.0;
      t_.col(k).head(k) = -2.0 * (t_.topLeftCorner(k, k) * (v_.leftCols(k).transpose() * v_.col(k)));
    }
  }

  /// a <- Q^T a Q, lower triangle.
  void to(Matrix& a) const { twoSided<double>(a, v_, t_); }
  /// a <- Q a Q^T, lower triangle.
  template <typename Real>
  void from(Dense<Real>& a) const {
    twoSided<Real>(a, v_.template cast<Real>(), t_.transpose().template cast<Real>());
  }
  /// x <- Q x
  void fromColumns(Matrix& x) const { addProductTo(-1.0, CblasNoTrans, v_, product(CblasNoTrans, t_, product(CblasTrans, v_, x)), 1.0, x); }

 private:
  /// a <- (I - V U^T) a (I - U V^T) = a - V W^T - W V^T with U = V T, X = a U, W = X - V (U^T X) / 2.
  template <typename Real>
  static void twoSided(Dense<Real>& a, const Dense<Real>& v, const Dense<Real>& t) {
    const int n = static_cast<int>(v.rows()), m = static_cast<int>(v.cols());
    if (m == 0) return;
    const Dense<Real> u = product(CblasNoTrans, v, t);
    Dense<Real> w(n, m);
    symm(n, m, a.data(), u.data(), w.data());
    addProductTo(Real(-0.5), CblasNoTrans, v, product(CblasTrans, u, w), Real(1), w);
    syr2k(n, m, Real(-1), v.data(), w.data(), a.data());
  }

  Matrix v_, t_;
};

// a <- its inverse, lower triangle, in place. By recursive halving, so that nearly all work is matrix products: OpenBLAS' dtrtri works
// column by column and takes three times as long as the preceding factorisation (n = 350).
template <typename Real>
void invertLower(Real* a, int n, int stride) {
  constexpr int small = 24;
  if (n <= small) {
    for (int j = 0; j < n; ++j) {
      Real* column = a + static_cast<std::ptrdiff_t>(j) * stride;
      column[j] = 1 / column[j];
      for (int i = j + 1; i < n; ++i) {
        Real sum = 0;
        for (int k = j; k < i; ++k) sum += a[i + static_cast<std::ptrdiff_t>(k) * stride] * column[k];
        column[i] = -sum / a[i + static_cast<std::ptrdiff_t>(i) * stride];
      }
    }
    return;
  }
  const int half = n / 2, rest = n - half;
  Real *below = a + half, *last = a + half + static_cast<std::ptrdiff_t>(half) * stride;
  invertLower(a, half, stride);
  invertLower(last, rest, stride);
  trmm(CblasRight, rest, half, Real(-1), a, below, stride);
  trmm(CblasLeft, rest, half, Real(1), last, below, stride);
}

// Entries in single precision have errors of 6e-8 of the matrix, so the relative error of its smallest eigenvalues is the condition number
// times that: below a thousandth up to this condition, which conjugate gradients do not notice. The factor that is inverted may be in
// single precision, too: its condition number is the square root.
constexpr double kConditionForSingle = 1e4;
constexpr int kLeastForSingle = 192;  // single precision saves memory, which is small for smaller matrices
constexpr double kZero = 1e-14;

/// The inverse of L L^T, placed in the rows and columns `dual` of a matrix of size n that is zero elsewhere, transformed back: its lower
/// triangle.
/// \param largest  on return: its largest diagonal entry before the transformation
template <typename Real>
Dense<Real> inverseOf(Dense<Real> factor, const std::vector<int>& dual, int n, const Rotation& rotation, double& largest) {
  const int d = static_cast<int>(dual.size());
  if (d > 0) {
    invertLower(factor.data(), d, d);
    lauum(d, factor.data());
  }
  largest = d > 0 ? static_cast<double>(factor.diagonal().maxCoeff()) : 0.0;
  Dense<Real> inverse = Dense<Real>::Zero(n, n);
  for (int j = 0; j < d; ++j)
    for (int i = j; i < d; ++i) inverse(dual[i], dual[j]) = factor(i, j);
  rotation.from(inverse);
  return inverse;
}

}  // namespace

ConstrainedInverse::ConstrainedInverse(Matrix schur, const Matrix& constraints, const std::string& what) {
  const int n = static_cast<int>(schur.rows()), m = static_cast<int>(constraints.rows());
  Matrix rows = constraints;
  std::vector<int> primal;
  std::vector<char> taken(n, 0);
  std::vector<Reflection> reflections;
  // Rows with a single entry first: each takes its unknown, independently of the other rows.
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
      throw NumericalError(what + ": a primal constraint depends linearly on the others");
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
      reflections.push_back(std::move(reflection));
    }
    taken[pivot] = 1;
  }

  const Rotation rotation(n, reflections);
  rotation.to(schur);

  // In the new coordinates the constraints fix the primal ones; lower triangular in the order of processing.
  Matrix triangle(m, m);
  for (int a = 0; a < m; ++a)
    for (int b = 0; b < m; ++b) triangle(a, b) = b <= a ? rows(order[a], primal[b]) : 0.0;
  const std::vector<int> dual = complement(n, [&] {
    std::vector<int> sorted = primal;
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  }());
  const int d = static_cast<int>(dual.size());
  // Block of the free coordinates, and below it that of the fixed ones: one elimination.
  Matrix trapezoid(d + m, d), pp(m, m), dp(d, m);
  for (int j = 0; j < d; ++j) {
    for (int i = j; i < d; ++i) trapezoid(i, j) = schur(dual[i], dual[j]);  // `dual` ascends: the lower triangle
    for (int i = 0; i < m; ++i) trapezoid(d + i, j) = schur(std::max(dual[j], primal[i]), std::min(dual[j], primal[i]));
  }
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < m; ++i) pp(i, j) = schur(std::max(primal[i], primal[j]), std::min(primal[i], primal[j]));
  double smallest = 1.0;
  const Vector diagonal = trapezoid.diagonal();
  if (d > 0) {
    const int failed = partialCholesky(d, d + m, trapezoid.data(), d + m);
    for (int i = 0; failed == 0 && i < d; ++i) smallest = std::min(smallest, trapezoid(i, i) * trapezoid(i, i) / diagonal(i));
    // A mechanism gives round-off instead of a zero; legitimate pivots are small if stiffness jumps within the subdomain.
    if (failed != 0 || !(smallest > 1e-14))
      throw NumericalError(what + ": its corners and edge constraints leave a mechanism (is it attached at single points only?)");
    if (m > 0) {
      symmetricRankUpdate(m, d, trapezoid.data() + d, d + m, 1.0, pp.data(), m);
      dp = trapezoid.bottomRows(m).transpose();
      cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, d, m, 1.0, trapezoid.data(), d + m, dp.data(), d);
    }
  }

  Matrix basis = Matrix::Zero(n, m);
  Matrix toPrimal = Matrix::Identity(m, m);  // to the order of processing, from that of the given rows
  triangle.triangularView<Eigen::Lower>().solveInPlace(toPrimal);
  Matrix inOrder(m, m);
  for (int a = 0; a < m; ++a) inOrder.col(order[a]) = toPrimal.col(a);
  const Matrix below = product(CblasNoTrans, dp, inOrder);
  for (int a = 0; a < m; ++a) basis.row(primal[a]) = inOrder.row(a);
  for (int i = 0; i < d; ++i) basis.row(dual[i]) = -below.row(i);
  const Matrix energy = inOrder.transpose() * (pp.selfadjointView<Eigen::Lower>() * inOrder);
  energy_ = 0.5 * (energy + energy.transpose());
  rotation.fromColumns(basis);

  // The largest diagonal entries estimate the condition number; those of the factor alone may already show that it is too large.
  const double stiffest = diagonal.size() > 0 ? diagonal.maxCoeff() : 0.0;
  double softest = 0.0;
  for (int i = 0; i < d; ++i) softest = std::max(softest, 1.0 / (trapezoid(i, i) * trapezoid(i, i)));
  if (d >= kLeastForSingle && stiffest * softest < kConditionForSingle) {
    // Scaled by its largest entry, so that all values stay within the narrow range of single precision.
    Dense<float> inverse = inverseOf<float>((trapezoid.topRows(d) / std::sqrt(stiffest)).cast<float>(), dual, n, rotation, softest);
    if (softest < kConditionForSingle) {
      int power = 0;
      inverse *= static_cast<float>(std::frexp(1.0 / stiffest, &power));
      inverse_ = PackedSymmetric(inverse, std::ldexp(1.0, power));
      basis_ = PackedColumns(basis, PackedSymmetric::Precision::Single);
      return;
    }
  }
  inverse_ = PackedSymmetric(inverseOf<double>(trapezoid.topRows(d), dual, n, rotation, softest));
  basis_ = PackedColumns(basis);
}

}  // namespace suture
