#pragma once
#include <suture/answer/Balancing.hpp>
#include <suture/answer/PairResult.hpp>
#include <suture/base/Types.hpp>
#include <suture/constraints/BoundaryParts.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Upper bound of the error of a displacement field in the energy norm, without any unknown constant. Energy norms: sqrt(a(v, v)),
/// [(force length)^(1/2)].
struct ErrorBound {
  double total = 0.0;           ///< bound of |u - u_h|, u the exact displacement
  double discretisation = 0.0;  ///< part of the mesh
  double algebraic = 0.0;       ///< part of the solver: energy norm of the correction that balances the forces of the elements
  double oscillation = 0.0;     ///< estimated effect of loads that are not polynomials of the elements' order
  double solutionNorm = 0.0;    ///< energy norm of u_h
  double energyLower = 0.0, energyUpper = 0.0;  ///< the potential energy of the exact solution is between them [energy]
  bool strict = false;                          ///< true: proved for this scene on the polygon (polyhedron) of the mesh
  std::vector<std::string> reasons;             ///< why it is an estimate only; empty if strict
  std::vector<Vector> ofElements;               ///< contribution of each element of each mesh of this rank; their squares sum to total^2
  double imbalance = 0.0;                       ///< largest resultant of an element's data, relative to the largest force [-]
  bool exists = false;                          ///< false: nothing could be computed, see `reasons`

  double relative() const { return solutionNorm > 0.0 ? total / solutionNorm : 0.0; }
};

/// Solution whose error is to be bounded.
struct BoundedSolution {
  const std::vector<SubdomainMesh>& meshes;
  const ElasticModel& model;
  const std::vector<Vector>& displacement;    ///< displacement of each mesh of this rank, node-major, Cartesian [length]
  const std::optional<Balancing>& balancing;  ///< correction by the solver; none: the forces of its elements are taken as they are
  const std::vector<PairResult>& pairs;       ///< on rank 0, all
  const BoundaryParts& parts;                 ///< on rank 0
  double energy = 0.0;                        ///< potential energy of the solution [energy]
  std::vector<std::string> reasons{};         ///< known reasons against a strict bound, on rank 0
  std::string notBalanced{};                  ///< why `balancing` is missing
};

/// Bounds the error by statically admissible stresses tau (Prager and Synge, Quart. Appl. Math. 5, 1947): with a contact pressure p >= 0
/// that acts on both sides, and a displacement w that lifts u_h out of penetration,
///     |u - u_h|^2 <= |tau - C eps(u_h)|^2 + |w|^2 + 2 integral of p (gap of u_h + w).
/// The first norm is that of the complementary energy. Penetration enters with the exact pressure q and stress sigma: the integral of
/// (q - p) (jump of w) is at most |sigma - tau| |w|, and |sigma - tau|^2 - 2 |sigma - tau| |w| >= -|w|^2. Tractions between elements follow
/// from the nodal forces of the elements, vertex by vertex (Ladeveze and Leguillon, SIAM J. Num. Anal. 20, 1983); stresses in the elements
/// are those of StressElement; conjugate gradients over the stars of the vertices improve them.
///
/// With friction, s the slip of u_h in the load step, t the friction stress in tau, and g its bound, |t| <= g,
///     2 integral of (g |s| - t . s)
/// is added, and u minimises its potential energy plus the integral of g |s|: with Tresca friction of a constant bound on sides that all
/// touch, the solution of the scene; otherwise that for given g, and the bound is an estimate. On elastic supports of stiffness k, and
/// springs of softened contacts, the integral of |traction of tau + k u_h|^2 / k is added, and energies include theirs.
///
/// Collective. \param laws  of the contacts, from which constant bounds of Tresca friction follow
/// \param sweeps  least number of iterations
ErrorBound errorBound(const Comm& comm, const BoundedSolution& solution, const ContactLaws& laws, int sweeps = 2);

}  // namespace suture
