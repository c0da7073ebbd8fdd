#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/quality/ElementForces.hpp>
#include <suture/quality/PairResult.hpp>
#include <suture/quality/Verification.hpp>

#include <functional>
#include <optional>
#include <vector>

namespace suture {

/// Sums at the nodes of a mesh, by whatever makes its forces.
struct OwnForces {
  ElementForces elements;  ///< those of elastic supports among them
  Vector load;             ///< node-major, Cartesian [force]
  Vector supports{};       ///< forces of elastic supports on the mesh, likewise; empty: none
  /// Part of the loads that initial strains and stresses add, which is no load: round the circle of a body of revolution it has a sum.
  /// [force]
  Point initial{0, 0, 0};
};

/// Answer of a run, as it is to be verified.
struct Answer {
  const std::vector<SubdomainMesh>& meshes;  ///< subdomains of this rank
  const ElasticModel& model;
  const std::vector<Vector>& displacement;  ///< displacements of each mesh, beside its lift: node-major, Cartesian [length]
  const std::vector<PairResult>& pairs;     ///< on rank 0, all; only their ids, states and forces are used
  const std::vector<ContactPiece>& pieces;  ///< on rank 0, for names in messages; may be empty
  double tolerance = 1e-8;                  ///< relative algebraic error that was asked for
  /// Forces of a mesh of this rank with physics of its own. Null, or nothing for a mesh: loops over elements, loads and elastic
  /// supports of the model.
  std::function<std::optional<OwnForces>(int mesh)> own{};
  std::vector<BodyForces> past{};  ///< largest on the path of load steps before, of each body; empty: none
  bool byMonolithic = false;       ///< which is then not what to try if the verdict does not hold
};

/// Judges an answer by loops over elements, conditions and pairs, with nothing that a solver made. See README.md for the quantities and
/// their bounds. The same on all ranks. Collective. \throws InputError  an element is folded
Verification verify(const Comm& comm, const Answer& answer);

}  // namespace suture
