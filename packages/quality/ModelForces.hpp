#pragma once
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/quality/ElementForces.hpp>

namespace suture {

/// Sums at the nodes of a mesh, by whatever makes its forces.
struct OwnForces {
  ElementForces elements;  ///< those of elastic supports among them
  Vector load;             ///< node-major, Cartesian [force]
  /// Parts of the sums, for the balance of forces: those of elastic supports on the mesh, the sum of their magnitudes, and what initial
  /// strains and stresses add to the loads (round the circle of a body of revolution they have a sum) [force]
  Point supports{0, 0, 0};
  double supportMagnitudes = 0.0;
  Point initial{0, 0, 0};
};

/// Forces of a model's materials, loads and supports for given displacements, by loops over elements and sides. Local.
/// \param displacement  node-major, Cartesian. \throws InputError  an element is folded
OwnForces modelForces(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement);

}  // namespace suture
