#include <suture/algebra/CholmodFactor.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/algebra/solvers/CholmodSolver.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

Schema CholmodSolver::schema() {
  Schema schema("CHOLMOD of SuiteSparse.");
  schema.oneOf("Ordering", "AMD", {"AMD", "METIS"}, "Fill-reducing ordering: AMD is the cheaper one in 2D, METIS pays in 3D.");
  return schema;
}

CholmodSolver::CholmodSolver(const Parameters& own) : ordering_(own.get<std::string>("Ordering")) {}

CholmodSolver::~CholmodSolver() = default;

std::unique_ptr<SingleFactor> CholmodSolver::inSinglePrecision() const { return factor_ ? factor_->inSinglePrecision() : nullptr; }

void CholmodSolver::doFactorise(const SparseMatrix& matrix) {
  CholmodOptions options;
  options.ordering = ordering_ == "METIS" ? CholmodOptions::Ordering::Metis : CholmodOptions::Ordering::Amd;
  factor_ = std::make_unique<CholmodFactor>(matrix, options);
}

void CholmodSolver::doSolve(LocalView x) const { factor_->solve(x); }

}  // namespace suture
