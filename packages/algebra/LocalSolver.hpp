#pragma once
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/base/Registry.hpp>
#include <suture/base/Types.hpp>

#include <memory>

namespace suture {

class SingleFactor;

/// Sparse direct solver for the symmetric positive definite matrices of one subdomain, group or coarse problem. Strategies: CHOLMOD,
/// Amesos2; users add their own through Registry<LocalSolver>. Local: never communicates.
class LocalSolver {
 public:
  static const char* kind() { return "local solver"; }
  virtual ~LocalSolver() = default;

  /// Factors a symmetric positive definite matrix, given with both triangles, and discards an earlier factor.
  /// \throws NumericalError  if the factorisation breaks down (the matrix is not positive definite, if the method detects it).
  void factorise(const SparseMatrix& matrix);

  /// x <- matrix^-1 x, for any number of right-hand sides (columns).
  void solve(LocalView x) const;

  /// The factor in single precision, for preconditioners; null if the method does not provide one.
  virtual std::unique_ptr<SingleFactor> inSinglePrecision() const;

  int size() const { return size_; }
  /// Right-hand sides solved so far.
  long long solves() const { return solves_; }

 protected:
  virtual void doFactorise(const SparseMatrix& matrix) = 0;
  virtual void doSolve(LocalView x) const = 0;

 private:
  int size_ = 0;
  mutable long long solves_ = 0;
};

void registerBuiltIns(Registry<LocalSolver>& registry);

/// Makes new local solvers of the kind that the scene requests.
using LocalSolverMaker = std::function<std::unique_ptr<LocalSolver>()>;

/// Schema of the scene's list `Subdomain`, and the maker that such a list describes.
Schema subdomainSchema();
LocalSolverMaker localSolverMaker(const Parameters& subdomain);

}  // namespace suture
