#include <suture/base/Errors.hpp>
#include <suture/subdomain/ExplicitSchurComplement.hpp>

namespace suture {

Schema ExplicitSchurComplement::schema() {
  return Schema("A dense matrix, from one sparse factorisation with the interface last (CHOLMOD).");
}

void ExplicitSchurComplement::doCompute(const SchurData& data) {
  boundary_ = data.boundary;
  interior_ = complement(static_cast<int>(data.stiffness.rows()), boundary_);
  std::vector<int> order = interior_;
  order.insert(order.end(), boundary_.begin(), boundary_.end());
  ib_ = block(data.stiffness, interior_, boundary_);
  const SparseMatrix ordered = block(data.stiffness, order, order);
  CholmodOptions options;
  options.trailing = static_cast<int>(boundary_.size());
  // The matrix of a floating body is singular, and so is what is left of it for the boundary; the shift is taken off again.
  options.shift = CholmodFactor::trailingDiagonal(ordered, options.trailing);
  try {
    factor_ = std::make_unique<CholmodFactor>(ordered, options);
  } catch (const NumericalError& error) {
    throw NumericalError(data.what + ", interior: " + error.what());
  }
  schur_ = PackedSymmetric(factor_->trailingSchur());

  Matrix response(static_cast<int>(interior_.size()), 1);
  for (std::size_t i = 0; i < interior_.size(); ++i) response(static_cast<int>(i), 0) = data.load(interior_[i]);
  const Vector load = response.col(0);
  factor_->solveLeading(response);
  interiorResponse_ = response.col(0);
  interiorEnergy_ = -0.5 * load.dot(interiorResponse_);
  condensedLoad_ = Vector(boundary_.size());
  for (std::size_t i = 0; i < boundary_.size(); ++i) condensedLoad_(static_cast<int>(i)) = data.load(boundary_[i]);
  condensedLoad_ -= ib_.transpose() * interiorResponse_;
}

void ExplicitSchurComplement::doApply(ConstLocalView trace, LocalView flux) const {
  schur_.multiply(trace, flux);
}

Vector ExplicitSchurComplement::recover(const Vector& trace) const {
  Matrix interior = ib_ * trace;
  factor_->solveLeading(interior);
  Vector all(static_cast<int>(interior_.size() + boundary_.size()));
  for (std::size_t i = 0; i < interior_.size(); ++i)
    all(interior_[i]) = interiorResponse_(static_cast<int>(i)) - interior(static_cast<int>(i), 0);
  for (std::size_t i = 0; i < boundary_.size(); ++i) all(boundary_[i]) = trace(static_cast<int>(i));
  return all;
}

}  // namespace suture
