#pragma once
#include <suture/base/Types.hpp>

#include <vector>

/// Dense linear algebra that tests compare with, compiled once: Eigen's decompositions cost seconds of compile time in every source that
/// uses them.
namespace suture::dense {

/// Eigenvalues of the symmetric part, ascending.
Vector eigenvalues(const Matrix& a);
/// Eigenvalues of A x = lambda B x, A by its symmetric part, B symmetric and definite; ascending.
Vector eigenvalues(const Matrix& a, const Matrix& b);
/// Eigenvalues of M S, with S symmetric and definite: those of L^T M L, S = L L^T; ascending.
Vector eigenvaluesOfProduct(const Matrix& m, const Matrix& s);
Vector singularValues(const Matrix& a);
int rank(const Matrix& a);
double determinant(const Matrix& a);

/// L of the symmetric part L L^T.
Matrix cholesky(const Matrix& a);
/// A symmetric: LDL^T.
Matrix solveSymmetric(const Matrix& a, const Matrix& b);
/// Any regular A, by elimination with full pivoting.
Matrix solve(const Matrix& a, const Matrix& b);
Matrix inverse(const Matrix& a);
/// The x of least norm among those that minimise |A x - b|.
Matrix leastSquares(const Matrix& a, const Matrix& b);
/// b without its part in the span of the columns of A.
Matrix withoutSpan(const Matrix& a, const Matrix& b);
/// An orthogonal matrix whose first columns span those of A.
Matrix orthogonal(const Matrix& a);

/// Numbers in [-1, 1], the same in every run and on every machine.
Matrix random(int rows, int columns, unsigned seed = 1);
/// |a - b| / |b|.
double difference(const Matrix& a, const Matrix& b);
std::vector<int> range(int count, int first = 0);
/// K_BB - K_BI K_II^-1 K_IB, and optionally the condensed load.
Matrix denseSchur(const Matrix& k, const std::vector<int>& boundary, const Vector& load = {}, Vector* condensed = nullptr);

}  // namespace suture::dense
