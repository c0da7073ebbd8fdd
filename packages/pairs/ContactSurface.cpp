#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/pairs/ContactSurface.hpp>
#include <suture/pairs/FaceCheck.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <iterator>
#include <map>

namespace suture {

namespace {

/// Finds sides that meet the same body in several contacts: their pairs would be there twice. One side may meet different bodies, as a
/// base on which two blocks stand.
class Taken {
 public:
  /// \param partner  bodies of the other face, ascending; none: an obstacle
  void claim(const Mesh& mesh, const ContactFace& face, const std::vector<int>& partner, const std::string& path, Problems& problems) {
    std::string other;
    for (const Side& side : sidesOf(mesh.sideGroups, face.groups)) {
      std::vector<Claim>& claims = claimsOf_[{side.element, side.side}];
      for (const Claim& before : claims)
        if (meets(before.partner, partner)) other = before.path;
      claims.push_back({path, partner});
    }
    if (!other.empty())
      problems.add(path, face.name() + (face.groups.size() > 1 ? " lie" : " lies") + ", entirely or partly, also in " + other +
                             "; a side may meet a body, or an obstacle, in one contact only");
  }

 private:
  struct Claim {
    std::string path;
    std::vector<int> partner;
  };
  static bool meets(const std::vector<int>& a, const std::vector<int>& b) {
    if (a.empty() || b.empty()) return a.empty() == b.empty();
    std::vector<int> both;
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
    return !both.empty();
  }

