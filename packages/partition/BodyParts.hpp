#pragma once
#include <suture/constraints/RigidMotion.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <vector>

namespace suture {

/// The connected parts of all bodies (subdomains that share nodes) and what prescribed displacements say of their rigid motions.
/// All ranks know all parts.
struct BodyParts {
  std::vector<RigidPart> parts;
  std::vector<Vector> lift;  ///< lift of each part: amplitudes of the motion that fits its prescribed values best; none along free motions
  std::vector<char> sprung;  ///< true of a part on elastic supports: no rigid motion but the free ones leaves its forces alone
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
