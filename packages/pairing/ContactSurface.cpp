#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/pairing/ContactSurface.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace suture {

namespace {

/// The first corner of a surface that is too sharp.
struct Turn {
  double angle = 0;
  int node = -1;
};

Turn sharpestTurn(const Surface& line) {
  Turn turn;
  for (const auto& [node, data] : line.nodes()) {
    turn = {0, node};
    for (const Point& normal : data.sideNormals) turn.angle = std::max(turn.angle, angleBetween(data.sideNormals[0], normal));
    if (turn.angle > kSharpAngle) break;
  }
  return turn;
}

/// The same in space, between sides that share an edge.
Turn sharpestEdge(const Surface& surface) {
  std::vector<std::vector<NodeNormal>> normals;
  for (int side = 0; side < surface.sides(); ++side) {
    std::vector<Point> points;
    for (const int node : surface.nodesOf(side)) points.push_back(surface.at(node).position);
    normals.push_back(nodeNormals(points, 3));
  }
  for (int side = 0; side < surface.sides(); ++side)
    for (int facet = 0; facet < surface.facets(side); ++facet) {
      const Surface::Facet& other = surface.across(side, facet);
      if (other.side < side) continue;
      // The edge runs from its facet's vertex to the next, of the other side the other way round.
      const int next = (facet + 1) % surface.facets(side), otherNext = (other.facet + 1) % surface.facets(other.side);
      for (const auto& [own, its] : {std::make_pair(facet, otherNext), std::make_pair(next, other.facet)}) {
        const Turn turn{angleBetween(normals[side][own].density, normals[other.side][its].density), surface.nodesOf(side)[own]};
        if (turn.angle > kSharpAngle) return turn;
      }
    }
  return {};
}

/// Reads and checks one face of one contact.
class FaceCheck {
 public:
  FaceCheck(const Mesh& mesh, const SideTable& table, const std::string& path, Problems& problems)
      : mesh_(mesh), table_(table), path_(path), problems_(problems) {}

  /// The face; without a surface after a problem.
  ContactFace read(const std::vector<std::string>& groups) {
    ContactFace face;
    face.groups = groups;
    if (groups.empty() || std::count(groups.begin(), groups.end(), "") > 0) return face;
    bool known = true;
    for (const std::string& group : groups) known = exists(group) && known;
    if (!known) return face;
    const std::vector<Side> sides = sidesOf(mesh_.sideGroups, groups);
    std::set<int> bodies;
    std::set<int> orders;
    for (const Side& side : sides) {
      bodies.insert(mesh_.bodyOfElement[side.element]);
      orders.insert(cellInfo(mesh_.cells[side.element]).order);
      if (table_.onBoundary(side)) continue;
      wrong(face.name() + " lies inside the material near " + placeText(centreOf(mesh_, side.element), mesh_.dimension) +
            "; expected a part of the boundary of bodies");
      return face;
    }
    face.bodies.assign(bodies.begin(), bodies.end());
    if (orders.size() > 1) {
      wrong(face.name() + (mesh_.dimension == 2 ? " has sides of two and of three nodes" : " has sides of first and of second order") +
            "; expected elements of one order along a contact side");
      return face;
    }
    Surface surface(mesh_, sides);
    if (isSound(face, surface)) face.surface = std::move(surface);
    return face;
  }

 private:
  void wrong(const std::string& what) { problems_.add(path_, what); }

  bool exists(const std::string& group) {
    const std::string problem = sideGroupProblem(mesh_, group);
    if (!problem.empty()) wrong(problem);
    return problem.empty();
  }

  bool isSound(const ContactFace& face, const Surface& surface) {
    const bool inPlane = mesh_.dimension == 2;
    const auto place = [&](int node) { return placeText(mesh_.point(node), mesh_.dimension); };
    if (!surface.branchings().empty()) {
      wrong(face.name() +
            (inPlane ? " is no line: more than two of its elements meet at "
                     : " is no surface: more than two of its sides meet along the edge at ") +
            place(surface.branchings()[0]));
      return false;
    }
    const Turn turn = inPlane ? sharpestTurn(surface) : sharpestEdge(surface);
    if (turn.angle <= kSharpAngle) return true;
    char degrees[20];
    std::snprintf(degrees, sizeof degrees, "%.0f", turn.angle * 180 / 3.14159265358979);
    wrong(face.name() + " turns by " + degrees + " degrees at " + place(turn.node) +
          ", so that the contact has no normal there; make each " +
          (inPlane ? "leg a contact line of its own" : "face a contact of its own"));
    return false;
  }

  const Mesh& mesh_;
  const SideTable& table_;
  std::string path_;
  Problems& problems_;
};

/// Finds contacts that name a side which another face has already.
class Taken {
 public:
  void claim(const Mesh& mesh, const ContactFace& face, const std::string& path, Problems& problems) {
    std::string other;
    for (const Side& side : sidesOf(mesh.sideGroups, face.groups)) {
      const auto [at, isNew] = pathOf_.emplace(std::make_pair(side.element, side.side), path);
      if (!isNew) other = at->second;
    }
    if (!other.empty())
      problems.add(path, face.name() + (face.groups.size() > 1 ? " lie" : " lies") + ", in whole or in part, also in " + other +
                             "; a side is in one contact only");
  }

