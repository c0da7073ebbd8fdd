#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/pairs/ContactSurface.hpp>
#include <suture/pairs/FaceCheck.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace suture {

namespace {

/// Finds sides that meet the same side of another body in several contacts, or the same obstacle: their pairs would be there twice. One
/// side may be in several contacts otherwise, as a pin in two holes.
class Taken {
 public:
  void claim(const Mesh& mesh, const ContactSurface& contact, Problems& problems) {
    const std::vector<Key> a = keysOf(mesh, contact.a), b = keysOf(mesh, contact.b);
    std::string other = contact.obstacle && contact.obstacle->isSound() ? meetsObstacle(mesh, a, contact) : "";
    if (other.empty()) other = take(a, b, contact.path);
    if (other.empty()) return;
    const bool several = contact.a.groups.size() > 1;
    const std::string partner = contact.obstacle ? "this obstacle" : "sides of " + contact.b.name();
    problems.add(contact.path + "/Side A", contact.a.name() + (several ? " meet, entirely or partly, " : " meets, entirely or partly, ") +
                                               partner + " also in " + other + "; two sides may meet in one contact only");
  }

 private:
  using Key = std::pair<int, int>;  // element and side

  static std::vector<Key> keysOf(const Mesh& mesh, const ContactFace& face) {
    std::vector<Key> keys;
    for (const Side& side : sidesOf(mesh.sideGroups, face.groups)) keys.emplace_back(side.element, side.side);
    return keys;
  }

  /// Path of an earlier contact in which sides of both lists are on opposite faces; empty: none.
  std::string take(const std::vector<Key>& a, const std::vector<Key>& b, const std::string& path) {
    std::map<std::size_t, std::array<bool, 2>> met;  // earlier contact -> a is on its face A, on its face B
    for (const Key& key : a)
      for (const Claim& claim : claimsOf_[key]) met[claim.contact][claim.onB ? 1 : 0] = true;
    std::string other;
    for (const Key& key : b)
      for (const Claim& claim : claimsOf_[key])
        if (const auto found = met.find(claim.contact); found != met.end() && found->second[claim.onB ? 0 : 1])
          other = paths_[claim.contact];
    const std::size_t contact = paths_.size();
    paths_.push_back(path);
    for (const Key& key : a) claimsOf_[key].push_back({contact, false});
    for (const Key& key : b) claimsOf_[key].push_back({contact, true});
    return other;
  }

  std::string meetsObstacle(const Mesh& mesh, const std::vector<Key>& a, const ContactSurface& contact) {
    std::string other;
    for (const Key& key : a) {
      std::vector<Facing>& before = obstaclesOf_[key];
      for (const Facing& claim : before)
        if (areEqual(mesh, key, claim.obstacle, *contact.obstacle)) other = claim.path;
      before.push_back({*contact.obstacle, contact.path});
    }
    return other;
  }

  /// True if two obstacles have the same surface opposite all nodes of a side.
  static bool areEqual(const Mesh& mesh, const Key& key, const Obstacle& a, const Obstacle& b) {
    for (const int node : mesh.nodesOf({key.first, key.second})) {
      const Obstacle::Foot one = a.from(mesh.point(node)), other = b.from(mesh.point(node));
      if (one.gap != other.gap || one.normal != other.normal) return false;
    }
    return true;
  }

