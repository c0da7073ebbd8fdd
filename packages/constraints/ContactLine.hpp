#pragma once
#include <suture/base/Errors.hpp>
#include <suture/constraints/BoundaryLine.hpp>
#include <suture/mesh/Mesh.hpp>

#include <string>
#include <vector>

namespace suture {

/// One entry of the scene's list `Contact`, its sides checked each for itself and against the other lines.
struct ContactLine {
  int number = -1;  ///< place in the list
  std::string name;
  std::string path;  ///< "Contact/fault above"
  std::string groupA, groupB;
  double tolerance = 1e-3;  ///< tangential distance of partners, as a fraction of the local mesh size
  int bodyA = -1, bodyB = -1;
};

/// Reads the list; a line with a problem is left out. Local.
/// \param problems  gets: an unknown or empty group; a side in two bodies, inside the material, or with branches or sharp corners; the same
///                  group or body on both sides; a side in two contacts
std::vector<ContactLine> readContact(const Mesh& mesh, const Parameters& contact, Problems& problems);

}  // namespace suture
