#pragma once
#include <suture/base/Point.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// How far a body's nodes move beside its best rigid motion (least squares over its nodes; of a body of revolution a shift along the axis).
struct Deformation {
  double largest = 0.0;     ///< distance of a node from the rigid motion: the body's deformation scale [length]
  double moved = 0.0;       ///< largest component of a node's displacement, the rigid motion included [length]
  double extent = 0.0;      ///< largest distance of a node from the centre of the nodes [length]
  double turn = 0.0;        ///< rigid rotation [rad]
  Point rotation{0, 0, 0};  ///< the same, about its axis [rad]
  double prescribed = 0.0;  ///< largest displacement that is prescribed at a node [length]
  Point centre{0, 0, 0};
};

/// Deformation of each body. Collective. \param displacement  of each mesh of this rank, node-major, Cartesian
std::vector<Deformation> deformations(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement,
                                      int bodies);

/// Rotation of a body that neither the deformation nor a prescribed displacement of any body explains: it moves its nodes a hundred times
/// farther. Zero in any other case. [rad]
double unexplainedTurn(const std::vector<Deformation>& all, int body);

}  // namespace suture
