#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <suture/answer/error/ErrorNorms.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/mesh/Generators.hpp>

using namespace suture;

namespace {

const Material material{"m", 2.0, 0.25};

Mesh square(Cell cell) {
  Box box;
  box.nx = box.ny = 3;
  box.cell = cell;
  return boxes({box});
}

BodyErrors against(const ExactFields& exact, const Mesh& mesh, const Vector& displacement, PlaneModel plane = PlaneModel::Strain) {
  return bodyErrors(
      mesh, exact, [](int) -> const Material& { return material; }, plane, displacement);
}

const std::vector<Cell> allCells{Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9};

ExactSolution read(const std::vector<std::string>& settings, Problems& problems, int dimension = 2) {
  const auto file = parseScene("<ParameterList/>", "scene.xml", Schema().list("Exact Solution", exactSolutionSchema()), settings);
  return readExactSolution(file.parameters->sublist("Exact Solution"), {"upper", "lower"}, dimension, {{"q", 3.0}}, problems);
}

}  // namespace

TEUCHOS_UNIT_TEST(ErrorNorms, OfAZeroFieldAreThoseOfTheExactOne) {
  // u = (x y, x^2 - 2): integrals over the unit square 1/9 + (1/5 - 4/3 + 4)
  ExactFields exact;
  exact.displacement = {Expression("x*y"), Expression("x^2 - 2")};
  for (const Cell cell : allCells) {
    const Mesh mesh = square(cell);
    const BodyErrors errors = against(exact, mesh, Vector::Zero(2 * mesh.nodes()));
    TEST_FLOATING_EQUALITY(errors.displacement.error, 1.0 / 9 + 1.0 / 5 - 4.0 / 3 + 4, 1e-13);
    TEST_FLOATING_EQUALITY(errors.displacement.exact, errors.displacement.error, 1e-13);
    TEST_EQUALITY(errors.energy.exact, 0.0);
  }
}

