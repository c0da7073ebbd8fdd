#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/interface/ContactBodies.hpp>
#include <suture/quality/PairResult.hpp>

#include <vector>

namespace suture {

// Which pairs hold bodies, which touch them, and which are closed by rounding alone: for NeutralMotions.cpp.

/// Pairs at a solution, known to all ranks.
struct PairsAtSolution {
  Vector force, gap, change;  ///< the larger of normal and tangential force; change of the gap, its magnitude
  ClosedSet closed;
};

/// From rank 0. Collective.
PairsAtSolution broadcastPairs(const Comm& comm, const std::vector<PairResult>& results, int count);

/// Magnitudes whose rounding appears in the forces on each part.
struct ForceScales {
  std::vector<double> loads;  ///< sum of their magnitudes
  std::vector<double> ways;   ///< force that the last digit of a way is worth: eps E |way|
};

/// \param displacement  by mesh. The ways of bodies are the rigid motions that were taken out; where none were, their displacements.
/// Collective.
ForceScales forceScales(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const ContactBodies& bodies,
                        const std::vector<Vector>& displacement);

/// Classes of the pairs at a solution.
struct PairClasses {
  ClosedSet carrying;  ///< with a force that holds its bodies
  ClosedSet touching;  ///< without a gap, not carrying
  ClosedSet idle;      ///< closed for the solver, without force
};

/// Local.
PairClasses classify(const ContactBodies& bodies, const PairsAtSolution& pairs, const ForceScales& scales);

}  // namespace suture
