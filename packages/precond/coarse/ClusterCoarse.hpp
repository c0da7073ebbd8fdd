#pragma once
#include <suture/precond/coarse/ChebyshevInverse.hpp>
#include <suture/precond/coarse/ClusterProblem.hpp>
#include <suture/precond/coarse/CoarseOptions.hpp>

#include <memory>
#include <vector>

namespace suture {

/// The coarse problem of BDDC, itself solved by domain decomposition with the same strategies (multilevel BDDC: Mandel, Sousedik and
/// Dohrmann, 2008).
///
/// Local problems are gathered into clusters (CoarseClusters), each within one rank. Coarse unknowns inside a cluster are eliminated
/// exactly. On the unknowns between clusters, Chebyshev steps with BDDC of the clusters, with their own vertices and edges, approximate the
/// inverse of the Schur complement S. With K = L diag(K_II, S) L^T the answer is L^-T diag(K_II^-1, P) L^-1 r, where P represents the
/// steps: a fixed symmetric positive definite operator, with the spectrum of P S around one. The sizes of the factors depend on the size
/// and number of the clusters, not on the number of local problems. A rank stores only the coarse unknowns that its own local problems
/// name, and exchanges those between clusters of different ranks.
class ClusterCoarse : public CoarseSolve {
 public:
  /// \param locals  local problems over all ranks. Collective. \throws NumericalError
  ClusterCoarse(const CommPtr& comm, CoarseElements coarse, int locals, const CoarseOptions& levels);

  int size() const override { return size_; }
  const Vector& solve(const Vector& mine) const override;
  int clusters() const override { return count_; }
  std::string remark() const override;
  /// Chebyshev steps per application; 0 for a single cluster.
  int steps() const { return inverse_ ? inverse_->steps() : 0; }
  /// Largest eigenvalue of the clusters' preconditioned operator; 1 for a single cluster.
  double largest() const { return inverse_ ? inverse_->largest() : 1.0; }

 private:
  int size_, count_ = 0;
  double accuracy_;
  std::string further_;  // remark of the next level
  std::vector<std::shared_ptr<const ClusterProblem>> problems_;
  std::vector<std::vector<int>> interiors_;  // inner unknowns of each cluster, as places in the arguments of solve()
  std::vector<int> boundary_;                // unknowns of the space's overlap, also as such places
  std::shared_ptr<const InterfaceSpace> space_;
  std::unique_ptr<ChebyshevInverse> inverse_;
  mutable Vector answer_;  // answer of the last solve
  // Work space, so that solve() does not allocate.
  mutable Matrix overlap_;
  mutable std::vector<double> interior_, trace_;  // values of one cluster
  MultiVectorPtr right_, left_;
};

}  // namespace suture
