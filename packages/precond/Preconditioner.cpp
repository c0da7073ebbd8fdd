#include <suture/base/Timers.hpp>
#include <suture/precond/Bddc.hpp>
#include <suture/precond/NeumannNeumann.hpp>
#include <suture/precond/Preconditioner.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_MultiVector.hpp>

namespace suture {

namespace {

bool onAllRanks(const Comm& comm, bool here) {
  const int mine = here;
  int all = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  return all != 0;
}

}  // namespace

void Preconditioner::initialize(std::shared_ptr<const InterfaceSpace> space) {
  if (isComputed_ && onAllRanks(*space->comm(), space == space_)) return;
  isComputed_ = false;
  space_ = std::move(space);
  doInitialize();
}

void Preconditioner::compute(Teuchos::RCP<const InterfaceOperator> matrix) {
  const double begin = Timers::now();
  if (!space_) throw InternalError("compute() of a preconditioner before initialize()");
  if (matrix->space() != space_) throw InternalError("the operator given to a preconditioner is on a different space");
  const auto isHeldBySprings = [](const InterfaceOperator& of) { return of.friction() && !of.friction()->motions.is_null(); };
  const bool same = isComputed_ && onAllRanks(*space_->comm(), matrix->locals() == matrix_->locals() && !isHeldBySprings(*matrix) &&
                                                                   !isHeldBySprings(*matrix_));
  matrix_ = std::move(matrix);
  if (same) return;
  isComputed_ = false;
  doCompute();
  isComputed_ = true;
  setupSeconds_ += Timers::now() - begin;
}

void Preconditioner::apply(const MultiVector& r, MultiVector& z, Teuchos::ETransp, double alpha, double beta) const {
  if (matrix_.is_null()) throw InternalError("a preconditioner is applied before compute()");
  ++applications_;
  const InterfaceOperator::Unrecorded itsOwn(*matrix_);
  if (alpha == 1.0 && beta == 0.0) {
    doApply(r, z);
    return;
  }
  const MultiVectorPtr product = space_->vector(static_cast<int>(r.getNumVectors()));
  doApply(r, *product);
  z.update(alpha, *product, beta);
}

std::optional<std::vector<Vector>> Preconditioner::brokenCorrection(const MultiVector& r) const {
  if (matrix_.is_null()) throw InternalError("a preconditioner is applied before compute()");
  const InterfaceOperator::Unrecorded itsOwn(*matrix_);
  return doBrokenCorrection(r);
}

void registerBuiltIns(Registry<Preconditioner>& registry) {
  registry.add("BDDC", Bddc::schema, [](const Parameters& own) { return std::make_unique<Bddc>(own); });
  registry.add("Neumann-Neumann", NeumannNeumann::schema, [](const Parameters& own) { return std::make_unique<NeumannNeumann>(own); });
}

Schema preconditionerSchema() {
  Schema schema("Preconditioner of the interface problem.");
  schema.choice("Type", "BDDC", Registry<Preconditioner>::instance().schemas(), "Name of the preconditioner.");
  return schema;
}

Teuchos::RCP<Preconditioner> makePreconditioner(const Parameters& preconditioner) {
  return Teuchos::rcp(makeStrategy<Preconditioner>(preconditioner, "Type").release());
}

}  // namespace suture
