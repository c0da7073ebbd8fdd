#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/loads/LoadList.hpp>
#include <suture/mesh/Generators.hpp>

#include "SampleCells.hpp"

using namespace suture;

namespace {

constexpr double pi = 3.14159265358979323846;

Load traction(double x, double y) { return {Load::Kind::Traction, "", {x, y, 0}, 0, {}, {"side"}}; }
Load pressure(double p) { return {Load::Kind::Pressure, "", {p, 0, 0}, 0, {}, {"side"}}; }
Load bodyForce(double x, double y) { return {Load::Kind::BodyForce, "", {x, y, 0}}; }

// Force and moment about the origin of nodal forces: (Fx, Fy, M).
Point resultant(const CellBlock& block, const Vector& forces) {
  Point sum{0, 0, 0};
  for (int i = 0; i < block.nodes(); ++i) {
    const Point p = block.point(i);
    sum[0] += forces[2 * i];
    sum[1] += forces[2 * i + 1];
    sum[2] += p[0] * forces[2 * i + 1] - p[1] * forces[2 * i];
  }
  return sum;
}

Vector sideForces(const CellBlock& block, const std::vector<Side>& sides, const Load& load) {
  Vector forces = Vector::Zero(2 * block.nodes());
  addSideLoad(block, sides, load, forces);
  return forces;
}

Vector bodyForces(const CellBlock& block, const Load& load) {
  Vector forces = Vector::Zero(2 * block.nodes());
  std::vector<int> all;
  for (int e = 0; e < block.elements(); ++e) all.push_back(e);
  addBodyForce(block, all, load, forces);
  return forces;
}

// A disc of n triangles around a centre, off the origin; Triangle6 with its outer mid-side nodes on the circle.
CellBlock disc(Cell cell, int n, double radius, double cx, double cy) {
  CellBlock block;
  const auto add = [&](double r, double angle) {
    block.coordinates.insert(block.coordinates.end(), {cx + r * std::cos(angle), cy + r * std::sin(angle)});
    return block.nodes() - 1;
  };
  const double step = 2 * pi / n;
  const int centre = add(0, 0);
  for (int i = 0; i < n; ++i) add(radius, i * step);
  for (int i = 0; i < n; ++i) add(0.5 * radius, i * step);
  for (int i = 0; i < n; ++i) add(radius, (i + 0.5) * step);
  for (int i = 0; i < n; ++i) {
    const int next = (i + 1) % n;
    block.cells.push_back(cell);
    block.connectivity.insert(block.connectivity.end(), {centre, 1 + i, 1 + next});
    if (cell == Cell::Triangle6) block.connectivity.insert(block.connectivity.end(), {1 + n + i, 1 + 2 * n + i, 1 + n + next});
    block.offsets.push_back(static_cast<int>(block.connectivity.size()));
  }
  return block;
}

// The outer side of every triangle of a disc: the one that does not hold its first node.
std::vector<Side> rim(const CellBlock& block) {
  std::vector<Side> sides;
  for (int e = 0; e < block.elements(); ++e) {
    const auto& info = cellInfo(block.cells[e]).sideNodes;
    for (std::size_t s = 0; s < info.size(); ++s)
      if (info[s][0] != 0 && info[s][1] != 0) sides.push_back({e, static_cast<int>(s)});
  }
  return sides;
}

// The side of the only element that lies on y = 0.
Side bottomOf(const CellBlock& block) {
  const auto& info = cellInfo(block.cells[0]).sideNodes;
  for (std::size_t s = 0; s < info.size(); ++s)
    if (block.point(info[s][0])[1] == 0 && block.point(info[s][1])[1] == 0) return {0, static_cast<int>(s)};
  return {-1, -1};
}

}  // namespace

