#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/answer/verdict/Verification.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementForces.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace suture {

/// Sums at the nodes of a mesh, from whichever object computes its forces.
struct OwnForces {
  ElementForces elements;  ///< including elastic supports
  Vector load;             ///< node-major, Cartesian [force]
  Vector supports{};       ///< forces of elastic supports on the mesh, likewise; empty: none
  /// Contribution of initial strains and stresses to the loads, which does not count as a load: around the circle of a body of revolution
  /// its sum is not zero. [force]
  Point initial{0, 0, 0};
};

/// Solution of a run to be verified.
struct Answer {
  const std::vector<SubdomainMesh>& meshes;  ///< subdomains of this rank
  const ElasticModel& model;
  const std::vector<Vector>& displacement;  ///< displacements of each mesh, without its lift: node-major, Cartesian [length]
  const std::vector<PairResult>& pairs;     ///< on rank 0, all; only their ids, states and forces are used
  const std::vector<ContactPiece>& pieces;  ///< on rank 0, for names in messages; may be empty
  double tolerance = 1e-8;                  ///< requested relative algebraic error
  /// Forces of a mesh of this rank with its own physics. Null, or no value for a mesh: loops over elements, loads and elastic supports of
  /// the model.
  std::function<std::optional<OwnForces>(int mesh)> own{};
  std::vector<BodyForces> past{};  ///< largest forces on each body on the previous path of load steps; empty: none
  bool byMonolithic = false;       ///< the solution is Monolithic's, which is then not recommended if the verdict fails
  bool converged = true;           ///< if not, a failing verdict is the consequence: it recommends no other settings of the solver
};

/// Verifies a solution by loops over elements, conditions and pairs, without any object of the solver. README.md describes the quantities
/// and their bounds. The same on all ranks. Collective. \throws InputError  if an element is folded
Verification verify(const Comm& comm, const Answer& answer);

}  // namespace suture