  struct Claim {
    std::size_t contact;
    bool onB;
  };
  std::vector<std::string> paths_;  // by contact
  std::map<Key, std::vector<Claim>> claimsOf_;
  struct Facing {
    Obstacle obstacle;
    std::string path;
  };
  std::map<Key, std::vector<Facing>> obstaclesOf_;
};

/// Checks that each face has groups, or that an obstacle replaces face B.
void checkGroups(const Contact& contact, const std::string& kind, Problems& problems) {
  const auto lacksName = [](const std::vector<std::string>& groups) { return std::count(groups.begin(), groups.end(), "") > 0; };
  const std::string pathA = contact.path + "/Side A", pathB = contact.path + "/Side B";
  const std::string several = ", or several as {left, right}";
  if (contact.groupsA.empty() || lacksName(contact.groupsA)) problems.add(pathA, "is empty; expected a " + kind + several);
  if (lacksName(contact.groupsB)) problems.add(pathB, "is empty; expected a " + kind + " opposite Side A" + several);
  if (!contact.groupsB.empty() && contact.obstacle) problems.add(pathB, "found together with an Obstacle; expected only one of them");
  if (contact.groupsB.empty() && !contact.obstacle)
    problems.add(pathB, "is missing: expected a " + kind + " opposite Side A, or an Obstacle");
}

/// How the two faces are coupled.
void readCoupling(const Parameters& list, Contact& contact) {
  const std::string coupling = list.get<std::string>("Coupling"), carrier = list.get<std::string>("Multipliers On");
  using Coupling = Contact::Coupling;
  using Carrier = Contact::Carrier;
  contact.coupling = coupling == "Mortar" ? Coupling::Mortar : coupling == "Matching Nodes" ? Coupling::MatchingNodes : Coupling::Automatic;
  using Geometry = Contact::Geometry;
  if (list.isParameter("Reach")) contact.reach = list.get<double>("Reach");
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

/// Place of an element side that lies on both faces; empty: there is none.
std::string commonSide(const Mesh& mesh, const ContactSurface& contact) {
  std::set<std::pair<int, int>> ofA;
  for (const Side& side : sidesOf(mesh.sideGroups, contact.groupsA)) ofA.emplace(side.element, side.side);
  for (const Side& side : sidesOf(mesh.sideGroups, contact.groupsB))
    if (ofA.count({side.element, side.side})) return placeText(mesh.point(mesh.nodesOf(side)[0]), mesh.dimension);
  return "";
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
  contact.overclosure = Overclosure::read(list, problems);
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

std::vector<Contact> withSprings(std::vector<Contact> contacts) {
  const std::size_t entries = contacts.size();
  for (std::size_t i = 0; i < entries; ++i)
    for (std::size_t spring = 1; contacts[i].overclosure && spring < contacts[i].overclosure->springs().size(); ++spring) {
      contacts.push_back(contacts[i]);
      contacts.back().spring = static_cast<int>(spring);
    }
  return contacts;
}

namespace {

/// Coats face A of a contact. \param number  of its line
void addCoating(Mesh& mesh, const Contact& contact, int number) {
  const std::vector<Side> sides = sidesOf(mesh.sideGroups, contact.groupsA);
  std::map<int, int> outerOf;
  for (const Side& side : sides)
    for (const int node : mesh.nodesOf(side)) outerOf[node] = -1;
  for (auto& [inner, outer] : outerOf) {
    outer = mesh.nodes();
    const Point place = mesh.point(inner);
    mesh.coordinates.insert(mesh.coordinates.end(), place.begin(), place.begin() + mesh.dimension);
    mesh.bodyOfNode.push_back(mesh.bodyOfNode[static_cast<std::size_t>(inner)]);
  }
  const double stiffness = contact.ownSpring().stiffness;
  for (const Side& side : sides) {
    mesh.coatings.push_back({side.element, side.side, number, static_cast<int>(mesh.coatingNodes.size()), stiffness,
                             stiffness * contact.overclosure->tangentialRatio()});
    for (const int node : mesh.nodesOf(side)) mesh.coatingNodes.push_back(outerOf.at(node));
  }
}

/// Replaces the nodes of face A by the outer nodes of its coating.
void coat(const Mesh& mesh, ContactSurface& contact) {
  if (!contact.overclosure || !contact.a.surface) return;
  std::map<int, int> outerOf;
  for (const Coating& coating : mesh.coatings) {
    if (coating.contact != contact.number) continue;
    const std::vector<int> inner = mesh.innerNodes(coating);
    for (std::size_t i = 0; i < inner.size(); ++i) outerOf[inner[i]] = mesh.outerNodes(coating)[i];
  }
  if (outerOf.size() != contact.a.surface->nodes().size()) throw InternalError("a softened contact without coating (addCoatings)");
  contact.a.surface->renumber(outerOf);
}

}  // namespace

void addCoatings(Mesh& mesh, const std::vector<Contact>& contacts) {
  const std::vector<Contact> lines = withSprings(contacts);
  for (std::size_t number = 0; number < lines.size(); ++number)
    if (lines[number].overclosure) addCoating(mesh, lines[number], static_cast<int>(number));
}

void removeCoatings(Mesh& mesh) {
  const auto nodes = static_cast<std::size_t>(mesh.bodyNodes());
  mesh.coordinates.resize(nodes * mesh.dimension);
  mesh.bodyOfNode.resize(nodes);
  mesh.coatings.clear();
  mesh.coatingNodes.clear();
}

void addCoatings(Mesh& mesh, const Parameters& contact) {
  std::vector<Contact> contacts(sublistNames(contact).size());
  for (const ContactLine& line : contactLines(contact)) {
    Contact& own = contacts[static_cast<std::size_t>(line.entry)];
    own.overclosure = line.law;
    own.groupsA = groupNames(contact.sublist(line.name), "Side A");
  }
  addCoatings(mesh, contacts);
}

std::vector<ContactSurface> contactsOn(const Mesh& mesh, const std::vector<Contact>& entries, Problems& problems) {
  std::vector<ContactSurface> surfaces;
  const std::vector<Contact> contacts = withSprings(entries);
  if (contacts.empty()) return surfaces;
  const SideTable table(mesh, allSides(mesh, contacts));
  Taken taken;
  for (std::size_t number = 0; number < contacts.size(); ++number) {
    ContactSurface surface{contacts[number], int(number), {}, {}};
    if (surface.spring > 0) {  // its first spring has been checked
      const auto first = std::find_if(surfaces.begin(), surfaces.end(), [&](const auto& own) { return own.path == surface.path; });
      if (first == surfaces.end()) continue;
      Problems known;
      surface.a = readFace(mesh, table, surface.groupsA, "", known);
      surface.b = first->b;
      coat(mesh, surface);
      surfaces.push_back(std::move(surface));
      continue;
    }
    const std::size_t before = problems.list().size();
    checkGroups(surface, mesh.sideGroupKind(), problems);
    const std::string pathA = surface.path + "/Side A", pathB = surface.path + "/Side B";
    surface.a = readFace(mesh, table, surface.groupsA, pathA, problems);
    surface.b = readFace(mesh, table, surface.groupsB, pathB, problems);
    if (const std::string both = inBoth(surface.groupsA, surface.groupsB); !both.empty())
      problems.add(pathB, "'" + both + "' is also Side A; expected the group on the opposite side");
    else if (const std::string common = commonSide(mesh, surface); !common.empty())
      problems.add(pathB, surface.b.name() + " and Side A have elements in common, as at " + common + "; a side does not touch itself");
    else
      taken.claim(mesh, surface, problems);
    if (problems.list().size() > before) continue;
    coat(mesh, surface);
    surfaces.push_back(std::move(surface));
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
  const auto isUnsound = [&](const ContactSurface& surface) {
    for (std::size_t i = 0; i < given.size(); ++i)
      if (given[i].path == surface.path) return !sound[i];
    return true;
  };
  surfaces.erase(std::remove_if(surfaces.begin(), surfaces.end(), isUnsound), surfaces.end());
  return surfaces;
}

Schema contactSchema(const std::string& law, const std::map<std::string, Schema>& laws) {
  return Schema("one contact: two facing sides, or one side and a rigid obstacle")
      .texts("Side A", std::nullopt,
             "curve group (3D: surface group) of the mesh, or several as {left, right}, on one or several bodies; the normal points from "
             "here to Side B or into the obstacle")
      .orOne()
      .texts("Side B", std::nullopt,
             "curve group (3D: surface group) of the mesh, or several, on other bodies, or on the same body as the faces of a crack; none "
             "with "
             "an Obstacle")
      .orOne()
      .optional()
      .choice("Law", law, laws, "forces that the two sides may exert on each other")
      .choice(Overclosure::kParameter, "Hard", Overclosure::choices(),
              "pressure as a function of the overclosure (negative gap) of the two sides: softened contact, a layer of springs on Side A. "
              "Hard: no overclosure")
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
      .real("Reach", std::nullopt,
            "with Mortar, largest distance of points that face each other, also of interference [length]; default: none. For sides that "
            "pass other parts of the partner, as teeth of gears",
            Range::positive(), "length")
      .optional()
      .text("Initial Gap", std::nullopt, "a function of x and y (3D: x, y and z) on Side A [length], instead of the distance in the mesh")
      .optional()
      .real("Tolerance", 1e-3, "largest tangential distance between the two nodes of a pair, as a fraction of the local mesh size",
            Range::positive());
}

}  // namespace suture
