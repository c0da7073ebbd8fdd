#include <suture/base/scene/SceneReader.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/Conditions.hpp>
#include <suture/constraints/ContactLaw.hpp>
#include <suture/constraints/ContactLine.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideTable.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>

namespace suture {

namespace {

/// Checks one side of one line.
class SideCheck {
 public:
  SideCheck(const Mesh& mesh, const SideTable& table, const std::string& path, Problems& problems)
      : mesh_(mesh), table_(table), path_(path), problems_(problems) {}

  /// Body of the side, or -1 after a problem.
  int bodyOf(const std::string& group) {
    const auto found = mesh_.sideGroups.find(group);
    if (found == mesh_.sideGroups.end()) return wrong(unknownCurve(mesh_, group));
    const std::vector<Side>& sides = found->second;
    if (sides.empty()) return wrong("the curve group '" + group + "' of the mesh " + mesh_.source + " is empty");
    std::set<int> bodies;
    std::set<std::size_t> orders;
    for (const Side& side : sides) {
      bodies.insert(mesh_.bodyOfElement[side.element]);
      orders.insert(mesh_.nodesOf(side).size());
      if (!table_.onBoundary(side))
        return wrong("'" + group + "' lies inside the material near " + placeText(centreOf(mesh_, side.element)) +
                     "; expected a part of the boundary of one body");
    }
    if (bodies.size() > 1)
      return wrong("'" + group + "' lies on " + std::to_string(bodies.size()) + " bodies (" + mesh_.bodies[*bodies.begin()] + ", " +
                   mesh_.bodies[*bodies.rbegin()] + "); expected a curve group of its own for each side");
    if (orders.size() > 1)
      return wrong("'" + group + "' has sides of two and of three nodes; expected elements of one order along a contact side");
    return soundLine(group, sides) ? *bodies.begin() : -1;
  }

 private:
  int wrong(const std::string& what) {
    problems_.add(path_, what);
    return -1;
  }

  bool soundLine(const std::string& group, const std::vector<Side>& sides) {
    const BoundaryLine line(mesh_, sides);
    if (!line.branchings().empty()) {
      wrong("'" + group + "' is no line: more than two of its elements meet at " + placeText(mesh_.point(line.branchings()[0])));
      return false;
    }
    for (const auto& [node, data] : line.nodes()) {
      if (data.sideNormals.size() < 2 || angleBetween(data.sideNormals[0], data.sideNormals[1]) <= sharpAngle) continue;
      char degrees[20];
      std::snprintf(degrees, sizeof degrees, "%.0f", angleBetween(data.sideNormals[0], data.sideNormals[1]) * 180 / 3.14159265358979);
      wrong("'" + group + "' turns by " + degrees + " degrees at " + placeText(mesh_.point(node)) +
            ", so that the contact has no normal there; make each leg a contact line of its own");
      return false;
    }
    return true;
  }

