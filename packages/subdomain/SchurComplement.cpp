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

namespace {

void put(ConstLocalView values, const std::vector<int>& positions, LocalView all) {
  for (std::size_t i = 0; i < positions.size(); ++i) all.row(positions[i]) = values.row(static_cast<Eigen::Index>(i));
}

void take(ConstLocalView all, const std::vector<int>& positions, LocalView values) {
  for (std::size_t i = 0; i < positions.size(); ++i) values.row(static_cast<Eigen::Index>(i)) = all.row(positions[i]);
}

}  // namespace

void ImplicitSchurComplement::doCompute(const SchurData& data) {
  stiffness_ = &data.stiffness;
  boundary_ = data.boundary;
  interior_ = complement(data.stiffness.rows(), boundary_);
  interiorSolver_ = data.solver();
  try {
    interiorSolver_->factorise(principalBlock(data.stiffness.full(), interior_));
  } catch (const NumericalError& error) {
    throw NumericalError(data.what + ", interior: " + error.what());
  }
  interiorResponse_ = Vector(interior_.size());
  for (std::size_t i = 0; i < interior_.size(); ++i) interiorResponse_(i) = data.load(interior_[i]);
  const Vector load = interiorResponse_;
  interiorSolver_->solve(interiorResponse_);
  interiorEnergy_ = -0.5 * load.dot(interiorResponse_);
  Vector all = Vector::Zero(data.stiffness.rows());
  put(interiorResponse_, interior_, all);
  const Vector product = data.stiffness * all;
  condensedLoad_ = Vector(boundary_.size());
  for (std::size_t i = 0; i < boundary_.size(); ++i) condensedLoad_(i) = data.load(boundary_[i]) - product(boundary_[i]);
}

void ImplicitSchurComplement::doApply(ConstLocalView trace, LocalView flux) const {
  thread_local std::vector<double> keptAll, keptProduct, keptInterior;
  const Eigen::Index n = stiffness_->rows(), columns = trace.cols();
  WorkSpace all(n, columns, keptAll), product(n, columns, keptProduct), interior(interior_.size(), columns, keptInterior);
  const auto multiply = [&] { product.values.noalias() = stiffness_->lower().selfadjointView<Eigen::Lower>() * all.values; };
  all.values.setZero();
  put(trace, boundary_, all.values);
  multiply();
  take(product.values, interior_, interior.values);
  interiorSolver_->solve(interior.values);
  interior.values = -interior.values;
  put(interior.values, interior_, all.values);
  multiply();
  take(product.values, boundary_, flux);
}

Vector ImplicitSchurComplement::recover(const Vector& trace) const {
  Vector all = Vector::Zero(stiffness_->rows()), interior(interior_.size());
  put(trace, boundary_, all);
  take(*stiffness_ * all, interior_, interior);
  interiorSolver_->solve(interior);
  interior = interiorResponse_ - interior;
  put(interior, interior_, all);
  return all;
}

}  // namespace suture
