#pragma once
#include <suture/motion/RigidMotion.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// Connected parts of all bodies (subdomains that share nodes) and the constraints of prescribed displacements on their rigid-body motions.
/// All ranks know all parts.
struct BodyParts {
  std::vector<RigidPart> parts;
  std::vector<Vector> lift;  ///< lift of each part: amplitudes of the motion that best fits its prescribed values; zero along free motions
  std::vector<char> sprung;  ///< true for a part on elastic supports: rigid motions other than the free ones change its forces
  std::vector<int> partOf;   ///< part of each mesh of this rank

  /// \param meshes  of this rank. Collective.
  BodyParts(const Comm& comm, const std::vector<const SubdomainMesh*>& meshes, int dimension);

 private:
  void findParts(const Comm& comm, const std::vector<const SubdomainMesh*>& meshes, int dimension);
  void findMotions(const Comm& comm, const std::vector<const SubdomainMesh*>& meshes, int dimension);
};

/// Components of a part's motions along a unit vector at a point.
Vector along(const RigidPart& part, const Point& point, const Point& direction, int dimension);

}  // namespace suture
