// Contacts between two faces of one body, and several contacts on one side.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>

#include <map>
#include <set>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

namespace {

/// A plate [0, 4] x [0, 2] with a crack along y = 1 from x = 1 to x = 3: two blocks whose nodes on y = 1 are merged outside of the crack.
Mesh cracked(Cell cell) {
  Mesh mesh = stack(2, 8, cell);
  std::map<std::pair<double, double>, int> firstAt;
  std::vector<int> merged(static_cast<std::size_t>(mesh.nodes()), -1);
  std::vector<double> coordinates;
  int count = 0;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Point p = mesh.point(node);
    const bool isOpen = p[1] == 1.0 && p[0] > 1.0 && p[0] < 3.0;
    const auto [at, isNew] = firstAt.emplace(std::make_pair(p[0], p[1]), count);
    merged[static_cast<std::size_t>(node)] = isNew || isOpen ? count : at->second;
    if (merged[static_cast<std::size_t>(node)] < count) continue;
    ++count;
    coordinates.insert(coordinates.end(), {p[0], p[1]});
  }
  for (int& node : mesh.connectivity) node = merged[static_cast<std::size_t>(node)];
  mesh.coordinates = coordinates;
  std::vector<int> all;
  for (int element = 0; element < mesh.elements(); ++element) all.push_back(element);
  mesh.elementGroups = {{"plate", all}};
  const auto open = [&](const std::string& group) {
    std::vector<Side> sides;
    for (const Side& side : mesh.sideGroups.at(group)) {
      const std::vector<int> nodes = mesh.nodesOf(side);
      const double x = (mesh.point(nodes[0])[0] + mesh.point(nodes[1])[0]) / 2;
      if (x > 1.0 && x < 3.0) sides.push_back(side);
    }
    return sides;
  };
  const std::vector<Side> below = open("b0_top"), above = open("b1_bottom");
  mesh.sideGroups = {{"foot", mesh.sideGroups.at("b0_bottom")}, {"below", below}, {"above", above}};
  assignBodies(mesh, {"plate"});
  return mesh;
}

std::string crack(const std::string& coupling) {
  return entry("crack", {{"Side A", "below"}, {"Side B", "above"}, {"Coupling", coupling}});
}

}  // namespace

TEUCHOS_UNIT_TEST(ContactInOneBody, PairsTheFacesOfACrackWithoutItsTips) {
  for (const Cell cell : {Cell::Triangle3, Cell::Quadrilateral9})
    for (const std::string coupling : {"Matching Nodes", "Mortar"}) {
      const Mesh mesh = cracked(cell);
      const Constraints constraints = build(mesh, displacement("hold", "foot", "{0, 0}"), crack(coupling));
      TEST_EQUALITY(constraints.pieces.size(), 1u);
      TEST_ASSERT(constraints.pieces[0].isWithinOneBody);
      TEST_EQUALITY(constraints.pairs.size(), cell == Cell::Triangle3 ? 3u : 7u);  // nodes strictly between the tips
      double force = 0, moment = 0;                                                // of a unit pressure, on the lower face
      for (const ContactPair& pair : constraints.pairs) {
        TEST_COMPARE(norm(minus(pair.normal, {0, 1, 0})), <, 1e-15);
        TEST_EQUALITY(pair.gap, 0.0);
        double sum = 0;
        std::set<int> nodes;
        for (const PairEnd& end : pair.ends) {
          sum += end.weight;
          TEST_ASSERT(nodes.insert(end.node).second);  // the tip is on both faces and counts once
          if (end.weight > 0) force += end.weight * pair.length, moment += end.weight * pair.length * mesh.point(end.node)[0];
        }
        TEST_COMPARE(std::abs(sum), <, 1e-12);
      }
      if (coupling != "Mortar") continue;  // the tips keep their share: a uniform pressure on the whole crack
      TEST_COMPARE(std::abs(force - 2.0), <, 0.51);
      TEST_FLOATING_EQUALITY(moment / force, 2.0, 1e-12);
    }
}

TEUCHOS_UNIT_TEST(ContactInOneBody, HoldsNoBody) {
  const Mesh mesh = cracked(Cell::Triangle3);
  SUTURE_CHECK_SAYS(said(mesh, "", crack("Automatic")), "Bodies/plate: nothing holds this body");
}

TEUCHOS_UNIT_TEST(ContactInOneBody, RefusesASideThatTouchesItself) {
  Mesh mesh = cracked(Cell::Triangle3);
  mesh.sideGroups["half"] = {mesh.sideGroups.at("below").front(), mesh.sideGroups.at("below")[1]};
  const std::string contacts = entry("c", {{"Side A", "below"}, {"Side B", "half"}});
  SUTURE_CHECK_SAYS(said(mesh, displacement("hold", "foot", "{0, 0}"), contacts),
                    "Contact/c/Side B: 'half' and Side A have elements in common");
}

