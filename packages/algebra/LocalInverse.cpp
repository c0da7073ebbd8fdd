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

void LocalInverse::applyWithBasis(ConstLocalView flux, const Vector&, const Vector& values, LocalView trace) const {
  apply(flux, trace);
  addBasis(values, trace.col(0));
}

}  // namespace suture
