#pragma once
#include <suture/precond/coarse/ChebyshevInverse.hpp>
#include <suture/precond/coarse/ClusterProblem.hpp>
#include <suture/precond/coarse/CoarseOptions.hpp>

#include <memory>
#include <vector>

namespace suture {

/// The coarse problem of BDDC solved by domain decomposition once more (multilevel BDDC: Mandel, Sousedik and Dohrmann, 2008), with the
/// same strategies.
///
/// Local problems are gathered into clusters (CoarseClusters), each of one rank's. Coarse unknowns inside a cluster are eliminated exactly;
/// on those between clusters some Chebyshev steps with BDDC of the clusters, vertices and edges in their turn, come near to the inverse of
/// the Schur complement. With  K = L diag(K_II, S) L^T  the answer is  L^-T diag(K_II^-1, P) L^-1 r,  P the steps: a fixed symmetric
/// positive definite operator, with the spectrum of P S about one. Nothing is factored that grows with the number of local problems, but
/// by the size of clusters and their number. A rank knows the coarse unknowns that its own local problems name, and messages carry those
/// between clusters of different ranks.
class ClusterCoarse : public CoarseSolve {
 public:
  /// \param locals  local problems over all ranks. Collective. \throws NumericalError
  ClusterCoarse(const CommPtr& comm, CoarseElements coarse, int locals, const CoarseOptions& levels);

  int size() const override { return size_; }
  const Vector& solve(const Vector& mine) const override;
  int clusters() const override { return count_; }
  /// Chebyshev steps an application; 0 where one cluster has it all.
  int steps() const { return inverse_ ? inverse_->steps() : 0; }
  /// Largest eigenvalue of the clusters' preconditioned operator, 1 where one cluster has it all.
  double largest() const { return inverse_ ? inverse_->largest() : 1.0; }

 private:
  int size_, count_ = 0;
  std::vector<std::shared_ptr<const ClusterProblem>> problems_;
  std::vector<std::vector<int>> interiors_;  // inner unknowns of each cluster, as places in the arguments of solve()
  std::vector<int> boundary_;                // unknowns of the space's overlap, in the same way
  std::shared_ptr<const InterfaceSpace> space_;
  std::unique_ptr<ChebyshevInverse> inverse_;
  mutable Vector answer_;  // answer of the last solve
  // Work space of solve(), which every iteration calls: it allocates nothing.
  mutable Matrix overlap_;
  mutable std::vector<double> interior_, trace_;  // values of one cluster
  MultiVectorPtr right_, left_;
};

}  // namespace suture
