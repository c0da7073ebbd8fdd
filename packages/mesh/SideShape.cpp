#include <suture/base/Errors.hpp>
#include <suture/mesh/SideShape.hpp>

#include <Eigen/Eigenvalues>
#include <cmath>

namespace suture {

SideShape sideShape(int nodes, double xi) {
  if (nodes == 2) return {{(1 - xi) / 2, (1 + xi) / 2, 0}, {-0.5, 0.5, 0}};
  if (nodes == 3) return {{xi * (xi - 1) / 2, xi * (xi + 1) / 2, 1 - xi * xi}, {xi - 0.5, xi + 0.5, -2 * xi}};
  throw InternalError("a side of " + std::to_string(nodes) + " nodes");
}

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
