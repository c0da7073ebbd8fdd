#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

// Decompositions of small dense matrices, compiled once: Eigen's are expensive to compile. Local.

/// matrix = u diag(values) v^T; values descend; u is thin, v complete (its last columns span the null space of a wide matrix).
struct SingularValues {
  Vector values;
  Matrix u, v;
};
SingularValues singularValues(const Matrix& matrix);

/// Orthonormal basis of the null space: the right singular vectors whose singular value is at most `threshold`. The default is 1e-10 times
/// the largest singular value (or 1, if that is larger: rows should be scaled to order one). No rows: the identity.
Matrix nullSpace(const Matrix& rows, double threshold = -1.0);

/// Orthonormal basis of the columns' span, by a QR decomposition with pivoting: columns whose remainder is below `threshold` times the
/// largest are omitted.
Matrix orthonormalBasis(const Matrix& columns, double threshold);

/// x that minimises |a x - b|, by the same decomposition.
Vector leastSquares(const Matrix& a, const Vector& b);

/// The rows that determine the columns best, as many as there are columns: the first pivots of a QR of the transpose.
std::vector<int> pivotRows(const Matrix& columns);

/// Eigenvalues and eigenvectors of a symmetric matrix, ascending.
struct Eigenpairs {
  Vector values;
  Matrix vectors;
};
Eigenpairs symmetricEigenpairs(const Matrix& matrix);

/// Eigenvalues of a symmetric tridiagonal matrix, ascending.
std::vector<double> tridiagonalEigenvalues(const std::vector<double>& diagonal, const std::vector<double>& offDiagonal);

/// lower * lower^T = matrix; false, with `lower` undefined, if the matrix is not positive definite to working accuracy.
bool choleskyFactor(const Matrix& matrix, Matrix& lower);

/// (lower * lower^T)^-1 rhs.
Matrix choleskySolve(const Matrix& lower, Matrix rhs);

/// matrix^-1 rhs for a symmetric positive definite matrix. \throws NumericalError  if it is not positive definite.
Matrix solvePositive(const Matrix& matrix, const Matrix& rhs);

/// matrix^-1 of any square matrix, by elimination with row pivoting. \param condition  gets an estimate of |matrix| |matrix^-1| in the
/// one-norm; infinite, with an undefined result, if a pivot vanishes.
Matrix generalInverse(const Matrix& matrix, double& condition);

/// matrix(rows, columns).
Matrix pick(const Matrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns);

}  // namespace suture
