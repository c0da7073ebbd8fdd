// Rigid obstacles in 3D: distances and normals against closed forms.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/CheckSays.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/SideGeometry.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>

#include "SpaceScenes.hpp"

using namespace pairstesting;

namespace {

/// The face z = 1 of a cube [-1,1]^2 x [0,1], "b_top", and the one below, "b_bottom".
Mesh cube(Cell cell = Cell::Hexahedron8, int n = 4) {
  Box box;
  box.name = "b";
  box.x0 = box.y0 = -1;
  box.nx = box.ny = n, box.nz = 1, box.cell = cell;
  Mesh mesh = boxes({box});
  assignBodies(mesh, {"b"});
  return mesh;
}

using Entries = std::vector<std::pair<std::string, std::string>>;

/// Reads a contact of the face below with an obstacle. \param more  parameters of the contact
std::vector<ContactSurface> read(const Mesh& mesh, const std::string& type, const Entries& own, Problems& problems,
                                 const Entries& more = {}) {
  Schema schema("scene");
  schema.list("Contact", Schema("contacts").each("contact", contactSchema("Any", {{"Any", Schema("any law")}})));
  const auto parameters = [](const Entries& all) {
    std::string xml;
    for (const auto& [name, value] : all) xml += "<Parameter name=\"" + name + "\" value=\"" + value + "\"/>";
    return xml;
  };
  const SceneFile scene =
      parseScene("<ParameterList name=\"Suture\"><ParameterList name=\"Contact\"><ParameterList name=\"ground\">" +
                     parameters({{"Side A", "b_bottom"}, {"Obstacle", type}}) + parameters(more) + "<ParameterList name=\"" + type + "\">" +
                     parameters(own) + "</ParameterList></ParameterList></ParameterList></ParameterList>",
                 "test.xml", schema);
  Constants constants;
  constants.dimension = mesh.dimension;
  return readContact(mesh, scene.parameters->sublist("Contact"), constants, problems);
}

PairedSurface against(const Mesh& mesh, const std::string& type, const Entries& own, const Entries& more = {},
                      std::vector<std::string>* notes = nullptr) {
  Problems problems;
  const std::vector<ContactSurface> surfaces = read(mesh, type, own, problems, more);
  problems.throwIfAny();
  std::vector<std::string> some;
  PairedSurface paired = pairSurface(mesh, surfaces.at(0), problems, notes ? *notes : some);
  problems.throwIfAny();
  return paired;
}

std::string saidOf(const Mesh& mesh, const std::string& type, const Entries& own) {
  Problems problems;
  std::vector<std::string> notes;
  for (const ContactSurface& surface : read(mesh, type, own, problems)) pairSurface(mesh, surface, problems, notes);
  std::string all;
  for (const auto& [path, what] : problems.list()) all += path + ": " + what + "\n";
  return all;
}

}  // namespace

TEUCHOS_UNIT_TEST(ObstaclesInSpace, MeasureTheDistanceFromAPlane) {
  const Point outward{1.0 / 3, -2.0 / 3, 2.0 / 3};
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4, Cell::Hexahedron27}) {
    const PairedSurface paired = against(cube(cell), "Plane", {{"Point", "{0.0, 0.0, -2.0}"}, {"Normal", "{1.0, -2.0, 2.0}"}});
    double area = 0;
    for (const ContactPair& pair : paired.pairs) {
      TEST_EQUALITY(pair.ends.size(), std::size_t(1));
      TEST_COMPARE(norm(plus(pair.normal, outward)), <, 1e-14);
      TEST_COMPARE(std::abs(pair.gap - dot(plus(pair.position, {0, 0, 2}), outward)), <, 1e-14);
      area += pair.length;
    }
    TEST_FLOATING_EQUALITY(area, 4.0, 1e-13);
    TEST_ASSERT(!paired.cells.empty());
  }
}