  const Mesh& mesh_;
  const SideTable& table_;
  std::string path_;
  Problems& problems_;
};

// Partner of side A: Side B, in one of two ways, or an obstacle.
void readCoupling(const Parameters& list, bool rigid, ContactLine& line, Problems& problems) {
  const bool given = list.isParameter("Side B");
  if (given) line.groupB = list.get<std::string>("Side B");
  if (given && line.groupB.empty()) problems.add(pathOf(list, "Side B"), "is empty; expected a curve group on another body");
  if (given && rigid) problems.add(pathOf(list, "Side B"), "found beside an Obstacle; expected one of the two");
  if (!given && !rigid) problems.add(pathOf(list, "Side B"), "is missing: expected a curve group on another body, or an Obstacle");
  const std::string coupling = list.get<std::string>("Coupling"), carrier = list.get<std::string>("Multipliers On");
  using Coupling = ContactLine::Coupling;
  using Carrier = ContactLine::Carrier;
  line.coupling = coupling == "Mortar" ? Coupling::Mortar : coupling == "Matching Nodes" ? Coupling::MatchingNodes : Coupling::Automatic;
  using Geometry = ContactLine::Geometry;
  const std::string geometry = list.get<std::string>("Geometry");
  line.geometry = geometry == "Smooth" ? Geometry::Smooth : geometry == "Facets" ? Geometry::Facets : Geometry::Automatic;
  line.carrier = carrier == "Side A" ? Carrier::SideA : carrier == "Side B" ? Carrier::SideB : Carrier::Automatic;
}

/// Sides of all curve groups that contact names.
std::vector<Side> sidesOf(const Mesh& mesh, const Parameters& contact) {
  std::vector<Side> sides;
  for (const std::string& name : sublistNames(contact))
    for (const char* which : {"Side A", "Side B"}) {
      const Parameters& list = contact.sublist(name);
      const auto group = list.isParameter(which) ? mesh.sideGroups.find(list.get<std::string>(which)) : mesh.sideGroups.end();
      if (group != mesh.sideGroups.end()) sides.insert(sides.end(), group->second.begin(), group->second.end());
    }
  return sides;
}

}  // namespace

std::vector<ContactLine> readContact(const Mesh& mesh, const Parameters& contact, const Constants& constants, Problems& problems) {
  std::vector<ContactLine> lines;
  const std::vector<std::string> names = sublistNames(contact);
  if (names.empty()) return lines;
  const SideTable table(mesh, sidesOf(mesh, contact));
  std::map<std::pair<int, int>, std::string> taken;  // (element, side) -> path of the side that has it
  for (int number = 0; number < static_cast<int>(names.size()); ++number) {
    const Parameters& list = contact.sublist(names[number]);
    const std::size_t before = problems.list().size();
    ContactLine line;
    line.number = number;
    line.name = names[number];
    line.path = pathOf(list);
    line.groupA = list.get<std::string>("Side A");
    line.obstacle = Obstacle::read(list, constants, problems);
    line.initialGap = readExpression(list, "Initial Gap", constants, problems);
    const bool rigid = list.get<std::string>("Obstacle") != "None";
    readCoupling(list, rigid, line, problems);
    line.tolerance = list.get<double>("Tolerance");
    const std::string pathA = pathOf(list, "Side A"), pathB = pathOf(list, "Side B");
    line.bodyA = SideCheck(mesh, table, pathA, problems).bodyOf(line.groupA);
    if (!line.groupB.empty()) line.bodyB = SideCheck(mesh, table, pathB, problems).bodyOf(line.groupB);
    if (line.groupA == line.groupB)
      problems.add(pathB, "'" + line.groupB + "' is Side A, too; expected the group on the other body");
    else if (line.bodyA >= 0 && line.bodyA == line.bodyB)
      problems.add(pathB,
                   "'" + line.groupB + "' is on the body '" + mesh.bodies[line.bodyB] + "', as Side A; contact is between two bodies");
    else
      for (const auto& [group, path] : {std::make_pair(line.groupA, pathA), std::make_pair(line.groupB, pathB)}) {
        if (group.empty()) continue;
        const auto found = mesh.sideGroups.find(group);
        if (found == mesh.sideGroups.end()) continue;
        std::string other;
        for (const Side& side : found->second) {
          const auto [at, isNew] = taken.emplace(std::make_pair(side.element, side.side), path);
          if (!isNew) other = at->second;
        }
        if (!other.empty())
          problems.add(path, "'" + group + "' lies, in whole or in part, also in " + other + "; a side is in one contact only");
      }
    if (problems.list().size() == before) lines.push_back(line);
  }
  return lines;
}

Schema contactSchema() {
  return Schema("one contact line: two facing sides, or a side and a rigid obstacle")
      .text("Side A", std::nullopt, "curve group of the mesh, on one body; the normal points from here to Side B or into the obstacle")
      .text("Side B", std::nullopt, "curve group of the mesh, on the other body; none with an Obstacle")
      .optional()
      .choice("Law", Frictionless::kName, Registry<ContactLaw>::instance().schemas(), "which forces the two sides exert on each other")
      .choice("Obstacle", "None", Obstacle::choices(), "what stands against Side A instead of a second body")
      .oneOf(
          "Coupling", "Automatic", {"Automatic", "Matching Nodes", "Mortar"},
          "Matching Nodes: each node has one opposite; Mortar: any two meshes, dual Lagrange multipliers; Automatic: Mortar where nodes do "
          "not match")
      .oneOf("Multipliers On", "Automatic", {"Automatic", "Side A", "Side B"},
             "with Mortar, the side whose nodes carry the contact stress; Automatic: one that the other covers wholly, or that with more "
             "nodes; of two-node elements on a curve the coarser one")
      .oneOf("Geometry", "Automatic", {"Automatic", "Smooth", "Facets"},
             "with Mortar, what curve stands for a side whose elements are straight while their nodes lie on a curve. Automatic: the shape "
             "that both sides have when pressed together, between their curvatures by the bodies' stiffnesses; Smooth: the drawn curve, by "
             "the curvature through neighbouring nodes; Facets: the elements themselves")
      .text("Initial Gap", std::nullopt, "a function of x and y on Side A [length], instead of the distance in the mesh")
      .optional()
      .real("Tolerance", 1e-3, "how far apart along the line the two nodes of a pair may be, as a fraction of the local mesh size",
            Range::positive());
}

}  // namespace suture
