#include <suture/algebra/elimination/StaticCondensation.hpp>
#include <suture/base/Errors.hpp>
#include <suture/subdomain/ExplicitSchurComplement.hpp>

namespace suture {

Schema ExplicitSchurComplement::schema() {
  return Schema("Dense matrix, from one multifrontal elimination of the interior (BLAS; nested dissection).");
}

namespace {

// Smallest relative pivot for which a factor in single precision is used. SingleFactor needs 2 or 3 steps in bodies held firmly, slender
// beams (1e-4) among them, 7 at 4e-8, 17 at 4e-10, 42 at 4e-11, and fails at 4e-12 (a disc on springs from 1e4 to 1e-3, in their units).
constexpr double kSinglePivot = 1e-7;

}  // namespace

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
    exact_.reset();
    if (condensation.smallestPivot() < kSinglePivot) {
      interior_ = complement(data.stiffness.rows(), boundary_);
      exact_ = data.solver();
      exact_->factorise(principalBlock(data.stiffness.full(), interior_));
    }
  } catch (const NumericalError& error) {
    throw NumericalError(data.what + ", interior: " + error.what());
  }
}

void ExplicitSchurComplement::doReload(const SchurData& data) {
  load_ = &data.load;
  Vector inside = *load_;
  solveInterior(inside);
  const Vector rest = *load_ - *stiffness_ * inside;
  for (std::size_t i = 0; i < boundary_.size(); ++i) condensedLoad_(static_cast<Eigen::Index>(i)) = rest(boundary_[i]);
  interiorEnergy_ = -0.5 * load_->dot(inside);
}

void ExplicitSchurComplement::doApply(ConstLocalView trace, LocalView flux) const { schur_.multiply(trace, flux); }

void ExplicitSchurComplement::solveInterior(Vector& x) const {
  if (!exact_) {
    factor_.solve(*stiffness_, x);
    return;
  }
  Vector inside = x(interior_);
  exact_->solve(inside);
  x.setZero();
  x(interior_) = inside;
}

Vector ExplicitSchurComplement::recover(const Vector& trace) const {
  Vector all = Vector::Zero(stiffness_->rows());
  for (std::size_t i = 0; i < boundary_.size(); ++i) all(boundary_[i]) = trace(static_cast<int>(i));
  Vector interior = *load_ - *stiffness_ * all;
  solveInterior(interior);
  return all + interior;
}

}  // namespace suture