TEUCHOS_UNIT_TEST(ObstaclesInSpace, MeasureTheDistanceFromABallAndFromInsideIt) {
  const Mesh mesh = cube();
  for (const ContactPair& pair : against(mesh, "Ball", {{"Centre", "{0.25, -0.5, -3.0}"}, {"Radius", "2.5"}}).pairs) {
    const Point arm = minus(pair.position, {0.25, -0.5, -3});
    TEST_COMPARE(std::abs(pair.gap - (norm(arm) - 2.5)), <, 1e-14);
    TEST_COMPARE(norm(plus(pair.normal, scaled(1 / norm(arm), arm))), <, 1e-14);
  }
  for (const ContactPair& pair : against(mesh, "Ball", {{"Centre", "{0.0, 0.0, 4.0}"}, {"Radius", "5.0"}, {"Hollow", "true"}}).pairs) {
    const Point arm = minus(pair.position, {0, 0, 4});
    TEST_COMPARE(std::abs(pair.gap - (5 - norm(arm))), <, 1e-14);
    TEST_COMPARE(norm(minus(pair.normal, scaled(1 / norm(arm), arm))), <, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(ObstaclesInSpace, MeasureTheDistanceFromACylinder) {
  const Point axis{0.6, 0.8, 0};
  for (const ContactPair& pair :
       against(cube(), "Cylinder", {{"Point", "{3.0, 4.0, -2.0}"}, {"Axis", "{3.0, 4.0, 0.0}"}, {"Radius", "0.5"}}).pairs) {
    const Point arm = minus(pair.position, {3, 4, -2}), across = minus(arm, scaled(dot(arm, axis), axis));
    TEST_COMPARE(std::abs(pair.gap - (norm(across) - 0.5)), <, 1e-14);
    TEST_COMPARE(norm(plus(pair.normal, scaled(1 / norm(across), across))), <, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(ObstaclesInSpace, LineariseTheConditionOnAGraph) {
  const Mesh mesh = cube();
  const auto height = [](const Point& p) { return -0.05 * p[0] * p[0] + 0.1 * std::sin(p[1]) * p[0] - 0.5; };
  const Entries graph{{"Expression", "-0.05*x^2 + 0.1*sin(y)*x - 0.5"}};
  for (const ContactPair& pair : against(mesh, "Height", graph).pairs) {
    const Point p = pair.position, down{-0.1 * p[0] + 0.1 * std::sin(p[1]), 0.1 * std::cos(p[1]) * p[0], -1};
    TEST_COMPARE(std::abs(pair.gap - (p[2] - height(p)) / norm(down)), <, 1e-11);
    TEST_COMPARE(norm(minus(pair.normal, scaled(1 / norm(down), down))), <, 1e-11);
  }
  Entries vertical = graph;
  vertical.push_back({"Direction", "Vertical"});
  for (const ContactPair& pair : against(mesh, "Height", vertical).pairs) {
    TEST_ASSERT((pair.normal == Point{0, 0, -1}));
    TEST_COMPARE(std::abs(pair.gap + height(pair.position)), <, 1e-15);
  }
}

// Along the normal of the face: distance along a ray.
TEUCHOS_UNIT_TEST(ObstaclesInSpace, AreSeenAlongTheNormalOfTheFaceWhereTheSceneSaysSo) {
  const Mesh mesh = cube();
  const Entries side{{"Direction", "Side"}};
  const auto check = [&](const std::string& type, const Entries& own, const std::function<double(Point)>& way) {
    const PairedSurface paired = against(mesh, type, own, side);
    TEST_EQUALITY(paired.pairs.size(), std::size_t(25));
    for (const ContactPair& pair : paired.pairs) {
      TEST_ASSERT((pair.normal == Point{0, 0, -1}));
      TEST_COMPARE(std::abs(pair.gap - way(pair.position)), <, 1e-12);
    }
  };
  check("Plane", {{"Point", "{0.0, 0.0, -2.0}"}, {"Normal", "{1.0, -2.0, 2.0}"}}, [](Point p) { return 2 + (p[0] - 2 * p[1]) / 2; });
  check("Ball", {{"Centre", "{0.0, 0.0, -3.0}"}, {"Radius", "2.5"}},
        [](Point p) { return 3 - std::sqrt(6.25 - p[0] * p[0] - p[1] * p[1]); });
  check("Ball", {{"Centre", "{0.0, 0.0, 4.0}"}, {"Radius", "5.0"}, {"Hollow", "true"}},
        [](Point p) { return std::sqrt(25 - p[0] * p[0] - p[1] * p[1]) - 4; });
  check("Cylinder", {{"Point", "{0.0, 0.0, -2.0}"}, {"Axis", "{0.0, 1.0, 0.0}"}, {"Radius", "1.5"}},
        [](Point p) { return 2 - std::sqrt(2.25 - p[0] * p[0]); });
  check("Height", {{"Expression", "0.1*x - 0.2*y - 1"}}, [](Point p) { return 1 - 0.1 * p[0] + 0.2 * p[1]; });
}

// Sides of six and eight nodes: conditions with the forces of a uniform pressure, and mean gaps.
TEUCHOS_UNIT_TEST(ObstaclesInSpace, TakeTheDualMeanOfTheGapOfSecondOrderSides) {
  for (const Cell cell : {Cell::Tetrahedron10, Cell::Hexahedron20}) {
    const Mesh mesh = cube(cell);
    const PairedSurface paired = against(mesh, "Plane", {{"Point", "{0.0, 0.0, -1.0}"}, {"Normal", "{0.1, 0.2, 1.0}"}});
    TEST_EQUALITY(paired.pairs.size(), std::size_t(cell == Cell::Tetrahedron10 ? 81 : 65));
    std::map<int, double> force;
    double area = 0;
    const Point outward = scaled(1 / std::sqrt(1.05), Point{0.1, 0.2, 1});
    for (const ContactPair& pair : paired.pairs) {
      area += pair.length;
      Point mean{0, 0, 0};
      double sum = 0;
      for (const PairEnd& end : pair.ends) {
        force[end.node] += pair.length * end.weight;
        mean = plus(mean, scaled(end.weight, mesh.point(end.node)));
        sum += end.weight;
      }
      TEST_FLOATING_EQUALITY(sum, 1.0, 1e-13);
      TEST_COMPARE(pair.ends.front().weight, >, 0.0);
      TEST_COMPARE(std::abs(pair.gap - dot(plus(mean, {0, 0, 1}), outward)), <, 1e-13);
    }
    TEST_FLOATING_EQUALITY(area, 4.0, 1e-13);
    std::map<int, double> sizes;
    for (const Side& side : mesh.sideGroups.at("b_bottom")) {
      const std::vector<int> nodes = mesh.nodesOf(side);
      std::vector<Point> points;
      for (const int node : nodes) points.push_back(mesh.point(node));
      std::vector<double> own(nodes.size(), 0.0);
      addTributarySizes(points, 3, false, own);
      for (std::size_t i = 0; i < nodes.size(); ++i) sizes[nodes[i]] += own[i];
    }
    for (const auto& [node, size] : sizes) TEST_COMPARE(std::abs(force[node] - size), <, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(ObstaclesInSpace, LeaveOutNodesThatSeeThemAside) {
  std::vector<std::string> notes;
  const PairedSurface bump = against(cube(), "Ball", {{"Centre", "{0.0, 0.0, -0.4}"}, {"Radius", "0.3"}}, {}, &notes);
  TEST_EQUALITY(bump.pairs.size(), std::size_t(5));  // within .4 tan 60 degrees = .693 of the middle: half a side, not the diagonal
  TEST_EQUALITY(notes.size(), std::size_t(1));
  SUTURE_CHECK_SAYS(notes[0], "20 of the 25 nodes of 'b_bottom' see the obstacle more than 60 degrees off their normal");
  SUTURE_CHECK_SAYS(notes[0], "(the first at (-1, -1, 0))");
}

TEUCHOS_UNIT_TEST(ObstaclesInSpace, ReportErrors) {
  const Mesh mesh = cube();
  SUTURE_CHECK_SAYS(saidOf(mesh, "Line", {{"Point", "{0.0, 0.0}"}, {"Normal", "{0.0, 1.0}"}}),
                    "Contact/ground/Obstacle: 'Line' is 2D; expected Plane, Ball, Cylinder or Height");
  SUTURE_CHECK_SAYS(saidOf(mesh, "Plane", {{"Point", "{0.0, 0.0}"}, {"Normal", "{0.0, 0.0, 1.0}"}}),
                    "Contact/ground/Plane/Point: found 2 numbers; expected three, x, y and z");
  SUTURE_CHECK_SAYS(saidOf(mesh, "Plane", {{"Point", "{0.0, 0.0, 0.0}"}, {"Normal", "{0.0, 0.0, 0.0}"}}),
                    "Contact/ground/Plane/Normal: has no length");
  SUTURE_CHECK_SAYS(saidOf(mesh, "Cylinder", {{"Point", "{0.0, 0.0, 0.0}"}, {"Axis", "{0.0, 0.0, 0.0}"}, {"Radius", "1.0"}}),
                    "Contact/ground/Cylinder/Axis: has no length");
  SUTURE_CHECK_SAYS(saidOf(mesh, "Plane", {{"Point", "{0.0, 0.0, 0.0}"}, {"Normal", "{0.0, 0.0, -1.0}"}}),
                    "'b_bottom' does not face the obstacle");
}