TEUCHOS_UNIT_TEST(SeveralContacts, MeetOneSideOnSeveralSidesOfOneBody) {
  Mesh mesh = stack(2);
  std::vector<Side>& bottom = mesh.sideGroups.at("b1_bottom");
  mesh.sideGroups["rough"] = {bottom.begin(), bottom.begin() + 4};
  mesh.sideGroups["smooth"] = {bottom.begin() + 4, bottom.end()};
  const std::string hold = displacement("hold", "b0_bottom", "{0, 0}");
  const Constraints constraints = build(mesh, hold, contact("one", "b0_top", "rough") + contact("two", "b0_top", "smooth"));
  double length = 0;
  std::set<int> lines;
  for (const ContactPair& pair : constraints.pairs) length += pair.length, lines.insert(pair.line);
  TEST_FLOATING_EQUALITY(length, 4.0, 1e-12);
  TEST_EQUALITY(lines.size(), 2u);
  SUTURE_CHECK_SAYS(said(mesh, hold, contact("one", "b0_top", "b1_bottom") + contact("two", "smooth", "b0_top")),
                    "Contact/two/Side A: 'smooth' meets, entirely or partly, sides of 'b0_top' also in Contact/one");
}

TEUCHOS_UNIT_TEST(SeveralContacts, MeetSeveralObstacles) {
  const Mesh mesh = stack(1);
  const auto on = [](const std::string& name, const std::string& point, const std::string& normal) {
    return "<ParameterList name=\"" + name + "\"><Parameter name=\"Side A\" type=\"string\" value=\"b0_bottom\"/>" +
           "<Parameter name=\"Obstacle\" type=\"string\" value=\"Line\"/><ParameterList name=\"Line\">" +
           "<Parameter name=\"Point\" type=\"Array(double)\" value=\"" + point + "\"/>" +
           "<Parameter name=\"Normal\" type=\"Array(double)\" value=\"" + normal + "\"/></ParameterList></ParameterList>";
  };
  TEST_EQUALITY(said(mesh, "", on("left", "{0, -0.1}", "{1, 1}") + on("right", "{4, -0.1}", "{-1, 1}")), "no error");
  SUTURE_CHECK_SAYS(said(mesh, "", on("left", "{0, -0.1}", "{1, 1}") + on("again", "{0, -0.1}", "{2, 2}")),
                    "Contact/again/Side A: 'b0_bottom' meets, entirely or partly, this obstacle also in Contact/left");
}

TEUCHOS_UNIT_TEST(PointSupports, HoldTheNodeAtAPoint) {
  const Mesh mesh = stack(1);
  const auto at = [](const std::string& name, const std::string& point, const std::string& components, const std::string& value) {
    return entry(name, {{"Type", "Displacement"}, {"Point", point}, {"Components", components}, {"Value", value}});
  };
  const Constraints constraints = build(mesh, at("corner", "{0, 0}", "All", "{0, 0.5}") + at("roller", "{4, 0}", "y", "{0.25}"));
  TEST_EQUALITY(constraints.rules.size(), 2u);
  const NodeRule &corner = *ruleAt(constraints, nodeAt(mesh, 0, 0, 0)), &roller = *ruleAt(constraints, nodeAt(mesh, 0, 4, 0));
  TEST_ASSERT(corner.fixed[0] && corner.fixed[1]);
  TEST_EQUALITY(corner.value[1], 0.5);
  TEST_ASSERT(!roller.fixed[0] && roller.fixed[1]);
  TEST_EQUALITY(roller.value[1], 0.25);
}

TEUCHOS_UNIT_TEST(PointSupports, RefuseWhatIsNotClear) {
  const Mesh mesh = stack(2);
  const auto problems = [&](const std::vector<std::pair<std::string, std::string>>& more) {
    std::vector<std::pair<std::string, std::string>> all{{"Type", "Displacement"}, {"Value", "{0, 0}"}};
    all.insert(all.end(), more.begin(), more.end());
    return said(mesh, entry("pin", all), matching("joint", "b0_top", "b1_bottom"));
  };
  SUTURE_CHECK_SAYS(problems({{"Point", "{0, 1}"}}), "pin/Body: is missing: at (0, 1) there are nodes of the bodies 'b0' and 'b1'");
  TEST_EQUALITY(problems({{"Point", "{0, 1}"}, {"Body", "b1"}}), "no error");
  SUTURE_CHECK_SAYS(problems({{"Point", "{0.1, 0}"}}), "pin/Point: no node within 4.47214e-06 of (0.1, 0); the nearest one is (0, 0)");
  TEST_EQUALITY(problems({{"Point", "{0.1, 0}"}, {"Tolerance", "0.2"}}), "no error");
  SUTURE_CHECK_SAYS(problems({{"Point", "{0, 0}"}, {"Group", "b0_bottom"}}), "pin/Point: found together with a Group");
  SUTURE_CHECK_SAYS(problems({{"Point", "{0, 0}"}, {"Body", "b7"}}), "no such body 'b7'");
  SUTURE_CHECK_SAYS(problems({{"Point", "{0, 0, 0}"}}), "pin/Point: 3 coordinates; expected 2");
  SUTURE_CHECK_SAYS(problems({}), "pin/Group: is missing");
}
