// 3D nodal rules against dense least squares, symmetry and rotation.
#include <Eigen/QR>
#include <Eigen/SVD>
#include <Teuchos_UnitTestHarness.hpp>
#include <map>
#include <random>
#include <suture/base/Point.hpp>

#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

namespace {

/// The unit cube as one body, b0.
Mesh cube(int n = 2, Cell cell = Cell::Hexahedron8) {
  Box box;
  box.name = "b0";
  box.nx = box.ny = box.nz = n;
  box.cell = cell;
  Mesh mesh = boxes({box});
  assignBodies(mesh, {"b0"});
  return mesh;
}

Point times(const Matrix& m, const Point& p) {
  const Vector image = m * Eigen::Map<const Vector>(p.data(), 3);
  return {image[0], image[1], image[2]};
}

int nodeAt(const Mesh& mesh, const Point& place) {
  for (int i = 0; i < mesh.nodes(); ++i)
    if (norm(minus(mesh.point(i), place)) < 1e-9) return i;
  return -1;
}

/// Part of a node's displacement that its rule prescribes.
Vector given(const NodeRule& rule) {
  Vector u = Vector::Zero(3);
  for (int k = 0; k < 3; ++k)
    if (rule.fixed[k]) u += rule.value[k] * Eigen::Map<const Vector>(rule.axes[k].data(), 3);
  return u;
}

/// The projection on the directions that a rule fixes.
Matrix heldBy(const NodeRule& rule) {
  Matrix p = Matrix::Zero(3, 3);
  for (int k = 0; k < 3; ++k)
    if (rule.fixed[k]) p += Eigen::Map<const Vector>(rule.axes[k].data(), 3) * Eigen::Map<const Vector>(rule.axes[k].data(), 3).transpose();
  return p;
}

int fixedOf(const NodeRule& rule) { return rule.fixed[0] + rule.fixed[1] + rule.fixed[2]; }

bool isCartesian(const NodeRule& rule) { return axesOf(rule, 3) == Matrix::Identity(3, 3); }

Matrix rotation(const Point& axis, double angle) {
  const Eigen::Vector3d a = Eigen::Map<const Eigen::Vector3d>(axis.data()).normalized();
  Eigen::Matrix3d turned;
  turned << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return Eigen::Matrix3d::Identity() + std::sin(angle) * turned + (1 - std::cos(angle)) * turned * turned;
}

}  // namespace

// Rollers on the three sides of a sheared cube, and components given there: at each node the rule fixes as many directions as meet there,
// at any angles.
TEUCHOS_UNIT_TEST(RulesInSpace, GiveTheLeastSquaresSolutionOfOneToThreeObliqueDirections) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> some(-0.6, 0.6);
  for (int trial = 0; trial < 40; ++trial) {
    Matrix shape = Matrix::Identity(3, 3);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) shape(i, j) += trial == 0 ? 0.0 : some(generator);
    if (shape.determinant() < 0.1) continue;
    const Matrix outward = shape.inverse().rowwise().normalized();
    if (trial == 0 || outward.row(0).dot(outward.row(1)) > 0.7) continue;  // sides nearly in one plane count as one
    Mesh mesh = cube(1);
    moveAll(mesh, [&](Point p) { return times(shape, p); });
    const int given0 = (trial + 2) % 3;  // z of the straight cube, where x and y would be given twice
    const double value = 0.3;
    // The normals are the rows of the inverse: left is x = 0, front y = 0, bottom z = 0 before the shear.
    const Matrix normals = shape.inverse().rowwise().normalized();
    if (normals.row(0).dot(normals.row(1)) > 0.7) continue;  // sides that meet at less than 45 degrees share one normal
    const Constraints constraints = buildConstraints(
        mesh, {Condition::displacement("b0_top", {value}, {given0}), Condition::bilateral("b0_left"), Condition::bilateral("b0_front")},
        {});
    for (const Point corner : {Point{0, 0, 1}, Point{0, 1, 1}, Point{1, 0, 1}, Point{1, 1, 1}, Point{0, 0, 0}, Point{0, 1, 0}}) {
      std::vector<Vector> rows;
      std::vector<double> values;
      const auto add = [&](const Vector& row, double number) { rows.push_back(row), values.push_back(number); };
      if (corner[2] == 1) add(Vector::Unit(3, given0), value);
      if (corner[0] == 0) add(normals.row(0), 0.0);
      if (corner[1] == 0) add(normals.row(1), 0.0);
      Matrix a(rows.size(), 3);
      Vector b(rows.size());
      for (std::size_t r = 0; r < rows.size(); ++r) a.row(r) = rows[r], b[r] = values[r];
      const double condition = 1 / a.jacobiSvd().singularValues().minCoeff();
      const NodeRule& rule = *ruleAt(constraints, nodeAt(mesh, times(shape, corner)));
      TEST_EQUALITY(fixedOf(rule), int(rows.size()));
      const Matrix q = axesOf(rule, 3);
      TEST_COMPARE((q * q.transpose() - Matrix::Identity(3, 3)).norm(), <, 1e-14 * condition);
      const Matrix inverse = a.completeOrthogonalDecomposition().pseudoInverse();
      TEST_COMPARE((given(rule) - inverse * b).norm(), <, 1e-14 * condition * condition);
      TEST_COMPARE((heldBy(rule) - inverse * a).norm(), <, 1e-14 * condition * condition);
    }
  }
}

