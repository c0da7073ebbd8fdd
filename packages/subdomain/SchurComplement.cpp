#include <suture/algebra/GeneralisedInverse.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/subdomain/AutomaticSchurComplement.hpp>
#include <suture/subdomain/ExplicitSchurComplement.hpp>
#include <suture/subdomain/SchurComplement.hpp>

namespace suture {

void registerBuiltIns(Registry<SchurComplement>& registry) {
  registry.add("Automatic", AutomaticSchurComplement::schema(),
               [](const Parameters& own) { return std::make_unique<AutomaticSchurComplement>(own); });
  registry.add("Implicit", ImplicitSchurComplement::schema(),
               [](const Parameters&) { return std::make_unique<ImplicitSchurComplement>(); });
  registry.add("Explicit", ExplicitSchurComplement::schema(),
               [](const Parameters&) { return std::make_unique<ExplicitSchurComplement>(); });
}

Schema ImplicitSchurComplement::schema() { return Schema("Back-substitutions with a factor of the interior block (the paper's)."); }

void ImplicitSchurComplement::doCompute(const SchurData& data) {
  boundary_ = data.boundary;
  interior_ = complement(data.stiffness.rows(), boundary_);
  const SparseMatrix stiffness = data.stiffness.full();
  ib_ = block(stiffness, interior_, boundary_);
  bb_ = block(stiffness, boundary_, boundary_);
  interiorSolver_ = data.solver();
  try {
    interiorSolver_->factorise(block(stiffness, interior_, interior_));
  } catch (const NumericalError& error) {
    throw NumericalError(data.what + ", interior: " + error.what());
  }
  interiorResponse_ = Vector(interior_.size());
  for (std::size_t i = 0; i < interior_.size(); ++i) interiorResponse_(i) = data.load(interior_[i]);
  const Vector load = interiorResponse_;
  interiorSolver_->solve(interiorResponse_);
  interiorEnergy_ = -0.5 * load.dot(interiorResponse_);
  condensedLoad_ = Vector(boundary_.size());
  for (std::size_t i = 0; i < boundary_.size(); ++i) condensedLoad_(i) = data.load(boundary_[i]);
  condensedLoad_ -= ib_.transpose() * interiorResponse_;
}

void ImplicitSchurComplement::doApply(ConstLocalView trace, LocalView flux) const {
  thread_local std::vector<double> kept;
  WorkSpace space(ib_.rows(), trace.cols(), kept);
  Eigen::Map<Matrix>& interior = space.values;
  interior.noalias() = ib_ * trace;
  interiorSolver_->solve(interior);
  flux.noalias() = bb_ * trace;
  flux.noalias() -= ib_.transpose() * interior;
}

Vector ImplicitSchurComplement::recover(const Vector& trace) const {
  Vector interior = ib_ * trace;
  interiorSolver_->solve(interior);
  Vector all(interior_.size() + boundary_.size());
  for (std::size_t i = 0; i < interior_.size(); ++i) all(interior_[i]) = interiorResponse_(i) - interior(i);
  for (std::size_t i = 0; i < boundary_.size(); ++i) all(boundary_[i]) = trace(i);
  return all;
}

}  // namespace suture