  std::map<std::pair<int, int>, std::vector<Claim>> claimsOf_;  // by element and side
};

/// Checks that each face has groups, or that an obstacle replaces face B.
void checkGroups(const Contact& contact, const std::string& kind, Problems& problems) {
  const auto lacksName = [](const std::vector<std::string>& groups) { return std::count(groups.begin(), groups.end(), "") > 0; };
  const std::string pathA = contact.path + "/Side A", pathB = contact.path + "/Side B";
  const std::string several = ", or several as {left, right}";
  if (contact.groupsA.empty() || lacksName(contact.groupsA)) problems.add(pathA, "is empty; expected a " + kind + several);
  if (lacksName(contact.groupsB)) problems.add(pathB, "is empty; expected a " + kind + " on another body" + several);
  if (!contact.groupsB.empty() && contact.obstacle) problems.add(pathB, "found together with an Obstacle; expected only one of them");
  if (contact.groupsB.empty() && !contact.obstacle)
    problems.add(pathB, "is missing: expected a " + kind + " on another body, or an Obstacle");
}

/// How the two faces are coupled.
void readCoupling(const Parameters& list, Contact& contact) {
  const std::string coupling = list.get<std::string>("Coupling"), carrier = list.get<std::string>("Multipliers On");
  using Coupling = Contact::Coupling;
  using Carrier = Contact::Carrier;
  contact.coupling = coupling == "Mortar" ? Coupling::Mortar : coupling == "Matching Nodes" ? Coupling::MatchingNodes : Coupling::Automatic;
  using Geometry = Contact::Geometry;
  const std::string geometry = list.get<std::string>("Geometry");
  contact.geometry = geometry == "Smooth" ? Geometry::Smooth : geometry == "Facets" ? Geometry::Facets : Geometry::Automatic;
  if (list.get<std::string>("Multipliers") == "Linear") contact.multipliers = Contact::Multipliers::Linear;
  contact.carrier = carrier == "Side A" ? Carrier::SideA : carrier == "Side B" ? Carrier::SideB : Carrier::Automatic;
}

/// Sides of all groups that contacts name.
std::vector<Side> allSides(const Mesh& mesh, const std::vector<Contact>& contacts) {
  std::vector<Side> all;
  for (const Contact& contact : contacts)
    for (const std::vector<std::string>* groups : {&contact.groupsA, &contact.groupsB}) {
      const std::vector<Side> own = sidesOf(mesh.sideGroups, *groups);
      all.insert(all.end(), own.begin(), own.end());
    }
  return all;
}

/// A name that occurs in both lists, or nothing.
std::string inBoth(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const auto found = std::find_first_of(a.begin(), a.end(), b.begin(), b.end());
  return found == a.end() ? "" : *found;
}

Contact contactIn(const Parameters& list, const std::string& name, int dimension, const Constants& constants, Problems& problems) {
  Contact contact;
  contact.name = name;
  contact.path = pathOf(list);
  contact.obstacle = Obstacle::read(list, dimension, constants, problems);
  // A placeholder for an invalid obstacle, so that messages about the faces do not depend on it.
  if (list.get<std::string>("Obstacle") != "None" && !contact.obstacle) contact.obstacle = Obstacle(nullptr);
  contact.initialGap = readExpression(list, "Initial Gap", constants, problems);
  readCoupling(list, contact);
  if (list.get<std::string>("Direction") == "Side") contact.direction = Contact::Direction::Side;
  contact.tolerance = list.get<double>("Tolerance");
  contact.groupsA = groupNames(list, "Side A");
  contact.groupsB = groupNames(list, "Side B");
  return contact;
}

}  // namespace

std::string ContactFace::name() const { return quoted(groups); }

bool ContactFace::nodesCarryPressure() const {
  for (int side = 0; side < surface->sides() && surface->dimension() == 3; ++side)
    if (const std::size_t nodes = surface->nodesOf(side).size(); nodes == 6 || nodes == 8) return false;
  return true;
}

Contact Contact::between(const std::string& groupA, const std::string& groupB) {
  Contact contact;
  contact.name = groupA + " on " + groupB, contact.path = "Contact/" + contact.name;
  contact.groupsA = {groupA}, contact.groupsB = {groupB};
  return contact;
}

Contact Contact::with(const Obstacle& obstacle, const std::string& group) {
  Contact contact;
  contact.name = group, contact.path = "Contact/" + group;
  contact.groupsA = {group};
  contact.obstacle = obstacle;
  return contact;
}

std::vector<ContactSurface> contactsOn(const Mesh& mesh, const std::vector<Contact>& contacts, Problems& problems) {
  std::vector<ContactSurface> surfaces;
  if (contacts.empty()) return surfaces;
  const SideTable table(mesh, allSides(mesh, contacts));
  Taken taken;
  for (std::size_t number = 0; number < contacts.size(); ++number) {
    const std::size_t before = problems.list().size();
    ContactSurface surface{contacts[number], int(number), {}, {}};
    checkGroups(surface, mesh.sideGroupKind(), problems);
    const std::string pathA = surface.path + "/Side A", pathB = surface.path + "/Side B";
    surface.a = readFace(mesh, table, surface.groupsA, pathA, problems);
    surface.b = readFace(mesh, table, surface.groupsB, pathB, problems);
    const std::vector<int>& bodies = surface.a.bodies;
    if (const std::string both = inBoth(surface.groupsA, surface.groupsB); !both.empty()) {
      problems.add(pathB, "'" + both + "' is also Side A; expected the group on the other body");
    } else if (bodies.size() == 1 && bodies == surface.b.bodies) {
      problems.add(pathB, surface.b.name() + " is on the body '" + mesh.bodies[bodies[0]] + "', like Side A; a contact needs two bodies");
    } else {
      taken.claim(mesh, surface.a, surface.b.bodies, pathA, problems);
      taken.claim(mesh, surface.b, surface.a.bodies, pathB, problems);
    }
    if (problems.list().size() == before) surfaces.push_back(std::move(surface));
  }
  return surfaces;
}

std::vector<ContactSurface> readContact(const Mesh& mesh, const Parameters& contact, const Constants& constants, Problems& problems) {
  std::vector<Contact> given;
  std::vector<char> sound;
  for (const std::string& name : sublistNames(contact)) {
    const std::size_t before = problems.list().size();
    given.push_back(contactIn(contact.sublist(name), name, mesh.dimension, constants, problems));
    sound.push_back(problems.list().size() == before);
  }
  std::vector<ContactSurface> surfaces = contactsOn(mesh, given, problems);
  surfaces.erase(std::remove_if(surfaces.begin(), surfaces.end(), [&](const ContactSurface& s) { return !sound[std::size_t(s.number)]; }),
                 surfaces.end());
  return surfaces;
}

Schema contactSchema(const std::string& law, const std::map<std::string, Schema>& laws) {
  return Schema("one contact: two facing sides, or one side and a rigid obstacle")
      .texts("Side A", std::nullopt,
             "curve group (3D: surface group) of the mesh, or several as {left, right}, on one or several bodies; the normal points from "
             "here to Side B or into the obstacle")
      .orOne()
      .texts("Side B", std::nullopt, "curve group (3D: surface group) of the mesh, or several, on other bodies; none with an Obstacle")
      .orOne()
      .optional()
      .choice("Law", law, laws, "forces that the two sides may exert on each other")
      .choice("Obstacle", "None", Obstacle::choices(), "rigid obstacle for Side A instead of a second body")
      .oneOf("Direction", "Obstacle", {"Obstacle", "Side"},
             "with an Obstacle, normal along which contact acts and gaps are measured: that of the obstacle, or of Side A")
      .oneOf("Coupling", "Automatic", {"Automatic", "Matching Nodes", "Mortar"},
             "Matching Nodes: each node has one opposite node; Mortar: any two meshes, dual Lagrange multipliers; Automatic: Mortar where "
             "nodes do not match")
      .oneOf("Multipliers On", "Automatic", {"Automatic", "Side A", "Side B"},
             "with Mortar, the side whose nodes carry the contact stress; Automatic: the side that the other covers entirely, otherwise "
             "the one with more nodes; for two-node elements on a curve the coarser one")
      .oneOf("Multipliers", "Quadratic", {"Quadratic", "Linear"},
             "with Mortar, on second-order sides in 3D, interpolation of the contact stress. Quadratic: one value per node, by functions "
             "with positive integrals; Linear: one per vertex; all conditions are then coupled to each other, for small contacts")
      .oneOf("Geometry", "Automatic", {"Automatic", "Smooth", "Facets"},
             "with Mortar, curve or surface that represents a side of first-order elements whose nodes lie on a curved one. Automatic: the "
             "common shape of both sides when pressed together, with a curvature weighted by the bodies' stiffnesses; Smooth: the drawn "
             "shape, with the curvature through neighbouring nodes; Facets: the elements themselves")
      .text("Initial Gap", std::nullopt, "a function of x and y (3D: x, y and z) on Side A [length], instead of the distance in the mesh")
      .optional()
      .real("Tolerance", 1e-3, "largest tangential distance between the two nodes of a pair, as a fraction of the local mesh size",
            Range::positive());
}

}  // namespace suture