TEUCHOS_UNIT_TEST(RulesInSpace, KeepCartesianAxesWhereTheyDo) {
  const Mesh mesh = cube();
  const std::vector<Condition> symmetry{Condition::bilateral("b0_left"), Condition::bilateral("b0_front"),
                                        Condition::bilateral("b0_bottom")};
  const Constraints constraints = buildConstraints(mesh, symmetry, {});
  TEST_EQUALITY(constraints.rules.size(), std::size_t(27 - 8));
  for (const NodeRule& rule : constraints.rules) {
    TEST_ASSERT(isCartesian(rule));
    const Point p = mesh.point(rule.node);
    for (int k = 0; k < 3; ++k) TEST_EQUALITY(rule.fixed[k], p[k] == 0.0);
    TEST_EQUALITY(given(rule).norm(), 0.0);
  }
  // Two oblique planes whose common line is along z: x and y are fixed, in Cartesian axes.
  Mesh prism = cube();
  moveAll(prism, [](Point p) -> Point { return {p[0] + 0.3 * p[1], p[1] + 0.2 * p[0], p[2]}; });
  const Constraints line = buildConstraints(prism, {symmetry[0], symmetry[1]}, {});
  for (const NodeRule& rule : line.rules) {
    const bool onBoth = norm({prism.point(rule.node)[0], prism.point(rule.node)[1], 0}) < 1e-9;
    TEST_EQUALITY(fixedOf(rule), onBoth ? 2 : 1);
    if (onBoth) TEST_ASSERT(isCartesian(rule) && !rule.fixed[2]);
  }
}

// A quarter of a hollow cylinder with symmetry on its straight sides and rollers on its curved ones.
TEUCHOS_UNIT_TEST(RulesInSpace, AverageTheNormalsOfACurvedFaceAndKeepThoseOfSymmetryPlanes) {
  Mesh mesh = cube(8);
  moveAll(mesh, [](Point p) -> Point {
    const double r = 2 + p[1], angle = pi / 2 * (1 - p[0]);
    return {r * std::cos(angle), r * std::sin(angle), p[2]};
  });
  const Constraints constraints =
      buildConstraints(mesh, {Condition::bilateral("b0_front"), Condition::bilateral("b0_left"), Condition::bilateral("b0_bottom")}, {});
  int inner = 0, edges = 0, corners = 0;
  for (const NodeRule& rule : constraints.rules) {
    const Point p = mesh.point(rule.node);
    const double r = std::hypot(p[0], p[1]);
    const bool onCurve = std::abs(r - 2) < 1e-9, onPlane = std::abs(p[0]) < 1e-9, below = p[2] == 0.0;
    TEST_EQUALITY(fixedOf(rule), onCurve + onPlane + below);
    const Matrix held = heldBy(rule);
    if (below) TEST_COMPARE((held * Vector::Unit(3, 2) - Vector::Unit(3, 2)).norm(), <, 1e-14);
    if (onPlane) TEST_COMPARE((held * Vector::Unit(3, 0) - Vector::Unit(3, 0)).norm(), <, 1e-14);
    if (!onCurve || onPlane || std::abs(p[1]) < 1e-9) continue;  // ends have only one side
    ++inner, edges += below;
    Vector radial(3);
    radial << p[0] / r, p[1] / r, 0;
    TEST_COMPARE((held * radial - radial).norm(), <, 1e-12);
    corners += isCartesian(rule);
  }
  TEST_EQUALITY(inner, 7 * 9);
  TEST_EQUALITY(edges, 7);
  TEST_EQUALITY(corners, 0);
}

// Rules of a rotated mesh are the rotated rules.
TEUCHOS_UNIT_TEST(RulesInSpace, TurnWithTheBody) {
  Matrix shear = Matrix::Identity(3, 3);
  shear(0, 1) = 0.4, shear(1, 2) = -0.3, shear(2, 0) = 0.2;
  const Matrix turn = rotation({1, -2, 0.5}, 0.7);
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4, Cell::Tetrahedron10, Cell::Hexahedron20, Cell::Hexahedron27}) {
    Mesh mesh = cube(2, cell), turned = cube(2, cell);
    moveAll(mesh, [&](Point p) { return times(shear, p); });
    moveAll(turned, [&](Point p) { return times(turn * shear, p); });
    const std::vector<Condition> conditions{Condition::bilateral("b0_left"), Condition::bilateral("b0_front"),
                                            Condition::bilateral("b0_top")};
    const Constraints before = buildConstraints(mesh, conditions, {}), after = buildConstraints(turned, conditions, {});
    TEST_EQUALITY(before.rules.size(), after.rules.size());
    for (std::size_t i = 0; i < before.rules.size(); ++i) {
      TEST_EQUALITY(before.rules[i].node, after.rules[i].node);
      TEST_COMPARE((turn * heldBy(before.rules[i]) * turn.transpose() - heldBy(after.rules[i])).norm(), <, 1e-13);
    }
  }
}

