#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/algebra/solvers/CholmodSolver.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

Schema CholmodSolver::schema() {
  Schema schema("CHOLMOD of SuiteSparse.");
  schema.oneOf(
      "Ordering", "Automatic", {"AMD", "Automatic", "METIS"},
      "Fill-reducing ordering. Automatic: METIS if nodes have three unknowns, as in 3D, for a tenth less memory; else AMD, which is "
      "faster.");
  return schema;
}

CholmodSolver::CholmodSolver(const Parameters& own) : ordering_(own.get<std::string>("Ordering")) {}

CholmodSolver::~CholmodSolver() = default;

std::unique_ptr<SingleFactor> CholmodSolver::inSinglePrecision() const { return factor_ ? factor_->inSinglePrecision() : nullptr; }

void CholmodSolver::doFactorise(const SparseMatrix& matrix) {
  CholmodOptions options;
  options.ordering = CholmodOptions::orderingNamed(ordering_);
  factor_ = std::make_unique<CholmodFactor>(matrix, options);
}

void CholmodSolver::doSolve(LocalView x) const { factor_->solve(x); }

}  // namespace suture
