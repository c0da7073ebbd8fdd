#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/mesh/Mesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// Rigid-body motions that prescribed components and elastic supports leave free, for a connected part of a body (nearly always the whole
/// body).
///
/// A motion is given by amplitudes: translations along the axes, then rotations (one in 2D, three in 3D) measured by the displacement
/// that they cause at the distance `radius` from `centre`. All amplitudes are lengths, which makes them independent of units.
struct RigidPart {
  int body = -1;
  Point centre{0, 0, 0};
  double radius = 1.0;  ///< half the diagonal of the part's bounding box
  Matrix free;          ///< amplitudes x free motions, orthonormal columns; no column if the prescribed components hold the part
  Matrix soft{};        ///< likewise, motions that only elastic supports hold, orthogonal to the free ones; set by BodyParts

  /// Displacement at a point for unit amplitudes: dimension x amplitudes.
  Matrix at(const Point& point, int dimension) const;
  /// Displacement at a point for given amplitudes. [length]
  Point displacement(const Point& point, const Vector& amplitudes, int dimension) const;
};

struct RigidParts {
  std::vector<RigidPart> parts;
  std::vector<int> partOfNode;
};

/// Motion of a part in words: "move upwards (0, 1)", "turn about (3, 4), counterclockwise".
std::string inWords(const RigidPart& part, const Vector& amplitudes, int dimension);

/// Connected parts (through shared nodes) of the mesh and their free motions. A motion is held if it moves a prescribed direction by more
/// than 1e-10 of the motion (singular values of the prescribed rows). Bodies of revolution only move along their axis. Local.
/// \param bodiesAreConnected  each body is known to be one part: skips the search for connected parts
RigidParts freeRigidMotions(const Mesh& mesh, const Constraints& constraints, bool bodiesAreConnected = false);

}  // namespace suture
