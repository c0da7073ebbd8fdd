#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/mesh/Mesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// The rigid motions of a connected part of a body (nearly always the whole of it) that its prescribed components and elastic supports
/// leave free.
///
/// A motion is given by amplitudes: translations along the axes, then rotations (one in 2D, three in 3D) measured by the displacement
/// that they cause at the distance `radius` from `centre`. All amplitudes are lengths, so that nothing depends on units.
struct RigidPart {
  int body = -1;
  Point centre{0, 0, 0};
  double radius = 1.0;  ///< half the diagonal of the part's box
  Matrix free;          ///< amplitudes x free motions, orthonormal columns; no column where the prescribed components hold the part

  /// Displacement at a point for unit amplitudes: dimension x amplitudes.
  Matrix at(const Point& point, int dimension) const;
  /// Displacement at a point for given amplitudes. [length]
  Point displacement(const Point& point, const Vector& amplitudes, int dimension) const;
};

struct RigidParts {
  std::vector<RigidPart> parts;
  std::vector<int> partOfNode;
};

/// A motion of a part in words: "move upwards (0, 1)", "turn about (3, 4), counterclockwise".
std::string inWords(const RigidPart& part, const Vector& amplitudes, int dimension);

/// Connected parts (through shared nodes) of the mesh and their supports. A motion is held when a prescribed component's direction moves
/// by more than 1e-10 of it (singular values of the prescribed rows). Bodies of revolution move along their axis only. Local.
/// \param bodiesAreConnected  each body is known to be one part: it need not be found out
RigidParts freeRigidMotions(const Mesh& mesh, const Constraints& constraints, bool bodiesAreConnected = false);

}  // namespace suture
