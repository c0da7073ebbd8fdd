#pragma once
#include <suture/base/Errors.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/mesh/Mesh.hpp>

#include <string>
#include <utility>
#include <vector>

namespace suture {

/// Mean displacement of a group along an axis, which a condition prescribes: the sum of weight u(node)[component]. A unit force of the
/// condition acts on the nodes with the same weights: the force is a Lagrange multiplier, and its traction is uniform.
struct PrescribedMean {
  int load = -1;                              ///< index in ElasticModel::loads
  int component = 0;                          ///< axis
  std::vector<std::pair<int, double>> nodes;  ///< nodes with their weights, which sum to one
  double target = 0.0;                        ///< prescribed value [length]
};

/// The prescribed means of a scene. Local (rank 0). \param model  with resolved loads
std::vector<PrescribedMean> prescribedMeans(const Mesh& mesh, const ElasticModel& model);

/// Refuses means that are not free to take their values: other conditions prescribe all displacements in the mean, or several means depend
/// on each other. Either the values contradict each other, or the forces are undetermined. Local (rank 0).
/// \param problems  receives one entry for each such mean, with the conditions concerned and the values that they prescribe
void checkMeans(const Mesh& mesh, const Constraints& constraints, const ElasticModel& model, const std::vector<PrescribedMean>& means,
                Problems& problems);

}  // namespace suture
