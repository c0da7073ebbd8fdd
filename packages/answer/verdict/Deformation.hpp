#pragma once
#include <suture/base/Point.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Deviation of a body's nodes from its best-fit rigid motion (least squares over its nodes; for a body of revolution a translation along
/// the axis).
struct Deformation {
  double largest = 0.0;     ///< largest distance of a node from the rigid motion: the body's deformation scale [length]
  double moved = 0.0;       ///< largest component of a node's displacement, including the rigid motion [length]
  double extent = 0.0;      ///< largest distance of a node from the centre of the nodes [length]
  double turn = 0.0;        ///< rigid rotation [rad]
  Point rotation{0, 0, 0};  ///< the same as a vector along its axis [rad]
  double prescribed = 0.0;  ///< largest prescribed displacement of a node [length]
  Point centre{0, 0, 0};
};

/// Deformation of each body. Collective. \param displacement  of each mesh of this rank, node-major, Cartesian
std::vector<Deformation> deformations(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const std::vector<Vector>& displacement,
                                      int bodies);

/// Rotation of a body that moves its nodes a hundred times farther than any deformation or prescribed displacement of any body, and is
/// therefore not explained by them. Zero otherwise. [rad]
double unexplainedTurn(const std::vector<Deformation>& all, int body);

}  // namespace suture