TEUCHOS_UNIT_TEST(RulesInSpace, ReportContradictionsWithThreeComponents) {
  const Mesh mesh = cube();
  const auto saidOf = [&](const std::vector<Condition>& conditions) -> std::string {
    try {
      buildConstraints(mesh, conditions, {});
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  Condition pull = Condition::displacement("b0_right", {0.1, 0, 0.2}, {0, 1, 2});
  TEST_EQUALITY(saidOf({pull, Condition::displacement("b0_front", {0.0}, {1})}), "no error");
  SUTURE_CHECK_SAYS(saidOf({pull, Condition::displacement("b0_bottom", {0.0}, {2})}),
                    "at (1, 0, 0) the displacement along (0, 0, 1) should be 0, but 'b0_right' makes it 0.2 (likewise at 2 more nodes)");
  SUTURE_CHECK_SAYS(saidOf({pull, Condition::displacement("b0_front", {0.0}, {3})}), "expected components between 0 and 2");
}

// The force that holds a node is distributed completely to the conditions behind its rule, each along its own direction.
TEUCHOS_UNIT_TEST(RulesInSpace, ShareTheForceOfANodeAmongTheirConditions) {
  Mesh mesh = cube();
  Matrix shear = Matrix::Identity(3, 3);
  shear(0, 1) = 0.5, shear(1, 2) = -0.25, shear(2, 0) = 0.375;
  moveAll(mesh, [&](Point p) { return times(shear, p); });
  const std::vector<std::string> groups{"b0_left", "b0_front", "b0_bottom"};
  std::vector<Condition> conditions;
  for (const std::string& group : groups) conditions.push_back(Condition::bilateral(group));
  const Constraints all = buildConstraints(mesh, conditions, {});
  const Matrix normals = shear.inverse().rowwise().normalized();
  std::map<int, std::vector<const Support*>> supports;
  for (const Support& support : all.supports) supports[support.node].push_back(&support);
  TEST_EQUALITY(supports.size(), all.rules.size());
  std::map<int, int> count;
  for (const NodeRule& rule : all.rules) {
    const Vector force = heldBy(rule) * Eigen::Vector3d(3, -5, 2);  // along the fixed axes
    Vector sum = Vector::Zero(3);
    for (const Support* support : supports.at(rule.node)) {
      const Vector direction = Eigen::Map<const Vector>(support->direction.data(), 3);
      TEST_COMPARE(std::abs(std::abs(normals.row(support->condition).dot(direction)) - 1), <, 1e-14);
      sum += Eigen::Map<const Vector>(support->along.data(), 3).dot(force) * direction;
    }
    ++count[int(supports.at(rule.node).size())];
    TEST_EQUALITY(int(supports.at(rule.node).size()), fixedOf(rule));
    TEST_COMPARE((sum - force).norm(), <, 1e-13);
  }
  TEST_EQUALITY(count[1], 3 * 4);
  TEST_EQUALITY(count[2], 3 * 2);
  TEST_EQUALITY(count[3], 1);
}

// Radial, tangential and axial values about an oblique axis, some of them constant and some not: at each node the displacement whose
// components in the cylindrical axes they are.
TEUCHOS_UNIT_TEST(RulesInSpace, HaveCylindricalComponentsAboutAnObliqueAxis) {
  const Mesh mesh = cube(2, Cell::Hexahedron20);
  const Point axis{1, 2, -2}, origin{-1, 0.5, 3};
  const std::vector<std::pair<std::string, std::string>> common{{"Type", "Displacement"}, {"Group", "b0_top"}, {"Direction", "{1, 2, -2}"}};
  const auto with = [&](const std::string& name, std::vector<std::pair<std::string, std::string>> more) {
    more.insert(more.begin(), common.begin(), common.end());
    return entry(name, more);
  };
  const Constraints all = build(mesh, with("radial", {{"Along", "Radius"}, {"Axis Point", "{-1, 0.5, 3}"}, {"Value", "{0.25}"}}) +
                                          with("round", {{"Along", "Circumference"}, {"Axis Point", "{-1, 0.5, 3}"}, {"Expression", "x"}}) +
                                          with("axial", {{"Value", "{-2}"}}));
  TEST_EQUALITY(all.rules.size(), 21u);
  for (const NodeRule& rule : all.rules) {
    const Point p = mesh.point(rule.node), along = scaled(1.0 / 3.0, axis), away = minus(p, origin);
    const Point radius = unit(minus(away, scaled(dot(away, along), along))), round = cross(along, radius);
    const Vector u = given(rule);
    TEST_EQUALITY(fixedOf(rule), 3);
    const auto component = [&](const Point& d) { return d[0] * u[0] + d[1] * u[1] + d[2] * u[2]; };
    TEST_COMPARE(std::abs(component(radius) - 0.25), <, 1e-14);
    TEST_COMPARE(std::abs(component(round) - p[0]), <, 1e-14);
    TEST_COMPARE(std::abs(component(along) + 2.0), <, 1e-14);
  }
}
