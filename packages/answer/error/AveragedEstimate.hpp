#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// The largest energy in earlier load steps, by which the stresses of a scene that has been unloaded are recognised as errors of the
/// solver.
struct EarlierEnergy {
  double twice = 0.0;      ///< upper bound of twice the energy; 0: no earlier steps [force length]
  double tolerance = 0.0;  ///< relative tolerance of the solver, in the energy norm
};

/// A cheap estimate of the discretisation error in the energy norm: the elements' stresses minus their averages at the vertices of each
/// material, weighted by the elements' sizes (Zienkiewicz and Zhu, Int. J. Num. Meth. Eng. 24, 337-357, 1987). Solves nothing and exchanges
/// the averages at seams once. Less accurate than estimateError(), especially at boundaries, where the averages are one-sided; sufficient
/// to detect meshes that are too coarse.
///
/// Returns the error relative to the solution's energy norm [-]. Zero if the stresses are only round-off or errors of the solver. The
/// result is independent of partition and ranks up to round-off. Collective. \param displacement  of each mesh, node-major, Cartesian
/// \param earlier       largest energy in earlier load steps
double averagedEstimate(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                        const std::vector<Vector>& displacement, const EarlierEnergy& earlier = {});

}  // namespace suture
