#pragma once
#include <suture/algebra/LocalSolver.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>
#include <suture/precond/coarse/CoarseSolve.hpp>

#include <memory>
#include <vector>

namespace suture {

/// A sparse symmetric positive definite system, small compared with the other work: assembled from the contributions of all ranks and
/// factored on a given number of ranks, each of which solves for its share of the ranks. Few copies save memory and factorisation work,
/// many save messages; the answer is the same. A solve sums the whole coarse vector over the ranks: one number per unknown, compared with
/// tens in the factor.
class DirectCoarse : public CoarseSolve {
 public:
  /// \param size      number of unknowns, the same on all ranks
  /// \param elements  matrices of this rank; those of all ranks are added up
  /// \param copies    ranks that hold a factor; 0: all
  /// \param dependent  the system may be singular but consistent: its diagonal, scaled to one, is shifted by 1e-11, and iterative
  ///                   refinement removes the effect of the shift, except in the null space
  /// Collective. \throws NumericalError  if not positive definite
  DirectCoarse(CommPtr comm, int size, std::vector<CoarseElement> elements, std::unique_ptr<LocalSolver> solver, int copies,
               bool dependent);

  int size() const override { return size_; }
  /// namesIn() of this rank's elements.
  const std::vector<int>& names() const { return names_; }
  const Vector& solve(const Vector& mine) const override;

 private:
  CommPtr comm_, share_;  // all ranks; the ranks served by one copy, its holder first
  int size_, copies_;
  std::vector<int> names_;
  bool dependent_;
  std::unique_ptr<LocalSolver> solver_;
  SparseMatrix scaled_;  // only for refinement
  Vector scale_;
  mutable Vector answer_;
  mutable Vector mine_, sum_;  // work space for all unknowns, so that solve() does not allocate
  mutable Matrix load_, solution_, correction_;
};

/// Parameters `Coarse Solver` and `Coarse Copies` of a preconditioner's list.
void addCoarseParameters(Schema& schema);

}  // namespace suture
