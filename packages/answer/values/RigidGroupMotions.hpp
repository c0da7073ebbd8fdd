#pragma once
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Motion of a rigid group at a solution.
struct RigidGroupMotion {
  int condition = -1;           ///< index in Constraints::conditions
  Point point{0, 0, 0};         ///< reference point
  Point displacement{0, 0, 0};  ///< displacement of that point [length]
  Point rotation{0, 0, 0};      ///< rotation about the axes; in 2D only the third component [radians]
};

/// Motions of all rigid groups, by condition: the rigid motion that fits the displacements of their nodes (least squares; nodes on a line
/// do not determine the rotation about it: the smallest is given). Collective; on rank 0, empty on other ranks. \param displacement  of
/// each mesh, without its lift: node-major, Cartesian
std::vector<RigidGroupMotion> rigidGroupMotions(const Comm& comm, const std::vector<SubdomainMesh>& meshes,
                                                const std::vector<Vector>& displacement);

}  // namespace suture
