#include <cblas.h>
#include <suture/base/Errors.hpp>
#include <suture/subdomain/ConstrainedInverse.hpp>
#include <suture/subdomain/SparseMatrix.hpp>

#include <Eigen/Cholesky>
#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <cmath>

// LAPACK: L <- L^T L in place.
extern "C" void dlauum_(const char* uplo, const int* n, double* a, const int* lda, int* info);

namespace suture {

namespace {

/// c <- factor * a b + share * c, a transposed if told. By BLAS: Eigen's own is compiled for the oldest processors.
void multiply(double factor, CBLAS_TRANSPOSE transposed, const Matrix& a, const Matrix& b, double share, Matrix& c) {
  const int rows = static_cast<int>(transposed == CblasTrans ? a.cols() : a.rows()), columns = static_cast<int>(b.cols());
  if (share == 0.0) c.resize(rows, columns);
  if (c.size() == 0 || b.rows() == 0) {
    if (share == 0.0) c.setZero();
    return;
  }
  cblas_dgemm(CblasColMajor, transposed, CblasNoTrans, rows, columns, static_cast<int>(b.rows()), factor, a.data(),
              static_cast<int>(a.rows()), b.data(), static_cast<int>(b.rows()), share, c.data(), rows);
}

Matrix product(CBLAS_TRANSPOSE transposed, const Matrix& a, const Matrix& b) {
  Matrix c;
  multiply(1.0, transposed, a, b, 0.0, c);
  return c;
}

/// H = I - 2 v v^T, v zero off the support.
struct Reflection {
  std::vector<int> support;
  Vector v;  // of length one

  /// x <- x H
  void onColumns(Matrix& x) const {
    Vector product = Vector::Zero(x.rows());
    for (std::size_t k = 0; k < support.size(); ++k) product += v(static_cast<int>(k)) * x.col(support[k]);
    for (std::size_t k = 0; k < support.size(); ++k) x.col(support[k]) -= 2.0 * v(static_cast<int>(k)) * product;
  }
};

/// Q = H_1 ... H_m = I - V T V^T, T an upper triangle (Schreiber and Van Loan 1989): products of matrices instead of vectors.
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
  void to(Matrix& a) const { twoSided(a, t_); }
  /// a <- Q a Q^T, lower triangle.
  void from(Matrix& a) const { twoSided(a, t_.transpose()); }
  /// x <- Q x
  void fromColumns(Matrix& x) const { multiply(-1.0, CblasNoTrans, v_, product(CblasNoTrans, t_, product(CblasTrans, v_, x)), 1.0, x); }

 private:
  /// a <- (I - V U^T) a (I - U V^T) = a - V W^T - W V^T with U = V T, X = a U, W = X - V (U^T X) / 2.
  void twoSided(Matrix& a, const Matrix& t) const {
    const int n = static_cast<int>(v_.rows()), m = static_cast<int>(v_.cols());
    if (m == 0) return;
    const Matrix u = product(CblasNoTrans, v_, t);
    Matrix w(n, m);
    cblas_dsymm(CblasColMajor, CblasLeft, CblasLower, n, m, 1.0, a.data(), n, u.data(), n, 0.0, w.data(), n);
    multiply(-0.5, CblasNoTrans, v_, product(CblasTrans, u, w), 1.0, w);
    cblas_dsyr2k(CblasColMajor, CblasLower, CblasNoTrans, n, m, -1.0, v_.data(), n, w.data(), n, 1.0, a.data(), n);
  }

  Matrix v_, t_;
};

// a <- its inverse, lower triangle, in place. By halves, so that nearly all is products of matrices: LAPACK's dtrtri as OpenBLAS has it
// goes column by column and takes three times as long as the factorisation before it (n = 350).
void invertLower(double* a, int n, int stride) {
  constexpr int small = 24;
  if (n <= small) {
    for (int j = 0; j < n; ++j) {
      double* column = a + static_cast<std::ptrdiff_t>(j) * stride;
      column[j] = 1.0 / column[j];
      for (int i = j + 1; i < n; ++i) {
        double sum = 0.0;
        for (int k = j; k < i; ++k) sum += a[i + static_cast<std::ptrdiff_t>(k) * stride] * column[k];
        column[i] = -sum / a[i + static_cast<std::ptrdiff_t>(i) * stride];
      }
    }
    return;
  }
  const int half = n / 2, rest = n - half;
  double *below = a + half, *last = a + half + static_cast<std::ptrdiff_t>(half) * stride;
  invertLower(a, half, stride);
  invertLower(last, rest, stride);
  cblas_dtrmm(CblasColMajor, CblasRight, CblasLower, CblasNoTrans, CblasNonUnit, rest, half, -1.0, a, stride, below, stride);
  cblas_dtrmm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, rest, half, 1.0, last, stride, below, stride);
}

// Entries in single precision are off by 6e-8 of the matrix, so that its smallest eigenvalues are off by the condition times that: up to
// this condition less than a thousandth, which conjugate gradients do not notice.
constexpr double kConditionForSingle = 1e4;
constexpr int kLeastForSingle = 192;  // memory is what it saves: smaller ones have little
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
      reflections.push_back(std::move(reflection));
    }
    taken[pivot] = 1;
  }

  const Rotation rotation(n, reflections);
  rotation.to(schur);

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
    for (int i = j; i < d; ++i) dd(i, j) = schur(dual[i], dual[j]);  // `dual` ascends: the lower triangle
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < d; ++i) dp(i, j) = schur(std::max(dual[i], primal[j]), std::min(dual[i], primal[j]));
    for (int i = 0; i < m; ++i) pp(i, j) = schur(std::max(primal[i], primal[j]), std::min(primal[i], primal[j]));
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
    if (m > 0) {
      cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, d, m, 1.0, dd.data(), d, dp.data(), d);
      multiply(-1.0, CblasTrans, dp, dp, 1.0, pp);
      cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, d, m, 1.0, dd.data(), d, dp.data(), d);
    }
    invertLower(dd.data(), d, d);
    dlauum_("L", &d, dd.data(), &d, &info);  // lower <- L^T L
  }

  Matrix basis = Matrix::Zero(n, m);
  Matrix toPrimal = Matrix::Identity(m, m);  // of the order taken, from that of the rows given
  triangle.triangularView<Eigen::Lower>().solveInPlace(toPrimal);
  Matrix inOrder(m, m);
  for (int a = 0; a < m; ++a) inOrder.col(order[a]) = toPrimal.col(a);
  const Matrix below = product(CblasNoTrans, dp, inOrder);
  for (int a = 0; a < m; ++a) basis.row(primal[a]) = inOrder.row(a);
  for (int i = 0; i < d; ++i) basis.row(dual[i]) = -below.row(i);
  const Matrix energy = inOrder.transpose() * (0.5 * (pp + pp.transpose())) * inOrder;
  energy_ = 0.5 * (energy + energy.transpose());

  Matrix inverse = Matrix::Zero(n, n);
  for (int j = 0; j < d; ++j)
    for (int i = j; i < d; ++i) inverse(dual[i], dual[j]) = dd(i, j);
  rotation.from(inverse);
  rotation.fromColumns(basis);
  const bool single = d >= kLeastForSingle && diagonal.maxCoeff() * dd.diagonal().maxCoeff() < kConditionForSingle;
  const auto precision = single ? PackedSymmetric::Precision::Single : PackedSymmetric::Precision::Double;
  inverse_ = PackedSymmetric(inverse, precision);
  basis_ = PackedColumns(basis, precision);
}

}  // namespace suture
