#pragma once
#include <suture/precond/PrimalConstraints.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace suture {

// Traces against which a nearly incompressible subdomain is as stiff as its bulk modulus. A pressure field p of a subdomain that does no
// work on inner displacements makes S_i >= v v^T of the order of lambda, v its work on the trace: the constant pressure (v is the flux
// through the whole boundary), and in quadrilaterals of constant pressure, on meshes that are structured, one of alternating sign (a chess
// board), whose v no flux tells of. The condition of BDDC grows like lambda unless the jumps that averaging leaves on a side, u_i - sum D_j
// u_j, are orthogonal to v on each entity; with weights that change along an edge that is more than no jump of the flux.

/// size() x k: V with V V^T <= S, and S - V V^T at most about kStiff times the stiffness against change of shape: eigenvectors, by subspace
/// iteration with S. No columns where a local problem knows no shear diagonal (Hint). Local.
Matrix stiffTraces(const LocalProblem& local);

/// Decorator of a choice: adds the rows that keep weighted jumps of each entity orthogonal to the stiff traces of all its sharers, as far
/// as they cost anything. In scenes without nearly incompressible bodies the choice stays as it is. Remembers the traces of local problems
/// that it was given last: they outlive changes of the contact set.
class StiffTraces : public PrimalConstraints {
 public:
  explicit StiffTraces(std::unique_ptr<PrimalConstraints> plain) : plain_(std::move(plain)) {}
  bool isAdaptive() const override { return plain_->isAdaptive(); }

 protected:
  PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;

 private:
  std::unique_ptr<PrimalConstraints> plain_;
  mutable LocalProblems locals_;
  mutable std::vector<Matrix> traces_;
};

}  // namespace suture
