#include <suture/algebra/elimination/StaticCondensation.hpp>
#include <suture/base/Errors.hpp>
#include <suture/subdomain/ExplicitSchurComplement.hpp>

namespace suture {

Schema ExplicitSchurComplement::schema() {
  return Schema("Dense matrix, from one multifrontal elimination of the interior (BLAS; nested dissection).");
}

void ExplicitSchurComplement::doCompute(const SchurData& data) {
  stiffness_ = &data.stiffness;
  load_ = &data.load;
  boundary_ = data.boundary;
  try {
    StaticCondensation condensation(data.stiffness, data.load, boundary_, data.places);
    schur_ = PackedSymmetric(condensation.schur());
    factor_ = std::move(condensation.factor());
    condensedLoad_ = condensation.condensedLoad();
    interiorEnergy_ = condensation.interiorEnergy();
  } catch (const NumericalError& error) {
    throw NumericalError(data.what + ", interior: " + error.what());
  }
}

void ExplicitSchurComplement::doReload(const SchurData& data) {
  load_ = &data.load;
  Vector inside = *load_;
  factor_.solve(*stiffness_, inside);
  const Vector rest = *load_ - *stiffness_ * inside;
  for (std::size_t i = 0; i < boundary_.size(); ++i) condensedLoad_(static_cast<Eigen::Index>(i)) = rest(boundary_[i]);
  interiorEnergy_ = -0.5 * load_->dot(inside);
}

void ExplicitSchurComplement::doApply(ConstLocalView trace, LocalView flux) const { schur_.multiply(trace, flux); }

Vector ExplicitSchurComplement::recover(const Vector& trace) const {
  Vector all = Vector::Zero(stiffness_->rows());
  for (std::size_t i = 0; i < boundary_.size(); ++i) all(boundary_[i]) = trace(static_cast<int>(i));
  Vector interior = *load_ - *stiffness_ * all;
  factor_.solve(*stiffness_, interior);
  return all + interior;
}

}  // namespace suture
