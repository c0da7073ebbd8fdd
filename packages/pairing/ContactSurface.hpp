#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/Expression.hpp>
#include <suture/base/scene/Schema.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/pairing/Obstacle.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Sides that meet at a larger angle make a corner: a ring of eight sides is still round.
constexpr double kSharpAngle = 45.001 * 3.14159265358979323846 / 180;

/// One of the two faces of a contact: a part of the boundary of one or several bodies.
struct ContactFace {
  std::vector<std::string> groups;  ///< side groups that it is made of; none for a rigid obstacle
  std::optional<Surface> surface;
  std::vector<int> bodies;  ///< ascending
  double compliance = 0.0;  ///< mean over the elements along it [1 / stress]; zero: rigid, or not known

  bool empty() const { return groups.empty(); }
  /// True if a uniform pressure has a force at each of its nodes, in the sense of the pressure. Not so at the vertices of six- and
  /// eight-node sides in space: the integrals of their shape functions are zero and negative.
  bool nodesCarryPressure() const;
  /// "'left' + 'right'", for messages.
  std::string name() const;
};

/// One contact as the scene gives it: an entry of its list `Contact`, or made in C++.
struct Contact {
  std::string name;
  std::string path;                           ///< "Contact/fault above", for messages
  std::vector<std::string> groupsA, groupsB;  ///< side groups of the two faces; of face B none with an obstacle
  double tolerance = 1e-3;                    ///< tangential distance of partners, as a fraction of the local mesh size
  enum class Coupling { Automatic, MatchingNodes, Mortar } coupling = Coupling::Automatic;
  enum class Carrier { Automatic, SideA, SideB } carrier = Carrier::Automatic;  ///< face whose nodes carry a mortar's pairs
  /// Functions of a mortar's stress on second-order sides in space: one a node where the side is covered wholly, or one a vertex. Those of
  /// the vertices alone leave no unknown that each condition could be solved for by itself: the displacements of the vertices have forces
  /// that add up to none. For small contacts and comparisons.
  enum class Multipliers { Quadratic, Linear } multipliers = Multipliers::Quadratic;
  /// Between which curves or surfaces the gap of a mortar is taken, where elements are straight and the faces are not.
  enum class Geometry { Automatic, Smooth, Facets } geometry = Geometry::Automatic;
  std::optional<Obstacle> obstacle;  ///< instead of face b
  /// Normal of the pairs with an obstacle, along which their gap is measured: the obstacle's at the foot of the node, or that of the face.
  enum class Direction { Obstacle, Side } direction = Direction::Obstacle;
  std::optional<Expression> initialGap;  ///< instead of that of the geometry [length]

  /// Two faces that may touch.
  static Contact between(const std::string& groupA, const std::string& groupB);
  /// A face before a rigid obstacle.
  static Contact with(const Obstacle& obstacle, const std::string& group);
};

/// A contact on the mesh, its faces checked each for itself and against the other contacts.
struct ContactSurface : Contact {
  int number = -1;   ///< place in the scene's list
  ContactFace a, b;  ///< b is empty for a rigid obstacle

  double compliance() const { return a.compliance + b.compliance; }
  /// Share of face a in the change of curvature by which both faces fit each other when pressed together, as of two half-planes. One half
  /// where compliances are not known.
  double shareOfA() const { return compliance() > 0 ? a.compliance / compliance() : 0.5; }
};

/// Schema of an entry of the scene's list `Contact`. \param law  default of its choice `Law` \param laws  choices of `Law`, by name: pairs
/// are made alike for all of them
Schema contactSchema(const std::string& law, const std::map<std::string, Schema>& laws);

/// Contacts on the mesh; one with a problem is left out. Local.
/// \param problems  gets: an unknown or empty group; a face inside the material, or with branches or sharp corners; the same group on both
///                  sides, or one body alone on both; a side in two contacts; sides of first and of second order in one face; a face B
///                  beside an obstacle, or neither
std::vector<ContactSurface> contactsOn(const Mesh& mesh, const std::vector<Contact>& contacts, Problems& problems);

/// Reads the list; an entry with a problem is left out. Local. \param problems  gets what contactsOn() finds, and bad expressions and
/// obstacles
std::vector<ContactSurface> readContact(const Mesh& mesh, const Parameters& contact, const Constants& constants, Problems& problems);

}  // namespace suture
