#pragma once
#include <suture/algebra/LocalSolver.hpp>

#include <memory>

namespace suture {

/// A direct solver of Amesos2 (KLU2) on a single-rank communicator: KLU2 silently gave wrong results for matrices distributed over several
/// ranks, so the matrix is never distributed (doc/numerics.md; a regression test checks the results).
class AmesosSolver : public LocalSolver {
 public:
  static Schema schema();
  explicit AmesosSolver(const Parameters& own);
  ~AmesosSolver() override;

 protected:
  void doFactorise(const SparseMatrix& matrix) override;
  void doSolve(LocalView x) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace suture
