#include <suture/constraints/pairing/DualBasis.hpp>

#include <Eigen/Cholesky>

namespace suture {

DualBasis::DualBasis(const Matrix& shapes, const Vector& weights) {
  const Eigen::Index functions = shapes.rows();
  Matrix mass = Matrix::Zero(functions, functions);
  Vector integral = Vector::Zero(functions);
  for (Eigen::Index q = 0; q < shapes.cols(); ++q) {
    const Vector chi = shapes.col(q);
    mass += weights(q) * chi * chi.transpose();
    integral += weights(q) * chi;
  }
  dual_ = integral.asDiagonal() * mass.ldlt().solve(Matrix::Identity(functions, functions));
}

}  // namespace suture
