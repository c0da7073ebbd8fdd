#include <algorithm>
#include <random>
#include <support/DenseAlgebra.hpp>
#include <suture/algebra/SparseMatrix.hpp>

#include <Eigen/Dense>

namespace suture::dense {

namespace {

Matrix symmetric(const Matrix& a) { return 0.5 * (a + a.transpose()); }

}  // namespace

Vector eigenvalues(const Matrix& a) { return Eigen::SelfAdjointEigenSolver<Matrix>(symmetric(a), Eigen::EigenvaluesOnly).eigenvalues(); }

Vector eigenvalues(const Matrix& a, const Matrix& b) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Matrix>(symmetric(a), b, Eigen::EigenvaluesOnly).eigenvalues();
}

Vector eigenvaluesOfProduct(const Matrix& m, const Matrix& s) {
  const Matrix l = cholesky(s);
  return eigenvalues(l.transpose() * m * l);
}

Vector singularValues(const Matrix& a) { return Eigen::JacobiSVD<Matrix>(a).singularValues(); }
int rank(const Matrix& a) { return int(Eigen::FullPivLU<Matrix>(a).rank()); }
double determinant(const Matrix& a) { return a.determinant(); }

Matrix cholesky(const Matrix& a) { return Eigen::LLT<Matrix>(symmetric(a)).matrixL(); }
Matrix solveSymmetric(const Matrix& a, const Matrix& b) { return Eigen::LDLT<Matrix>(a).solve(b); }
Matrix solve(const Matrix& a, const Matrix& b) { return Eigen::FullPivLU<Matrix>(a).solve(b); }
Matrix inverse(const Matrix& a) { return Eigen::FullPivLU<Matrix>(a).inverse(); }
Matrix leastSquares(const Matrix& a, const Matrix& b) { return Eigen::CompleteOrthogonalDecomposition<Matrix>(a).solve(b); }
Matrix withoutSpan(const Matrix& a, const Matrix& b) { return b - a * leastSquares(a, b); }
Matrix orthogonal(const Matrix& a) { return Eigen::HouseholderQR<Matrix>(a).householderQ(); }

Matrix random(int rows, int columns, unsigned seed) {
  std::mt19937 generator(seed);
  Matrix values(rows, columns);
  for (int j = 0; j < columns; ++j)
    for (int i = 0; i < rows; ++i) values(i, j) = generator() / 2147483647.5 - 1.0;
  return values;
}

double difference(const Matrix& a, const Matrix& b) { return (a - b).norm() / std::max(b.norm(), 1e-300); }

std::vector<int> range(int count, int first) {
  std::vector<int> all(count);
  for (int i = 0; i < count; ++i) all[i] = first + i;
  return all;
}

Matrix denseSchur(const Matrix& k, const std::vector<int>& boundary, const Vector& load, Vector* condensed) {
  const std::vector<int> interior = complement(int(k.rows()), boundary);
  const Matrix rowsI = rowsAt(k, interior), rowsB = rowsAt(k, boundary);
  const Matrix ii = rowsAt(rowsI.transpose(), interior).transpose(), ib = rowsAt(rowsI.transpose(), boundary).transpose();
  const Matrix bb = rowsAt(rowsB.transpose(), boundary).transpose();
  if (condensed) *condensed = rowsAt(load, boundary);
  if (interior.empty()) return bb;
  const Eigen::LDLT<Matrix> ldlt(ii);
  if (condensed) *condensed -= ib.transpose() * ldlt.solve(rowsAt(load, interior));
  return bb - ib.transpose() * ldlt.solve(ib);
}

}  // namespace suture::dense
