#pragma once
#include <suture/precond/Weighting.hpp>

#include <vector>

namespace suture {

// Traces against which a nearly incompressible subdomain is as stiff as its bulk modulus. A pressure field p of a subdomain that does no
// work on inner displacements makes S_i >= v v^T of the order of lambda, v its work on the trace: the constant pressure (v is the flux
// through the whole boundary), and in quadrilaterals of constant pressure, on meshes that are structured, one of alternating sign (a chess
// board), whose v no flux tells of. The condition of BDDC grows like lambda unless the jumps that averaging leaves on a side, D_j (u_i -
// u_j), are orthogonal to v on each edge; with weights that change along an edge that is more than no jump of the flux.

/// size() x k: V with V V^T <= S, and S - V V^T at most about kStiff times the stiffness against change of shape: eigenvectors, by subspace
/// iteration with S. No columns where a local problem knows no shearDiagonal(). Local.
Matrix stiffTraces(const LocalProblem& local);

/// The same for edges. Remembers the traces of local problems that it was given last: they outlive changes of the contact set.
class StiffTraces {
 public:
  /// `rows` of each edge (orthonormal, see EdgeConstraints::rows) and those that keep weighted jumps orthogonal to the stiff traces of both
  /// sides, as far as they cost anything; `rows` in scenes without nearly incompressible bodies. Collective.
  std::vector<Matrix> addedTo(std::vector<Matrix> rows, const InterfaceSpace& space, const LocalProblems& locals,
                              const Weighting& weighting);

 private:
  LocalProblems locals_;
  std::vector<Matrix> traces_;
};

}  // namespace suture