TEUCHOS_UNIT_TEST(Loads, SpreadsTractionOverAStraightSideBySimpsonsRule) {
  for (Cell cell : sample::cells()) {
    const CellBlock block = sample::axisParallel(cell, 3.0, 1.0);
    const Side side = bottomOf(block);
    const Vector forces = sideForces(block, {side}, traction(2.0, -5.0));
    const std::vector<int> nodes = block.nodesOf(side);
    const std::vector<double> share = nodes.size() == 2 ? std::vector<double>{0.5, 0.5} : std::vector<double>{1. / 6, 1. / 6, 4. / 6};
    Vector expected = Vector::Zero(forces.size());
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      expected[2 * nodes[a]] = share[a] * 3.0 * 2.0;
      expected[2 * nodes[a] + 1] = share[a] * 3.0 * -5.0;
    }
    TEST_COMPARE((forces - expected).norm(), <, 1e-14 * expected.norm());
  }
}

TEUCHOS_UNIT_TEST(Loads, PushesIntoTheBodyWithPositivePressure) {
  for (Cell cell : sample::cells()) {
    const CellBlock block = sample::axisParallel(cell, 3.0, 1.0);
    const Point sum = resultant(block, sideForces(block, {bottomOf(block)}, pressure(2.0)));
    TEST_COMPARE(std::abs(sum[0]), <, 1e-14);
    TEST_FLOATING_EQUALITY(sum[1], 6.0, 1e-14);  // upwards, from below
    TEST_FLOATING_EQUALITY(sum[2], 9.0, 1e-14);  // at x = 1.5
  }
}

TEUCHOS_UNIT_TEST(Loads, BalancesPressureAroundAClosedCircle) {
  for (Cell cell : {Cell::Triangle3, Cell::Triangle6}) {
    const CellBlock block = disc(cell, 7, 2.0, 10.0, -3.0);
    const std::vector<Side> sides = rim(block);
    TEST_EQUALITY(sides.size(), 7u);
    const Vector forces = sideForces(block, sides, pressure(1e3));
    const Point sum = resultant(block, forces);
    TEST_COMPARE(forces.norm(), >, 1e3);
    for (double component : sum) TEST_COMPARE(std::abs(component), <, 1e-12 * forces.norm() * 10);
  }
}

TEUCHOS_UNIT_TEST(Loads, GivesPressureOnAnArcTheForceOfItsChord) {
  // The integral of n ds between two points is independent of the path.
  const CellBlock block = disc(Cell::Triangle6, 8, 2.0, 0.0, 0.0);
  std::vector<Side> half = rim(block);
  half.resize(4);  // the upper half
  const Point sum = resultant(block, sideForces(block, half, pressure(3.0)));
  TEST_COMPARE(std::abs(sum[0]), <, 1e-14);
  TEST_FLOATING_EQUALITY(sum[1], -12.0, 1e-14);  // pressure x diameter, downwards
  TEST_COMPARE(std::abs(sum[2]), <, 1e-13);
}

TEUCHOS_UNIT_TEST(Loads, GivesTractionOnACurvedSideTheForceOfItsLength) {
  const CellBlock block = disc(Cell::Triangle6, 6, 1.0, 0.0, 0.0);
  const Side side = rim(block).front();
  const std::vector<int> nodes = block.nodesOf(side);
  // Length of the parabola through the three nodes, by the midpoint rule on many pieces.
  const Point p = block.point(nodes[0]), q = block.point(nodes[1]), m = block.point(nodes[2]);
  const int pieces = 20000;
  double length = 0;
  for (int i = 0; i < pieces; ++i) {
    const double s = -1 + 2 * (i + 0.5) / pieces;
    const double dx = (s - 0.5) * p[0] + (s + 0.5) * q[0] - 2 * s * m[0], dy = (s - 0.5) * p[1] + (s + 0.5) * q[1] - 2 * s * m[1];
    length += std::hypot(dx, dy) * 2 / pieces;
  }
  const Point sum = resultant(block, sideForces(block, {side}, traction(4.0, -1.0)));
  // The length element is the root of a polynomial: four Gauss points leave 1e-6 on a side that turns by 60 degrees.
  TEST_FLOATING_EQUALITY(sum[0], 4.0 * length, 2e-6);
  TEST_FLOATING_EQUALITY(sum[1], -1.0 * length, 2e-6);
  TEST_FLOATING_EQUALITY(length, pi / 3, 2e-3);
}

