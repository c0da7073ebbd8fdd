#include <suture/algebra/LocalInverse.hpp>

namespace suture {

void LocalInverse::applyBasisTransposed(const Eigen::Ref<const Vector>& flux, Vector& values) const {
  const Matrix phi = basis();
  values.setZero(phi.cols());
  if (phi.size() > 0) values = phi.transpose() * flux;
}

void LocalInverse::addBasis(const Vector& values, Eigen::Ref<Vector> trace) const {
  if (values.size() > 0) trace += basis() * values;
}

}  // namespace suture
