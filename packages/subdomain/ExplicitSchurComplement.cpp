#include <suture/base/Errors.hpp>
#include <suture/subdomain/ExplicitSchurComplement.hpp>

namespace suture {

Schema ExplicitSchurComplement::schema() {
  return Schema("A dense matrix, from one sparse factorisation with the interface last (CHOLMOD).");
}

void ExplicitSchurComplement::doCompute(const SchurData& data) {
  stiffness_ = &data.stiffness;
  load_ = &data.load;
  boundary_ = data.boundary;
  const std::vector<int> interior = complement(static_cast<int>(data.stiffness.rows()), boundary_);
  std::vector<int> order = interior;
  order.insert(order.end(), boundary_.begin(), boundary_.end());
  const SparseMatrix ordered = block(data.stiffness, order, order);
  CholmodOptions options;
  options.form = CholmodOptions::Form::Supernodal;
  options.trailing = static_cast<int>(boundary_.size());
  // The matrix of a floating body is singular, and so is what is left of it for the boundary; the shift is taken off again.
  options.shift = CholmodFactor::trailingDiagonal(ordered, options.trailing);
  std::unique_ptr<CholmodFactor> factor;
  try {
    factor = std::make_unique<CholmodFactor>(ordered, options);
  } catch (const NumericalError& error) {
    throw NumericalError(data.what + ", interior: " + error.what());
  }
  schur_ = PackedSymmetric(factor->trailingSchur());
  factor_ = factor->leadingInSingle(order);

  condensedLoad_ = rowsAt(data.load, boundary_);
  Matrix response = rowsAt(data.load, interior);
  if (response.isZero(0.0)) return;
  const Vector load = response.col(0);
  factor->solveLeading(response);
  interiorEnergy_ = -0.5 * load.dot(response.col(0));
  Vector all = Vector::Zero(data.stiffness.rows());
  for (std::size_t i = 0; i < interior.size(); ++i) all(interior[i]) = response(static_cast<int>(i), 0);
  condensedLoad_ -= rowsAt(data.stiffness * all, boundary_);
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