TEUCHOS_UNIT_TEST(Loads, OfAxisymmetricBodiesAreThoseOfTheWholeCircle) {
  for (Cell cell : sample::cells()) {
    // The bottom of a cylinder of radius 3: a disc, its node on the axis included.
    CellBlock block = sample::axisParallel(cell, 3.0, 1.0);
    block.axisymmetric = true;
    const Point disc = resultant(block, sideForces(block, {bottomOf(block)}, pressure(2.0)));
    TEST_FLOATING_EQUALITY(disc[1], 2.0 * pi * 9.0, 1e-14);
    TEST_COMPARE(std::abs(disc[0]), <, 1e-14);
    // Weight by Pappus; under a radial body force the radial magnitudes summed over the circle.
    const double area = sample::isTriangle(cell) ? 1.5 : 3.0, centroid = sample::isTriangle(cell) ? 1.0 : 1.5;
    const Point weight = resultant(block, bodyForces(block, bodyForce(0.5, -9.81)));
    TEST_FLOATING_EQUALITY(weight[1], -9.81 * 2 * pi * centroid * area, 1e-14);
    TEST_FLOATING_EQUALITY(weight[0], 0.5 * 2 * pi * centroid * area, 1e-14);
  }
  // A traction along the axis on a cone: pi (r0 + r1) times the slant.
  CellBlock cone = sample::distorted(Cell::Quadrilateral4);
  cone.axisymmetric = true;
  const double slant = std::hypot(1.8, 0.6), radii = 0.3 + 2.1;
  TEST_FLOATING_EQUALITY(resultant(cone, sideForces(cone, {{0, 0}}, traction(0, 4.0)))[1], 4.0 * pi * radii * slant, 1e-14);
}

TEUCHOS_UNIT_TEST(Loads, SpreadsBodyForceByTheIntegralsOfShapeFunctions) {
  // Known for affine cells, as fractions of the area.
  const std::map<Cell, std::vector<double>> shares{
      {Cell::Triangle3, {1. / 3, 1. / 3, 1. / 3}},
      {Cell::Triangle6, {0, 0, 0, 1. / 3, 1. / 3, 1. / 3}},
      {Cell::Quadrilateral4, {0.25, 0.25, 0.25, 0.25}},
      {Cell::Quadrilateral8, {-1. / 12, -1. / 12, -1. / 12, -1. / 12, 1. / 3, 1. / 3, 1. / 3, 1. / 3}},
      {Cell::Quadrilateral9, {1. / 36, 1. / 36, 1. / 36, 1. / 36, 1. / 9, 1. / 9, 1. / 9, 1. / 9, 4. / 9}}};
  for (const auto& [cell, share] : shares) {
    const CellBlock block = sample::axisParallel(cell, 3.0, 2.0);
    const double area = sample::isTriangle(cell) ? 3.0 : 6.0;
    const Vector forces = bodyForces(block, bodyForce(1.5, -9.81));
    for (int i = 0; i < block.nodes(); ++i) {
      TEST_COMPARE(std::abs(forces[2 * i] - 1.5 * area * share[i]), <, 1e-13);
      TEST_COMPARE(std::abs(forces[2 * i + 1] + 9.81 * area * share[i]), <, 1e-13);
    }
  }
}

