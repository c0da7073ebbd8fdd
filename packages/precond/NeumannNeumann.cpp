#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Collective.hpp>
#include <suture/precond/NeumannNeumann.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Vector.hpp>

namespace suture {

Schema NeumannNeumann::schema() {
  Schema schema("Balancing Neumann-Neumann (eq. 28-31): weighted local Neumann problems and a coarse problem of rigid-body modes.");
  schema.choice("Weighting", "Stiffness Diagonal", Registry<Weighting>::instance().schemas(),
                "Weights D_i of the subdomains at shared unknowns.");
  schema.choice("Coarse Space", "Rigid Modes", Registry<CoarseSpace>::instance().schemas(), "Traces Z_i of the coarse problem.");
  addCoarseParameters(schema);
  return schema;
}

NeumannNeumann::NeumannNeumann(const Parameters& own)
    : NeumannNeumann(
          makeStrategy<Weighting>(own, "Weighting"), makeStrategy<CoarseSpace>(own, "Coarse Space"),
          [own] { return makeStrategy<LocalSolver>(own, "Coarse Solver"); }, own.get<int>("Coarse Copies")) {}

NeumannNeumann::NeumannNeumann(std::unique_ptr<Weighting> weighting, std::unique_ptr<CoarseSpace> coarseSpace,
                               std::function<std::unique_ptr<LocalSolver>()> coarseSolver, int copies)
    : weighting_(std::move(weighting)), coarseSpace_(std::move(coarseSpace)), coarseSolver_(std::move(coarseSolver)), copies_(copies) {}

void NeumannNeumann::doInitialize() {
  coarse_.reset();  // inverses belong to local problems and are kept for any space
}

void NeumannNeumann::computeLocals() {
  const LocalProblems& locals = matrix()->locals();
  collectively(*space()->comm(), "factoring the local Neumann problems", [&] {
    locals_.resize(locals.size());
    inverses_.resize(locals.size());
    for (std::size_t i = 0; i < locals.size(); ++i) {
      if (!locals[i])
        inverses_[i].reset();
      else if (locals_[i] != locals[i])
        inverses_[i] = locals[i]->inverse();
      locals_[i] = locals[i];
    }
  });
  flux_.resize(space()->mostRows(), 1);
  trace_.resize(space()->mostRows(), 1);
}

void NeumannNeumann::doCompute() {
  const LocalProblems& locals = matrix()->locals();
  weighting_->setup(*space(), locals);
  computeLocals();
  std::vector<Matrix> columns(locals.size());
  collectively(*space()->comm(), "making the coarse space", [&] {
    for (std::size_t i = 0; i < locals.size(); ++i) {
      columns[i] = Matrix(space()->coupling(static_cast<int>(i)).rows(), 0);
      if (!locals[i]) continue;
      Matrix z = coarseSpace_->columns(*locals[i]);
      weighting_->apply(static_cast<int>(i), z);
      // Rigid-body modes are of order one, and at a stiffness jump the weights of all columns are equally small, so a smaller column is
      // linearly dependent on the others.
      columns[i] = orthonormalBasis(z, 1e-10);
    }
  });
  int mine = 0, all = 0;
  for (const Matrix& own : columns) mine += static_cast<int>(own.cols());
  Teuchos::reduceAll(*space()->comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  coarse_.reset();
  if (all > 0) coarse_ = std::make_unique<BalancingCoarse>(*matrix(), columns, coarseSolver_(), copies_);
}

void NeumannNeumann::addLocals(const Matrix& residual, Matrix& sum) const {
  for (std::size_t i = 0; i < inverses_.size(); ++i) {
    if (!inverses_[i]) continue;
    const Coupling& coupling = space()->coupling(static_cast<int>(i));
    auto flux = flux_.topRows(coupling.rows()), trace = trace_.topRows(coupling.rows());
    coupling.restrictTo(residual, flux);
    weighting_->applyTranspose(static_cast<int>(i), flux);
    inverses_[i]->apply(flux, trace);
    weighting_->apply(static_cast<int>(i), trace);
    coupling.addTransposed(trace, sum);
  }
}

/// Makes the residual orthogonal to the coarse space: r - S Q r, with Q r = Z y.
void NeumannNeumann::balanceResidual() const {
  y_ = coarse_->fromResidual(residual_);
  whole_.setZero(residual_.rows(), 1);
  coarse_->addImages(y_, whole_);
  space()->sum(whole_);
  residual_ -= whole_;
}

void NeumannNeumann::doApply(const MultiVector& r, MultiVector& z) const {
  for (std::size_t column = 0; column < r.getNumVectors(); ++column) {
    const auto rOne = r.getVector(column);
    const auto zOne = z.getVectorNonConst(column);
    space()->gather(*rOne, residual_);
    if (coarse_) balanceResidual();
    sum_.setZero(residual_.rows(), 1);
    addLocals(residual_, sum_);
    if (coarse_) {
      whole_ = sum_;
      space()->sum(whole_);
      y_ -= coarse_->fromTrace(whole_);
      coarse_->addColumns(y_, sum_);
    }
    space()->scatterAdd(sum_, *zOne);
  }
}

std::optional<std::vector<Vector>> NeumannNeumann::doBrokenCorrection(const MultiVector& r) const {
  space()->gather(r, residual_);
  Matrix coarse = Matrix::Zero(residual_.rows(), 1);
  if (coarse_) {
    balanceResidual();
    coarse_->addColumns(y_, coarse);
    space()->sum(coarse);
  }
  std::vector<Vector> traces(inverses_.size());
  for (std::size_t i = 0; i < inverses_.size(); ++i) {
    if (!inverses_[i]) continue;
    const Coupling& coupling = space()->coupling(static_cast<int>(i));
    Matrix flux(coupling.rows(), 1), trace = flux, common = flux;
    coupling.restrictTo(residual_, flux);
    weighting_->applyTranspose(static_cast<int>(i), flux);
    inverses_[i]->apply(flux, trace);
    coupling.restrictTo(coarse, common);
    traces[i] = trace.col(0) + common.col(0);
  }
  return traces;
}

}  // namespace suture
