#pragma once
#include <suture/answer/PairResult.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/interface/ContactBodies.hpp>

#include <vector>

namespace suture {

// Classification of pairs for NeutralMotions.cpp: those that hold bodies, touch them, or are closed by round-off alone.

/// Pairs at a solution, known to all ranks.
struct PairsAtSolution {
  Vector force, gap, change;  ///< the larger of normal and tangential force; gap; magnitude of the change of the gap
  ClosedSet closed;
};

/// Broadcasts the pairs of rank 0. Collective.
PairsAtSolution broadcastPairs(const Comm& comm, const std::vector<PairResult>& results, int count);

/// Magnitudes whose round-off appears in the forces on each part.
struct ForceScales {
  std::vector<double> loads;  ///< sum of their magnitudes
  std::vector<double> ways;   ///< force equivalent to the last digit of the displacement: eps E |displacement|
};

/// \param displacement  by mesh. Used for bodies from which no rigid motion was taken out.
/// Collective.
ForceScales forceScales(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const ContactBodies& bodies,
                        const std::vector<Vector>& displacement);

/// Classes of the pairs at a solution.
struct PairClasses {
  ClosedSet carrying;  ///< with a force that holds their bodies
  ClosedSet touching;  ///< without a gap, not carrying
  ClosedSet idle;      ///< closed in the solver, without force
};

/// Local.
PairClasses classify(const ContactBodies& bodies, const PairsAtSolution& pairs, const ForceScales& scales);

}  // namespace suture