TEUCHOS_UNIT_TEST(Loads, GivesBodyForceTheWeightOfADistortedElement) {
  for (Cell cell : sample::cells()) {
    const CellBlock block = sample::distorted(cell);
    const int n = sample::isTriangle(cell) ? 3 : 4;
    const Point sum = resultant(block, bodyForces(block, bodyForce(0, -1)));
    // Centroid of a polygon.
    double area = 0, momentX = 0;
    for (int i = 0; i < n; ++i) {
      const Point p = block.point(i), q = block.point((i + 1) % n);
      const double cross = p[0] * q[1] - p[1] * q[0];
      area += 0.5 * cross;
      momentX += cross * (p[0] + q[0]) / 6;
    }
    TEST_COMPARE(std::abs(sum[0]), <, 1e-14);
    TEST_FLOATING_EQUALITY(sum[1], -area, 1e-13);
    TEST_FLOATING_EQUALITY(sum[2], -momentX, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(Loads, ThatDependOnThePlaceAreIntegratedAgainstTheShapeFunctions) {
  // Resultant of b = (x y, x^2) on the square [0, 1]^2, and its moment, by hand: (1/4, 1/3, 1/4 - 1/6); of t = (y^3, y) on x = 1.
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    Box box;
    box.nx = box.ny = 3;
    box.cell = cell;
    const Mesh mesh = boxes({box});
    Load force;
    force.kind = Load::Kind::BodyForce;
    force.expressions = {Expression("x*y"), Expression("x^2")};
    const Point b = resultant(mesh, bodyForces(mesh, force));
    TEST_FLOATING_EQUALITY(b[0], 0.25, 1e-13);
    TEST_FLOATING_EQUALITY(b[1], 1.0 / 3, 1e-13);
    TEST_FLOATING_EQUALITY(b[2], 0.25 - 1.0 / 6, 1e-13);
    Load traction;
    traction.expressions = {Expression("x*y^3"), Expression("y")};
    const Point t = resultant(mesh, sideForces(mesh, mesh.sideGroups.at("body_right"), traction));
    TEST_FLOATING_EQUALITY(t[0], 0.25, 1e-13);
    TEST_FLOATING_EQUALITY(t[1], 0.5, 1e-13);
    TEST_FLOATING_EQUALITY(t[2], 0.5 - 0.2, 1e-13);
    Load pressed;
    pressed.kind = Load::Kind::Pressure;
    pressed.expressions = {Expression("y^2")};
    TEST_FLOATING_EQUALITY(resultant(mesh, sideForces(mesh, mesh.sideGroups.at("body_right"), pressed))[0], -1.0 / 3, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(Loads, OfConstantExpressionsAreThoseOfNumbers) {
  // on curved sides, too
  const CellBlock block = disc(Cell::Triangle6, 12, 2.0, 1.0, -1.0);
  std::vector<Side> sides;
  for (int e = 0; e < block.elements(); ++e) sides.push_back({e, 1});
  Load load = traction(0, 0);
  load.expressions = {Expression("2"), Expression("-3")};
  // the length of a curved side is the integral of a square root: two rules agree to their accuracy
  TEST_COMPARE((sideForces(block, sides, load) - sideForces(block, sides, traction(2, -3))).norm(), <, 1e-5);
  Load push = pressure(0);
  push.expressions = {Expression("5")};
  TEST_COMPARE((sideForces(block, sides, push) - sideForces(block, sides, pressure(5))).norm(), <, 1e-13);
}

TEUCHOS_UNIT_TEST(Loads, OneNoteNamesAllPointForces) {
  ElasticModel model;
  TEST_ASSERT(loadNotes(model).empty());
  for (int i = 1; i <= 5; ++i) {
    Load load{Load::Kind::PointForce, "", {1, 0, 0}};
    load.path = "Boundary Conditions/push " + std::to_string(i);
    model.loads.push_back(load);
    const std::vector<std::string> notes = loadNotes(model);
    TEST_EQUALITY(notes.size(), 1u);
    const std::string more = " and " + std::to_string(i - 3) + " more";
    TEST_EQUALITY(notes[0].find(more) != std::string::npos, i > 3);
    TEST_EQUALITY(notes[0].find("push " + std::to_string(i)) != std::string::npos, i <= 3);
  }
}
