#include <suture/algebra/LocalSolver.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/algebra/solvers/AmesosSolver.hpp>
#include <suture/algebra/solvers/CholmodSolver.hpp>

#include <Teuchos_ParameterList.hpp>

namespace suture {

void LocalSolver::factorise(const SparseMatrix& matrix) {
  if (matrix.rows() != matrix.cols()) throw InternalError("a local solver was given a matrix that is not square");
  size_ = static_cast<int>(matrix.rows());
  if (size_ > 0) doFactorise(matrix);
}

void LocalSolver::solve(LocalView x) const {
  if (x.rows() != size_) throw InternalError("a local solver was given a right-hand side of the wrong length");
  if (size_ == 0 || x.cols() == 0) return;
  solves_ += x.cols();
  doSolve(x);
}

std::unique_ptr<SingleFactor> LocalSolver::inSinglePrecision() const { return nullptr; }

void registerBuiltIns(Registry<LocalSolver>& registry) {
  registry.add("CHOLMOD", CholmodSolver::schema(), [](const Parameters& own) { return std::make_unique<CholmodSolver>(own); });
  registry.add("Amesos2", AmesosSolver::schema(), [](const Parameters& own) { return std::make_unique<AmesosSolver>(own); });
}

Schema subdomainSchema() {
  Schema schema("Solver of a single subdomain.");
  schema.choice("Local Solver", "CHOLMOD", Registry<LocalSolver>::instance().schemas(), "Sparse direct solver of the subdomains.");
  return schema;
}

LocalSolverMaker localSolverMaker(const Parameters& subdomain) {
  // Every subdomain holds a copy of the maker; the list is shared.
  return [own = std::make_shared<const Parameters>(subdomain)] { return makeStrategy<LocalSolver>(*own, "Local Solver"); };
}

}  // namespace suture
