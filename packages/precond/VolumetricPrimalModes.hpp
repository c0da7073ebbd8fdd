#pragma once
#include <suture/precond/PrimalConstraints.hpp>

#include <memory>
#include <utility>
#include <vector>

namespace suture {

// Traces against which a nearly incompressible subdomain is as stiff as its bulk modulus. For a pressure field p of a subdomain that does
// no work on inner displacements, S_i >= v v^T of the order of lambda, with v the work of p on the trace. One such field is the constant
// pressure; its v is the flux through the whole boundary. Quadrilaterals of constant pressure on structured meshes have another one of
// alternating sign (a checkerboard), whose v is not visible in any flux. The condition number of BDDC grows like lambda unless the jumps
// that averaging leaves on a side, u_i - sum D_j u_j, are orthogonal to v on each entity; if weights vary along an edge, this requires more
// than a continuous flux.

/// V, size() x k, with V V^T <= S, and S - V V^T at most about kStiff times the stiffness against change of shape: eigenvectors, by
/// subspace iteration with S. No columns if the local problem has no shear diagonal (Hint). Local.
Matrix stiffTraces(const LocalProblem& local);

/// Decorator of a choice: adds rows that keep the weighted jumps of each entity orthogonal to the stiff traces of all its sharers, unless
/// the gain is negligible. Without nearly incompressible bodies the choice is unchanged. The traces of the last local problems are cached,
/// as they outlive changes of the contact set.
class VolumetricPrimalModes : public PrimalConstraints {
 public:
  explicit VolumetricPrimalModes(std::unique_ptr<PrimalConstraints> plain) : plain_(std::move(plain)) {}
  bool isAdaptive() const override { return plain_->isAdaptive(); }

 protected:
  PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override;

 private:
  std::unique_ptr<PrimalConstraints> plain_;
  mutable LocalProblems locals_;
  mutable std::vector<Matrix> traces_;
};

}  // namespace suture
