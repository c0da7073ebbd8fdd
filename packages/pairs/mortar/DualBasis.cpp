#include <suture/pairs/mortar/DualBasis.hpp>

#include <Eigen/Cholesky>

namespace suture {

DualBasis::DualBasis(const Matrix& shapes, const Vector& weights, double distinct) {
  const Eigen::Index functions = shapes.rows();
  Matrix mass = Matrix::Zero(functions, functions);
  Vector integral = Vector::Zero(functions);
  for (Eigen::Index q = 0; q < shapes.cols(); ++q) {
    const Vector chi = shapes.col(q);
    mass += weights(q) * chi * chi.transpose();
    integral += weights(q) * chi;
  }
  const Eigen::LDLT<Matrix> factor(mass);
  const Vector pivots = factor.vectorD();
  if (functions > 0 && distinct > 0 && !(pivots.minCoeff() > distinct * pivots.maxCoeff())) {
    dual_ = integral / integral.sum() * Vector::Ones(functions).transpose();
    return;
  }
  dual_ = integral.asDiagonal() * factor.solve(Matrix::Identity(functions, functions));
}

}  // namespace suture
