#pragma once
#include <suture/algebra/LocalSolver.hpp>

#include <memory>

namespace suture {

class CholmodFactor;

/// Sparse Cholesky factorisation of CHOLMOD.
class CholmodSolver : public LocalSolver {
 public:
  static Schema schema();
  explicit CholmodSolver(const Parameters& own);
  ~CholmodSolver() override;
  std::unique_ptr<SingleFactor> inSinglePrecision() const override;

 protected:
  void doFactorise(const SparseMatrix& matrix) override;
  void doSolve(LocalView x) const override;

 private:
  std::string ordering_;
  std::unique_ptr<CholmodFactor> factor_;
};

}  // namespace suture
