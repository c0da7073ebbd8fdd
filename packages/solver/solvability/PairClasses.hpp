#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/interface/ContactBodies.hpp>
#include <suture/quality/PairResult.hpp>

#include <vector>

namespace suture {

// Which pairs hold bodies, which touch them, and which are closed by rounding alone: for NeutralMotions.cpp.

/// What all ranks know of the pairs.
struct PairsAtSolution {
  Vector force, gap, change;  ///< change of the gap, its magnitude
  ClosedSet closed;
};

/// From rank 0. Collective.
PairsAtSolution broadcastPairs(const Comm& comm, const std::vector<PairResult>& results, int count);

/// What forces on each part are rounding of.
struct ForceScales {
  std::vector<double> loads;  ///< sum of their magnitudes
  std::vector<double> ways;   ///< what the last digit of a prescribed way is worth: eps E |way|
};

/// Collective.
ForceScales forceScales(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const ContactBodies& bodies);

/// What pairs are at a solution.
struct PairClasses {
  ClosedSet carrying;  ///< with a force that holds its bodies
  ClosedSet touching;  ///< without a gap, not carrying
  ClosedSet idle;      ///< closed for the solver, without force
};

/// Local.
PairClasses classify(const ContactBodies& bodies, const PairsAtSolution& pairs, const ForceScales& scales);

}  // namespace suture
