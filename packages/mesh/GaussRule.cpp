#include <suture/mesh/GaussRule.hpp>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace suture {

// The points are the eigenvalues of the Jacobi matrix of the Legendre polynomials, the weights follow from the first components of its
// eigenvectors (Golub and Welsch 1969).
LineRule gaussRule(int points) {
  Vector diagonal = Vector::Zero(points), beside(points - 1);
  for (int i = 1; i < points; ++i) beside(i - 1) = i / std::sqrt(4.0 * i * i - 1.0);
  Eigen::SelfAdjointEigenSolver<Matrix> jacobi;
  jacobi.computeFromTridiagonal(diagonal, beside);
  return {jacobi.eigenvalues(), 2.0 * jacobi.eigenvectors().row(0).transpose().cwiseAbs2()};
}

}  // namespace suture
