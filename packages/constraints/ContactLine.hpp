#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/Expression.hpp>
#include <suture/constraints/BoundaryLine.hpp>
#include <suture/constraints/Obstacle.hpp>
#include <suture/mesh/Mesh.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// One entry of the scene's list `Contact`, its sides checked each for itself and against the other lines.
struct ContactLine {
  int number = -1;  ///< place in the list
  std::string name;
  std::string path;            ///< "Contact/fault above"
  std::string groupA, groupB;  ///< B: empty for a rigid obstacle
  double tolerance = 1e-3;     ///< tangential distance of partners, as a fraction of the local mesh size
  int bodyA = -1, bodyB = -1;
  enum class Coupling { Automatic, MatchingNodes, Mortar } coupling = Coupling::Automatic;
  enum class Carrier { Automatic, SideA, SideB } carrier = Carrier::Automatic;  ///< side whose nodes carry a mortar's pairs
  /// Between which curves the gap of a mortar is taken, where elements are straight and the sides are not.
  enum class Geometry { Automatic, Smooth, Facets } geometry = Geometry::Automatic;
  double complianceA = 0, complianceB = 0;  ///< mean over the elements of each side [1 / stress]; zero: rigid, or not known
  std::optional<Obstacle> obstacle;         ///< instead of side B
  std::optional<Expression> initialGap;     ///< instead of that of the geometry [length]

  double compliance() const { return complianceA + complianceB; }
  /// Share of side A in the change of curvature by which both sides fit each other when pressed together, as of two half-planes. One half
  /// where compliances are not known.
  double shareOfA() const { return compliance() > 0 ? complianceA / compliance() : 0.5; }
};

/// Reads the list; a line with a problem is left out. Local.
/// \param problems  gets: an unknown or empty group; a side in two bodies, inside the material, or with branches or sharp corners; the same
///                  group or body on both sides; a side in two contacts; sides of two and of three nodes in one group; a side B
///                  beside an obstacle, or neither; a bad expression or obstacle
std::vector<ContactLine> readContact(const Mesh& mesh, const Parameters& contact, const Constants& constants, Problems& problems);

}  // namespace suture
