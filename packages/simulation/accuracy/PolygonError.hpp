#pragma once
#include <suture/adapt/Chords.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Effect of straight sides in place of curved ones, on rank 0.
struct PolygonError {
  std::vector<ChordSide> sides;
  std::vector<double> squares;  ///< twice the change of the energy by each side [energy]

  /// Squared energy norm: the sum. [energy]
  double square() const;
};

/// Estimates the effect of straight sides by the derivative of the potential energy with respect to the shape of the bodies: material
/// between side and curve changes the energy by W - f.u per volume, W its strain energy and f the body force; a pressure adds div(p u), a
/// traction t -t.u per added length (3D: area) of the side and -t.(du/dn) per volume, likewise an elastic support. The changes of all sides
/// count with their magnitudes, so that those of opposite signs do not cancel. Strain energies are those at the centroids of the elements.
/// Collective. \param sides  of the mesh, on rank 0 \param elements  of the whole mesh, on rank 0
PolygonError polygonError(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                          const std::vector<Vector>& displacement, std::vector<ChordSide> sides, int elements);

}  // namespace suture
