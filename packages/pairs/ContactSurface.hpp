#pragma once
#include <suture/base/Errors.hpp>
#include <suture/base/Expression.hpp>
#include <suture/base/scene/Schema.hpp>
#include <suture/mesh/Mesh.hpp>
#include <suture/mesh/Surface.hpp>
#include <suture/pairs/Obstacle.hpp>
#include <suture/pairs/Overclosure.hpp>
#include <suture/pairs/mortar/MortarChoices.hpp>

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Angle between adjacent sides above which they form a corner: a ring of eight sides still counts as round.
constexpr double kSharpAngle = 45.001 * 3.14159265358979323846 / 180;

/// One of the two faces of a contact: part of the boundary of one or several bodies.
struct ContactFace {
  std::vector<std::string> groups;  ///< its side groups; none for a rigid obstacle
  std::optional<Surface> surface;
  std::vector<int> bodies;  ///< ascending
  double compliance = 0.0;  ///< mean over the elements along the face [1 / stress]; zero: rigid or unknown

  bool empty() const { return groups.empty(); }
  /// True if a uniform pressure exerts a force in its direction at every node. False for six- and eight-node sides in 3D: the shape
  /// functions of their vertices have zero and negative integrals.
  bool nodesCarryPressure() const;
  /// "'left' + 'right'", for messages.
  std::string name() const;
};

/// One contact as defined by an entry of the scene's list `Contact` or in C++.
struct Contact {
  std::string name;
  std::string path;                           ///< "Contact/fault above", for messages
  std::vector<std::string> groupsA, groupsB;  ///< side groups of the two faces; none for face B with an obstacle
  double tolerance = 1e-3;                    ///< tangential distance of partners, as a fraction of the local mesh size
  /// Largest distance along the normal, also of interference, of points that face each other [length]
  double reach = std::numeric_limits<double>::infinity();
  enum class Coupling { Automatic, MatchingNodes, Mortar } coupling = Coupling::Automatic;
  enum class Carrier { Automatic, SideA, SideB } carrier = Carrier::Automatic;  ///< face whose nodes carry the mortar pairs
  /// Functions of the mortar stress on second-order sides in 3D: one per node where the side is covered entirely, or one per vertex. With
  /// one per vertex the conditions cannot be eliminated one by one, because the nodal forces of a vertex function sum to zero. Linear is
  /// meant for small contacts and comparisons.
  enum class Multipliers { Quadratic, Linear } multipliers = Multipliers::Quadratic;
  /// Curves or surfaces between which the mortar gap is measured where elements are straight and the faces are curved.
  enum class Geometry { Automatic, Smooth, Facets } geometry = Geometry::Automatic;
  std::optional<Obstacle> obstacle;  ///< replaces face B
  /// Normal of the pairs with an obstacle, along which their gap is measured: the obstacle's normal at the foot of the node, or the face's
  /// normal.
  enum class Direction { Obstacle, Side } direction = Direction::Obstacle;
  std::optional<Expression> initialGap;    ///< replaces the gap of the geometry [length]
  std::optional<Overclosure> overclosure;  ///< softens the contact by springs on face A; nothing: hard contact
  int spring = 0;                          ///< spring of `overclosure` that this contact presses (withSprings())

  /// Stiffness and begin of that spring; only with an overclosure.
  const Overclosure::Spring& ownSpring() const { return overclosure->springs()[static_cast<std::size_t>(spring)]; }

  /// Contact between two faces.
  static Contact between(const std::string& groupA, const std::string& groupB);
  /// Contact of a face with a rigid obstacle.
  static Contact with(const Obstacle& obstacle, const std::string& group);
};

/// A contact on the mesh, whose faces have been checked individually and against the other contacts.
struct ContactSurface : Contact {
  int number = -1;   ///< place in the scene's list
  ContactFace a, b;  ///< b is empty for a rigid obstacle
  /// Choices of its mortar on other shapes of the faces, which are kept where possible and replaced; null: none. Owned by the caller.
  MortarChoices* choices = nullptr;

  double compliance() const { return a.compliance + b.compliance; }
  /// True if both faces lie on the same single body, as those of a crack. Otherwise a body that is on both faces does not touch itself.
  bool isWithinOneBody() const { return a.bodies.size() == 1 && a.bodies == b.bodies; }
  /// Number by which the samplings distinguish the bodies of the two faces. \param onA  face of the body
  int sideOfBody(int body, bool onA) const { return isWithinOneBody() && !onA ? -1 - body : body; }
  /// Fraction of the change of curvature that face A takes when both faces are pressed together, as for two half-planes. One half where
  /// compliances are not known.
  double shareOfA() const { return compliance() > 0 ? a.compliance / compliance() : 0.5; }
};

/// The contacts, each with its first spring, then those of further springs, in the order of contactLines(). Local.
std::vector<Contact> withSprings(std::vector<Contact> contacts);

/// Adds the coatings of softened contacts, with their outer nodes, to a mesh with bodies (assignBodies()). Without such contacts the mesh
/// is unchanged. Contacts on unknown groups are left out: contactsOn() reports them. Local (rank 0).
void addCoatings(Mesh& mesh, const std::vector<Contact>& contacts);
/// The same for the scene's list `Contact`. \throws InputError  invalid laws of overclosure
void addCoatings(Mesh& mesh, const Parameters& contact);
/// Inverse of addCoatings(). Local.
void removeCoatings(Mesh& mesh);

/// Schema of an entry of the scene's list `Contact`. \param law  default of its choice `Law` \param laws  choices of `Law`, by name: the
/// pairs do not depend on the law
Schema contactSchema(const std::string& law, const std::map<std::string, Schema>& laws);

/// Contacts on the mesh, without those that have a problem; those of further springs come last (withSprings()). Face A of a softened
/// contact consists of the outer nodes of its coating (addCoatings()). Local. \param problems  receives: an unknown or empty group; a face
/// inside the material, or with branches or sharp corners; the same group on both sides, or a single body on both; a side in two contacts;
/// first- and second-order sides in one face; a face B together with an obstacle, or neither
std::vector<ContactSurface> contactsOn(const Mesh& mesh, const std::vector<Contact>& contacts, Problems& problems);

/// Reads the list and leaves out entries with a problem. Local. \param problems  receives what contactsOn() finds, and invalid expressions
/// and obstacles
std::vector<ContactSurface> readContact(const Mesh& mesh, const Parameters& contact, const Constants& constants, Problems& problems);

}  // namespace suture
