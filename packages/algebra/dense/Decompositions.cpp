#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>
#include <Teuchos_LAPACK.hpp>
#include <algorithm>
#include <limits>

namespace suture {

SingularValues singularValues(const Matrix& matrix) {
  const Eigen::Index m = matrix.cols();
  if (matrix.rows() == 0 || m == 0) return {Vector(0), Matrix(matrix.rows(), 0), Matrix::Identity(m, m)};
  if (matrix.rows() > m) {  // the small triangle of a QR has the same values and right vectors
    const Eigen::HouseholderQR<Matrix> qr(matrix);
    SingularValues small = singularValues(qr.matrixQR().topRows(m).triangularView<Eigen::Upper>());
    Matrix u = Matrix::Zero(matrix.rows(), small.u.cols());
    u.topRows(m) = small.u;
    small.u = qr.householderQ() * u;
    return small;
  }
  const Eigen::JacobiSVD<Matrix> svd(matrix, Eigen::ComputeThinU | Eigen::ComputeFullV);
  return {svd.singularValues(), svd.matrixU(), svd.matrixV()};
}

Matrix nullSpace(const Matrix& rows, double threshold) {
  const SingularValues svd = singularValues(rows);
  if (threshold < 0.0) threshold = 1e-10 * std::max(1.0, svd.values.size() > 0 ? svd.values(0) : 0.0);
  Eigen::Index rank = 0;
  while (rank < svd.values.size() && svd.values(rank) > threshold) ++rank;
  return svd.v.rightCols(rows.cols() - rank);
}

Matrix orthonormalBasis(const Matrix& columns, double threshold) {
  if (columns.rows() == 0 || columns.cols() == 0) return Matrix(columns.rows(), 0);
  Eigen::ColPivHouseholderQR<Matrix> qr(columns);
  qr.setThreshold(threshold);
  return qr.householderQ() * Matrix::Identity(columns.rows(), qr.rank());
}

Vector leastSquares(const Matrix& a, const Vector& b) { return a.colPivHouseholderQr().solve(b); }

std::vector<int> pivotRows(const Matrix& columns) {
  const Eigen::ColPivHouseholderQR<Matrix> qr(columns.transpose());
  const auto& order = qr.colsPermutation().indices();
  return std::vector<int>(order.data(), order.data() + std::min(columns.cols(), columns.rows()));
}

Eigenpairs symmetricEigenpairs(const Matrix& matrix) {
  const Eigen::SelfAdjointEigenSolver<Matrix> solver(matrix);
  return {solver.eigenvalues(), solver.eigenvectors()};
}

std::vector<double> tridiagonalEigenvalues(const std::vector<double>& diagonal, const std::vector<double>& offDiagonal) {
  const int n = static_cast<int>(diagonal.size());
  if (n == 0) return {};
  // LAPACK, because Eigen's solver silently fails on the long Lanczos matrices of badly conditioned systems.
  std::vector<double> values = diagonal, off = offDiagonal;
  off.resize(n);
  double none = 0.0;
  int info = 0;
  std::vector<double> work(2 * n);
  Teuchos::LAPACK<int, double>().STEQR('N', n, values.data(), off.data(), &none, 1, work.data(), &info);
  if (info != 0) throw NumericalError("the eigenvalues of a tridiagonal matrix were not found");
  std::sort(values.begin(), values.end());
  return values;
}

bool choleskyFactor(const Matrix& matrix, Matrix& lower) {
  const Eigen::LLT<Matrix> llt(matrix);
  if (llt.info() != Eigen::Success) return false;
  lower = llt.matrixL();
  return true;
}

Matrix choleskySolve(const Matrix& lower, Matrix rhs) {
  if (lower.rows() == 0) return rhs;
  lower.triangularView<Eigen::Lower>().solveInPlace(rhs);
  lower.transpose().triangularView<Eigen::Upper>().solveInPlace(rhs);
  return rhs;
}

Matrix solvePositive(const Matrix& matrix, const Matrix& rhs) {
  const Eigen::LLT<Matrix> llt(matrix);
  if (llt.info() != Eigen::Success) throw NumericalError("a dense matrix that should be positive definite is not");
  return llt.solve(rhs);
}

Matrix generalInverse(const Matrix& matrix, double& condition) {
  const Eigen::PartialPivLU<Matrix> lu(matrix);
  const Matrix inverse = lu.inverse();
  const auto size = [](const Matrix& m) { return m.cwiseAbs().colwise().sum().maxCoeff(); };
  condition = inverse.allFinite() ? size(matrix) * size(inverse) : std::numeric_limits<double>::infinity();
  return inverse;
}

Matrix pick(const Matrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns) {
  Matrix part(static_cast<int>(rows.size()), static_cast<int>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (std::size_t i = 0; i < rows.size(); ++i) part(static_cast<int>(i), static_cast<int>(j)) = matrix(rows[i], columns[j]);
  return part;
}

}  // namespace suture
