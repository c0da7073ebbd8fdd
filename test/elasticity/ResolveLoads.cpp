// Total forces and moments, point forces, gravity and rotation: their resultants, and errors.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/loads/LoadList.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/elasticity/loads/ResolveLoads.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/Mesh.hpp>

#include <cmath>

using namespace suture;

namespace {

constexpr double kCircle = 6.28318530717958647692;

/// Two boxes, [0, 4] x [0, 1] and [0, 4] x [2, 3], of each cell.
Mesh twoBars(Cell cell) {
  Box lower{"lower", 0, 4, 0, 1, 8, 3}, upper{"upper", 0, 4, 2, 3, 8, 3};
  lower.cell = upper.cell = cell;
  Mesh mesh = boxes({lower, upper});
  assignBodies(mesh, {"lower", "upper"});
  return mesh;
}

ElasticModel modelOf(std::vector<Load> loads) {
  ElasticModel model;
  model.bodies = {"lower", "upper"};
  Material material{"steel", 2e5, 0.3};
  material.density = 7.0;
  model.materialOfBody = {material, material};
  model.materialOfBody[1].density = 2.0;
  model.loads = std::move(loads);
  return model;
}

/// Force and moment about a point of all nodal forces.
Point resultant(const Mesh& mesh, const Vector& forces, const Point& about = {0, 0, 0}) {
  Point sum{0, 0, 0};
  for (int i = 0; i < mesh.nodes(); ++i) {
    const Point force{forces[2 * i], forces[2 * i + 1], 0}, moment = cross(minus(mesh.point(i), about), force);
    sum = plus(sum, {force[0], force[1], moment[2]});
  }
  return sum;
}

Point resolved(const Mesh& mesh, std::vector<Load> loads, const Point& about = {0, 0, 0}) {
  ElasticModel model = modelOf(std::move(loads));
  resolveLoads(mesh, model);
  return resultant(mesh, nodalLoads(mesh, model), about);
}

std::string complaint(const Mesh& mesh, Load load) {
  load.path = "Boundary Conditions/tip";
  ElasticModel model = modelOf({load});
  try {
    resolveLoads(mesh, model);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

#define SUTURE_CHECK_NEAR(found, expected)                                                    \
  for (int k = 0; k < 3; ++k) {                                                               \
    out << "component " << k << ": " << (found)[k] << ", expected " << (expected)[k] << "\n"; \
    TEST_COMPARE(std::abs((found)[k] - (expected)[k]), <=, 1e-11 * norm(expected));           \
  }

}  // namespace

TEUCHOS_UNIT_TEST(ResolveLoads, GivesATotalForceToTheGroupsTogether) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    const Mesh mesh = twoBars(cell);
    Load load = Load::force("lower_right", {3.0, -8.0, 0});
    load.groups.push_back("lower_top");  // areas 1 and 4: the force acts at the mean of (4, 0.5) and (2, 1), weighted so
    const Point expected{3.0, -8.0, 0.0}, found = resolved(mesh, {load}, {2.4, 0.9, 0});
    SUTURE_CHECK_NEAR(found, expected);
  }
}

TEUCHOS_UNIT_TEST(ResolveLoads, GivesATotalMomentWithoutAForceAboutAnyPoint) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    const Mesh mesh = twoBars(cell);
    const Point expected{0, 0, 6.0}, found = resolved(mesh, {Load::moment("lower_right", 6.0)}, {-70.0, 11.0, 0});
    SUTURE_CHECK_NEAR(found, expected);
  }
}