 private:
  std::map<std::pair<int, int>, std::string> pathOf_;  // (element, side)
};

/// That each face has groups, or an obstacle stands instead of face B.
void checkGroups(const Contact& contact, const std::string& kind, Problems& problems) {
  const auto lacksName = [](const std::vector<std::string>& groups) { return std::count(groups.begin(), groups.end(), "") > 0; };
  const std::string pathA = contact.path + "/Side A", pathB = contact.path + "/Side B";
  const std::string several = ", or several as {left, right}";
  if (contact.groupsA.empty() || lacksName(contact.groupsA)) problems.add(pathA, "is empty; expected a " + kind + several);
  if (lacksName(contact.groupsB)) problems.add(pathB, "is empty; expected a " + kind + " on another body" + several);
  if (!contact.groupsB.empty() && contact.obstacle) problems.add(pathB, "found beside an Obstacle; expected one of the two");
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
  if (list.get<std::string>("Multipliers") == "Quadratic") contact.multipliers = Contact::Multipliers::Quadratic;
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

/// A name that two lists have, or nothing.
std::string inBoth(const std::vector<std::string>& a, const std::vector<std::string>& b) {
  const auto found = std::find_first_of(a.begin(), a.end(), b.begin(), b.end());
  return found == a.end() ? "" : *found;
}

Contact contactIn(const Parameters& list, const std::string& name, int dimension, const Constants& constants, Problems& problems) {
  Contact contact;
  contact.name = name;
  contact.path = pathOf(list);
  contact.obstacle = Obstacle::read(list, dimension, constants, problems);
  // One with a problem: what is said of the faces shall not depend on it.
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
    surface.a = FaceCheck(mesh, table, pathA, problems).read(surface.groupsA);
    surface.b = FaceCheck(mesh, table, pathB, problems).read(surface.groupsB);
    const std::vector<int>& bodies = surface.a.bodies;
    if (const std::string both = inBoth(surface.groupsA, surface.groupsB); !both.empty()) {
      problems.add(pathB, "'" + both + "' is Side A, too; expected the group on the other body");
    } else if (bodies.size() == 1 && bodies == surface.b.bodies) {
      problems.add(pathB, surface.b.name() + " is on the body '" + mesh.bodies[bodies[0]] + "', as Side A; contact is between two bodies");
    } else {
      taken.claim(mesh, surface.a, pathA, problems);
      taken.claim(mesh, surface.b, pathB, problems);
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
  return Schema("one contact: two facing sides, or a side and a rigid obstacle")
      .texts(
          "Side A", std::nullopt,
          "curve group of the mesh, in space surface group, or several as {left, right}, on one or several bodies; the normal points from "
          "here to Side B or into the obstacle")
      .orOne()
      .texts("Side B", std::nullopt, "curve group of the mesh, in space surface group, or several, on other bodies; none with an Obstacle")
      .orOne()
      .optional()
      .choice("Law", law, laws, "which forces the two sides exert on each other")
      .choice("Obstacle", "None", Obstacle::choices(), "what stands against Side A instead of a second body")
      .oneOf("Direction", "Obstacle", {"Obstacle", "Side"},
             "with an Obstacle, along which normal nodes are kept from it, and gaps are measured: that of the obstacle, or of Side A")
      .oneOf(
          "Coupling", "Automatic", {"Automatic", "Matching Nodes", "Mortar"},
          "Matching Nodes: each node has one opposite; Mortar: any two meshes, dual Lagrange multipliers; Automatic: Mortar where nodes do "
          "not match")
      .oneOf("Multipliers On", "Automatic", {"Automatic", "Side A", "Side B"},
             "with Mortar, the side whose nodes carry the contact stress; Automatic: one that the other covers wholly, or that with more "
             "nodes; of two-node elements on a curve the coarser one")
      .oneOf("Multipliers", "Linear", {"Linear", "Quadratic"},
             "with Mortar, on second-order sides in space, the contact stress between nodes. Linear: one value a vertex; Quadratic: one a "
             "node, by functions with positive integrals")
      .oneOf("Geometry", "Automatic", {"Automatic", "Smooth", "Facets"},
             "with Mortar, what curve stands for a side whose elements are straight while their nodes lie on a curve. Automatic: the shape "
             "that both sides have when pressed together, between their curvatures by the bodies' stiffnesses; Smooth: the drawn curve, by "
             "the curvature through neighbouring nodes; Facets: the elements themselves")
      .text("Initial Gap", std::nullopt,
            "a function of x and y, in space of x, y and z, on Side A [length], instead of the distance in the mesh")
      .optional()
      .real("Tolerance", 1e-3, "how far apart along the line the two nodes of a pair may be, as a fraction of the local mesh size",
            Range::positive());
}

}  // namespace suture