TEUCHOS_UNIT_TEST(ErrorNorms, EnergyIsThatOfHookesLaw) {
  // s = (x, 0, y) against u = 0. Hooke: plane stress e_xx = x / E, gamma = y / mu; plane strain e_xx = (1 - nu^2) x / E.
  ExactFields exact;
  exact.stress = {Expression("x"), Expression("0"), Expression("y")};
  const double e = material.young, nu = material.poisson, shear = e / (2 * (1 + nu));
  for (const Cell cell : allCells) {
    const Mesh mesh = square(cell);
    const Vector zero = Vector::Zero(2 * mesh.nodes());
    TEST_FLOATING_EQUALITY(against(exact, mesh, zero, PlaneModel::Stress).energy.error, (1 / e + 1 / shear) / 3, 1e-13);
    TEST_FLOATING_EQUALITY(against(exact, mesh, zero, PlaneModel::Strain).energy.error, ((1 - nu * nu) / e + 1 / shear) / 3, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(ErrorNorms, VanishForTheFieldItself) {
  // u = (0.1 x + 0.2 y, 0.3 x) in plane stress
  const double e = material.young, nu = material.poisson, factor = e / (1 - nu * nu), shear = e / (2 * (1 + nu));
  ExactFields exact;
  exact.displacement = {Expression("0.1*x + 0.2*y"), Expression("0.3*x")};
  exact.stress = {Expression("a", {{"a", 0.1 * factor}}), Expression("a", {{"a", 0.1 * nu * factor}}),
                  Expression("a", {{"a", 0.5 * shear}})};
  for (const Cell cell : allCells) {
    const Mesh mesh = square(cell);
    Vector u(2 * mesh.nodes());
    for (int node = 0; node < mesh.nodes(); ++node) {
      const Point p = mesh.point(node);
      u[2 * node] = 0.1 * p[0] + 0.2 * p[1];
      u[2 * node + 1] = 0.3 * p[0];
    }
    const BodyErrors errors = against(exact, mesh, u, PlaneModel::Stress);
    TEST_COMPARE(errors.displacement.error, <, 1e-30);
    TEST_COMPARE(errors.energy.error, <, 1e-28);
    TEST_FLOATING_EQUALITY(errors.energy.exact, 0.1 * 0.1 * factor + 0.5 * 0.5 * shear, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(ErrorNorms, SideMassIsTheKnownMatrix) {
  Matrix two(2, 2), three(3, 3);
  two << 2, 1, 1, 2;
  three << 4, -1, 2, -1, 4, 2, 2, 2, 16;
  const double length = 5.0;  // length of (3, 4)
  TEST_COMPARE((sideMass({{1, 1, 0}, {4, 5, 0}}, 2) - length / 6 * two).norm(), <, 1e-13);
  TEST_COMPARE((sideMass({{1, 1, 0}, {4, 5, 0}, {2.5, 3, 0}}, 2) - length / 30 * three).norm(), <, 1e-13);
}

TEUCHOS_UNIT_TEST(ErrorNorms, AlongASideAreIntegralsOverItsLength) {
  // p = x on a side from (0, 0) to (3, 4), x = 3 s / 5: integral of x^2 ds = 15
  const SquaredNorms zero = sideErrors({{0, 0, 0}, {3, 4, 0}}, 2, Vector::Zero(2), Expression("x"));
  TEST_FLOATING_EQUALITY(zero.error, 15.0, 1e-13);
  TEST_FLOATING_EQUALITY(zero.exact, 15.0, 1e-13);
  Vector values(2);
  values << 0, 3;
  TEST_COMPARE(sideErrors({{0, 0, 0}, {3, 4, 0}}, 2, values, Expression("x")).error, <, 1e-28);
}

TEUCHOS_UNIT_TEST(ErrorNorms, OverAFaceAreIntegralsOverItsArea) {
  // p = x + y on the triangle (0, 0, 0), (1, 0, 1), (0, 1, 0), where a unit area in x and y has the surface sqrt(2): integral of p^2 1/4
  // sqrt(2).
  const std::vector<Point> triangle{{0, 0, 0}, {1, 0, 1}, {0, 1, 0}};
  const SquaredNorms zero = sideErrors(triangle, 3, Vector::Zero(3), Expression("x + y"));
  TEST_FLOATING_EQUALITY(zero.error, std::sqrt(2.0) / 4, 1e-13);
  Matrix mass(3, 3);
  mass << 2, 1, 1, 1, 2, 1, 1, 1, 2;
  TEST_COMPARE((sideMass(triangle, 3) - std::sqrt(2.0) / 24 * mass).norm(), <, 1e-14);
  Vector values(3);
  values << 0, 1, 1;
  TEST_COMPARE(sideErrors(triangle, 3, values, Expression("x + y")).error, <, 1e-28);
}

TEUCHOS_UNIT_TEST(ExactSolution, HasThreeAndSixComponentsIn3D) {
  std::vector<std::string> settings;
  for (const char* name :
       {"Displacement x", "Displacement y", "Displacement z", "Stress xx", "Stress yy", "Stress zz", "Stress xy", "Stress yz", "Stress xz"})
    settings.push_back("Exact Solution/" + std::string(name) + "=" + std::to_string(settings.size()) + "*x");
  Problems problems;
  const ExactSolution exact = read(settings, problems, 3);
  problems.throwIfAny();
  for (std::size_t k = 0; k < 3; ++k) TEST_EQUALITY(exact.ofBody[0].displacement.at(k).at({2, 0, 0}), 2.0 * double(k));
  for (std::size_t k = 0; k < 6; ++k) TEST_EQUALITY(exact.ofBody[0].stress.at(k).at({1, 0, 0}), 3.0 + double(k));
  Problems missing, plane;
  settings.pop_back();
  read(settings, missing, 3);
  TEST_EQUALITY(missing.list().at(0).path, "Exact Solution/Stress xz");
  read(settings, plane, 2);
  TEST_EQUALITY(plane.list().at(0).path, "Exact Solution/Displacement z");
  TEST_EQUALITY(plane.list().at(0).message, "needs a 3D scene (Model = Solid); this one is 2D");
}

TEUCHOS_UNIT_TEST(ExactSolution, MayDifferFromBodyToBody) {
  Problems problems;
  const ExactSolution exact = read({"Exact Solution/Displacement x=x", "Exact Solution/Displacement y=y",
                                    "Exact Solution/Bodies/lower/Displacement x=q*x", "Exact Solution/Bodies/lower/Displacement y=0"},
                                   problems);
  problems.throwIfAny();
  TEST_ASSERT(exact.hasDisplacement() && !exact.hasStress() && !exact.pressure && !exact.empty());
  TEST_EQUALITY(exact.ofBody[0].displacement[0].at({2, 0, 0}), 2.0);
  TEST_EQUALITY(exact.ofBody[1].displacement[0].at({2, 0, 0}), 6.0);
  TEST_ASSERT(read({}, problems).empty());
}

TEUCHOS_UNIT_TEST(ExactSolution, IsCompleteOrAbsent) {
  Problems problems;
  read({"Exact Solution/Displacement x=x", "Exact Solution/Stress yy=qq", "Exact Solution/Bodies/uper/Stress xx=1"}, problems);
  std::string all;
  for (const Problem& problem : problems.list()) all += problem.path + ": " + problem.message + "\n";
  out << all;
  for (const char* part : {"Exact Solution/Displacement y: is missing: expected all of Displacement x, Displacement y, or none",
                           "Exact Solution/Stress xx: is missing", "Exact Solution/Stress xy: is missing",
                           "Exact Solution/Stress yy: 'qq': unknown: 'qq' (did you mean 'q'?)",
                           "Exact Solution/Bodies/uper: no such body 'uper'. Did you mean 'upper'?"})
    TEST_ASSERT(all.find(part) != std::string::npos);
  Problems other;
  read({"Exact Solution/Bodies/lower/Displacement x=0", "Exact Solution/Bodies/lower/Displacement y=0"}, other);
  TEST_EQUALITY(other.list().size(), 1u);
  TEST_EQUALITY(other.list()[0].message, "the exact displacement is given for lower but not for upper; errors need it for every body");
}