TEUCHOS_UNIT_TEST(ResolveLoads, MakesTheLinearStressOfBendingOfAMoment) {
  const Mesh mesh = twoBars(Cell::Quadrilateral8);
  ElasticModel model = modelOf({Load::moment("lower_right", 6.0)});
  resolveLoads(mesh, model);
  // sigma = -M (y - 1/2) / I, I = 1/12
  for (const double y : {0.0, 0.3, 1.0}) {
    const Point traction = model.loads[0].at({4.0, y, 0});
    TEST_FLOATING_EQUALITY(traction[0] + 100.0, 100.0 - 72.0 * (y - 0.5), 1e-12);
    TEST_COMPARE(std::abs(traction[1]), <, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(ResolveLoads, PutsAPointForceOnItsNode) {
  const Mesh mesh = twoBars(Cell::Triangle3);
  const Point expected{1.0, -2.0, 4.0 * -2.0 - 1.0}, found = resolved(mesh, {Load::pointForce({4.0, 1.0, 0}, {1.0, -2.0, 0})});
  SUTURE_CHECK_NEAR(found, expected);
}

TEUCHOS_UNIT_TEST(ResolveLoads, ReportsTheNearestNode) {
  const Mesh mesh = twoBars(Cell::Triangle3);
  Load off = Load::pointForce({4.1, 1.0, 0}, {1, 0, 0});
  const std::string far = complaint(mesh, off);
  for (const char* part : {"Boundary Conditions/tip/Point: no node within", "the nearest one is (4, 1) of the body 'lower', 0.1 away"})
    TEST_ASSERT(far.find(part) != std::string::npos);
  off.tolerance = 0.2;
  TEST_EQUALITY(complaint(mesh, off), "");
}

TEUCHOS_UNIT_TEST(ResolveLoads, RequiresTheBodyWhereTwoMeet) {
  Mesh mesh = boxes({{"lower", 0, 4, 0, 1, 4, 1}, {"upper", 0, 4, 1, 2, 4, 1}});
  assignBodies(mesh, {"lower", "upper"});
  const std::string text = complaint(mesh, Load::pointForce({4.0, 1.0, 0}, {1, 0, 0}));
  TEST_ASSERT(text.find("tip/Body: is missing: at (4, 1) there are nodes of the bodies 'lower' and 'upper'") != std::string::npos);
  TEST_EQUALITY(complaint(mesh, Load::pointForce({4.0, 1.0, 0}, {1, 0, 0}, "upper")), "");
}

TEUCHOS_UNIT_TEST(ResolveLoads, WeighsBodiesByTheirDensity) {
  const Mesh mesh = twoBars(Cell::Triangle6);
  // areas of 4, densities 7 and 2, centres (2, 0.5) and (2, 2.5)
  const Point both{0, -9.81 * 36, -9.81 * 36 * 2}, one{0, -9.81 * 8, -9.81 * 8 * 2};
  const Point foundBoth = resolved(mesh, {Load::gravity({0, -9.81, 0})}),
              foundOne = resolved(mesh, {Load::gravity({0, -9.81, 0}, "upper")});
  SUTURE_CHECK_NEAR(foundBoth, both);
  SUTURE_CHECK_NEAR(foundOne, one);
}

TEUCHOS_UNIT_TEST(ResolveLoads, PullsATurningBodyAwayFromItsAxis) {
  const Mesh mesh = twoBars(Cell::Quadrilateral4);
  // mass x omega^2 x (centre - axis)
  const Point expected{28.0 * 9.0 * (2.0 - 1.0), 28.0 * 9.0 * (0.5 + 3.0), 0.0};
  const Point found = resolved(mesh, {Load::rotation({0, 0, 3.0}, {1.0, -3.0, 0}, "lower")}, {1.0, -3.0, 0});
  SUTURE_CHECK_NEAR(found, expected);
}

TEUCHOS_UNIT_TEST(ResolveLoads, PullsARingOfRevolutionOutwards) {
  Mesh mesh = boxes({{"lower", 1, 3, 0, 1, 6, 2}, {"upper", 1, 3, 2, 3, 6, 2}});
  assignBodies(mesh, {"lower", "upper"});
  makeAxisymmetric(mesh);
  // sum of magnitudes: integral of density omega^2 r 2 pi r dr
  const Point found = resolved(mesh, {Load::rotation({0, 3.0, 0}, {0, 0, 0}, "lower")});
  TEST_FLOATING_EQUALITY(found[0], 7.0 * 9.0 * kCircle * (27.0 - 1.0) / 3.0, 1e-12);
  TEST_COMPARE(std::abs(found[1]), <, 1e-10);
}

TEUCHOS_UNIT_TEST(ResolveLoads, RefusesLoadsUnfitForTheModel) {
  ElasticModel model = modelOf({Load::moment("a", 1.0), Load::gravity({1.0, 0, 0}), Load::temperature(20.0, 0.0),
                                Load::temperature(30.0, 0.0, "upper"), Load::rotation({0, 1, 0}, {0, 0, 0}, "upper")});
  model.axisymmetric = true;
  model.materialOfBody[1].density.reset();
  Problems problems;
  checkLoads(model, problems);
  std::string all;
  for (const Problem& problem : problems.list()) all += problem.path + ": " + problem.message + "\n";
  for (const char* part : {"loads/1: a Moment cannot act on a body of revolution", "loads/2/Value: radial gravity is not axisymmetric",
                           "Materials/steel/Thermal Expansion: is missing", "Materials/steel/Density: is missing: the Rotation of",
                           "already has a Temperature"}) {
    if (all.find(part) == std::string::npos) out << "'" << part << "' is not in:\n" << all;
    TEST_ASSERT(all.find(part) != std::string::npos);
  }
}
