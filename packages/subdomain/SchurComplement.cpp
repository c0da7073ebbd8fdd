#include <suture/algebra/GeneralisedInverse.hpp>
#include <suture/algebra/Trial.hpp>
#include <suture/algebra/WorkSpace.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/subdomain/AutomaticSchurComplement.hpp>
#include <suture/subdomain/ExplicitSchurComplement.hpp>
#include <suture/subdomain/SchurComplement.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

void registerBuiltIns(Registry<SchurComplement>& registry) {
  registry.add("Automatic", AutomaticSchurComplement::schema(),
               [](const Parameters& own) { return std::make_unique<AutomaticSchurComplement>(own); });
  registry.add("Implicit", ImplicitSchurComplement::schema(),
               [](const Parameters& own) { return std::make_unique<ImplicitSchurComplement>(own); });
  registry.add("Explicit", ExplicitSchurComplement::schema(),
               [](const Parameters&) { return std::make_unique<ExplicitSchurComplement>(); });
}

Schema ImplicitSchurComplement::schema() {
  Schema schema("Back-substitutions with a factor of the interior block (as in the paper).");
  schema.oneOf("Precision", "Double", {"Double", "Single"},
               "Precision of the factor. Single: half the memory, two back-substitutions instead of one; results do not depend on it.");
  return schema;
}

ImplicitSchurComplement::ImplicitSchurComplement(Precision precision) : wanted_(precision) {}
ImplicitSchurComplement::ImplicitSchurComplement(const Parameters& own)
    : wanted_(own.get<std::string>("Precision") == "Single" ? Precision::Single : Precision::Double) {}
ImplicitSchurComplement::~ImplicitSchurComplement() = default;

namespace {

void put(ConstLocalView values, const std::vector<int>& positions, LocalView all) {
  for (std::size_t i = 0; i < positions.size(); ++i) all.row(positions[i]) = values.row(static_cast<Eigen::Index>(i));
}

// Largest relative change of a flux by single precision that is accepted: the accuracy of sums of some thousand terms in double precision.
constexpr double kSingleAccuracy = 1e-12;

void take(ConstLocalView all, const std::vector<int>& positions, LocalView values) {
  for (std::size_t i = 0; i < positions.size(); ++i) values.row(static_cast<Eigen::Index>(i)) = all.row(positions[i]);
}

}  // namespace

void ImplicitSchurComplement::doCompute(const SchurData& data) {
  stiffness_ = &data.stiffness;
  boundary_ = data.boundary;
  interior_ = complement(data.stiffness.rows(), boundary_);
  interiorSolver_ = data.solver();
  const SparseMatrix stiffness = data.stiffness.full();
  try {
    interiorSolver_->factorise(principalBlock(stiffness, interior_));
  } catch (const NumericalError& error) {
    throw NumericalError(data.what + ", interior: " + error.what());
  }
  single_.reset();
  doReload(data);
  if (wanted_ == Precision::Single) tryInSinglePrecision(stiffness);
}

void ImplicitSchurComplement::doReload(const SchurData& data) {
  interiorResponse_ = Vector(interior_.size());
  take(data.load, interior_, interiorResponse_);
  const Vector load = interiorResponse_;
  if (single_) {
    Vector inside = data.load;
    single_->solve(*stiffness_, inside);
    take(inside, interior_, interiorResponse_);
  } else {
    interiorSolver_->solve(interiorResponse_);
  }
  interiorEnergy_ = -0.5 * load.dot(interiorResponse_);
  Vector all = Vector::Zero(data.stiffness.rows());
  put(interiorResponse_, interior_, all);
  const Vector product = data.stiffness * all;
  condensedLoad_ = Vector(boundary_.size());
  for (std::size_t i = 0; i < boundary_.size(); ++i) condensedLoad_(i) = data.load(boundary_[i]) - product(boundary_[i]);
}

void ImplicitSchurComplement::tryInSinglePrecision(const SparseMatrix& stiffness) {
  std::unique_ptr<SingleFactor> made = interiorSolver_->inSinglePrecision();
  if (!made) return;
  made->renumber(interior_);
  coupling_ = SparseMatrix(stiffness.rows(), static_cast<int>(boundary_.size()));
  std::vector<char> isInterior(stiffness.rows(), 0);
  for (const int unknown : interior_) isInterior[unknown] = 1;
  for (int j = 0; j < coupling_.cols(); ++j) {
    coupling_.startVec(j);
    for (SparseMatrix::InnerIterator it(stiffness, boundary_[j]); it; ++it)
      if (isInterior[it.row()]) coupling_.insertBack(it.row(), j) = it.value();
  }
  coupling_.finalize();
  coupling_.data().squeeze();
  const auto applied = [this](ConstLocalView trace, LocalView flux) { doApply(trace, flux); };
  if (effectOf(static_cast<int>(boundary_.size()), applied, [&] { single_ = std::move(made); }) <= kSingleAccuracy)
    interiorSolver_.reset();
  else
    single_.reset();
  if (!single_) coupling_ = SparseMatrix();
}

void ImplicitSchurComplement::doApply(ConstLocalView trace, LocalView flux) const {
  thread_local std::vector<double> keptAll, keptProduct, keptInterior;
  const Eigen::Index n = stiffness_->rows(), columns = trace.cols();
  WorkSpace all(n, columns, keptAll), product(n, columns, keptProduct);
  const auto multiply = [&] { product.values.noalias() = stiffness_->lower().selfadjointView<Eigen::Lower>() * all.values; };
  if (single_) {
    // A E t, then with the interior residual of the extension, E^T A E t.
    WorkSpace inside(n, columns, keptInterior);
    product.values.noalias() = coupling_ * trace;
    single_->apply(product.values, inside.values);
    all.values = -inside.values;
    put(trace, boundary_, all.values);
    multiply();
    take(product.values, boundary_, flux);
    single_->apply(product.values, all.values);
    flux.noalias() -= coupling_.transpose() * all.values;
    return;
  }
  all.values.setZero();
  put(trace, boundary_, all.values);
  multiply();
  WorkSpace interior(interior_.size(), columns, keptInterior);
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
  if (single_) {
    Vector harmonic = *stiffness_ * all;
    single_->solve(*stiffness_, harmonic);
    take(harmonic, interior_, interior);
  } else {
    take(*stiffness_ * all, interior_, interior);
    interiorSolver_->solve(interior);
  }
  interior = interiorResponse_ - interior;
  put(interior, interior_, all);
  return all;
}

}  // namespace suture
