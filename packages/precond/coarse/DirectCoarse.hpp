#pragma once
#include <suture/algebra/LocalSolver.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>
#include <suture/precond/coarse/CoarseSolve.hpp>

#include <memory>
#include <vector>

namespace suture {

/// A sparse symmetric positive definite system that is small beside the rest: assembled from all ranks' contributions and factored on a
/// chosen number of ranks, each of which answers for its share of the others. Few copies save memory and the work of factoring, many save
/// messages; the answer is the same. A solve sums the whole coarse vector over the ranks: one number
/// an unknown, where the factor has tens.
class DirectCoarse : public CoarseSolve {
 public:
  /// \param size      number of unknowns, the same on all ranks
  /// \param elements  matrices of this rank; those of all ranks are added up
  /// \param copies    ranks that hold a factor; 0: all
  /// \param dependent  the system may be singular, and consistent: its diagonal, scaled to one, is shifted by 1e-11, and iterative
  ///                   refinement takes the shift out again, but for the null space
  /// Collective. \throws NumericalError  not positive definite
  DirectCoarse(CommPtr comm, int size, std::vector<CoarseElement> elements, std::unique_ptr<LocalSolver> solver, int copies,
               bool dependent);

  int size() const override { return size_; }
  /// namesIn() of this rank's elements.
  const std::vector<int>& names() const { return names_; }
  const Vector& solve(const Vector& mine) const override;

 private:
  CommPtr comm_, share_;  // all ranks; those that one copy answers for, its holder first
  int size_, copies_;
  std::vector<int> names_;
  bool dependent_;
  std::unique_ptr<LocalSolver> solver_;
  SparseMatrix scaled_;  // kept for refinement only
  Vector scale_;
  mutable Vector answer_;
  mutable Vector mine_, sum_;  // work space, of all unknowns: the inner loop allocates nothing
  mutable Matrix load_, solution_, correction_;
};

/// Parameters `Coarse Solver` and `Coarse Copies` of a preconditioner's list.
void addCoarseParameters(Schema& schema);

}  // namespace suture
