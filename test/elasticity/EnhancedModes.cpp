// Enhanced strains: the patch test on distorted elements, bending in closed form, rank, and the limit nu -> 0.5. (More 3D tests:
// SolidStiffness. Initial states: InitialState and SolidLoads.)
#include <Eigen/LU>
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/ElementStress.hpp>
#include <suture/elasticity/MaterialLaw.hpp>

#include <cmath>
#include <memory>
#include <tuple>

#include <support/DenseAlgebra.hpp>
#include "SampleCells.hpp"

using namespace suture;

namespace enhancedmodes {

namespace {

using Field = std::function<Point(const Point&)>;

Material enhanced(double young, double poisson) {
  Material material{"m", young, poisson};
  material.enhanced = true;
  return material;
}

Matrix stiffness(const CellBlock& block, const Material& material, PlaneModel plane = PlaneModel::Strain) {
  Matrix k;
  elementStiffnesses(block, material, plane, [&](int, ConstLocalView one) { k = one; });
  return k;
}

Vector nodal(const CellBlock& block, const Field& field) {
  const int d = block.dimension;
  Vector u(d * block.nodes());
  for (int i = 0; i < block.nodes(); ++i) {
    const Point value = field(block.point(i));
    for (int k = 0; k < d; ++k) u[d * i + k] = value[std::size_t(k)];
  }
  return u;
}

CellBlock revolved(CellBlock block, double radius) {
  for (int i = 0; i < block.nodes(); ++i) block.coordinates[2 * i] += radius;
  block.axisymmetric = true;
  return block;
}

const double pi = std::acos(-1.0);

}  // namespace

TEUCHOS_UNIT_TEST(EnhancedModes, ConstantStressesOfDistortedElementsAreExact) {
  // Forces of a linear field: those of the standard element, whose strain is that of the field.
  for (const double poisson : {0.3, 0.4999}) {
    for (const PlaneModel plane : {PlaneModel::Strain, PlaneModel::Stress}) {
      const CellBlock block = sample::distorted(Cell::Quadrilateral4);
      const Vector u = nodal(block, [](const Point& p) -> Point { return {0.7 * p[0] - 0.4 * p[1], 0.9 * p[0] + 0.2 * p[1], 0.0}; });
      const Vector expected = stiffness(block, {"m", 3.0, poisson}, plane) * u;
      TEST_COMPARE((stiffness(block, enhanced(3.0, poisson), plane) * u - expected).norm(), <, 1e-12 * expected.norm());
    }
    // Axisymmetric: equal radial and hoop strains.
    const CellBlock ring = revolved(sample::distorted(Cell::Quadrilateral4), 0.2);
    const Vector u = nodal(ring, [](const Point& p) -> Point { return {0.7 * p[0], 0.9 * p[0] - 0.3 * p[1], 0.0}; });
    const Vector expected = stiffness(ring, {"m", 3.0, poisson}) * u;
    TEST_COMPARE((stiffness(ring, enhanced(3.0, poisson)) * u - expected).norm(), <, 1e-12 * expected.norm());
  }
}

TEUCHOS_UNIT_TEST(EnhancedModes, LeaveTheRigidModesAndNothingElseInTheNullSpace) {
  for (const double poisson : {-0.4, 0.0, 0.3, 0.4999})
    for (const PlaneModel plane : {PlaneModel::Strain, PlaneModel::Stress}) {
      const CellBlock block = sample::distorted(Cell::Quadrilateral4);
      const Matrix k = stiffness(block, enhanced(1.0, poisson), plane);
      const Vector turn = nodal(block, [](const Point& p) -> Point { return {-p[1], p[0], 0.0}; });
      TEST_COMPARE((k * turn).norm(), <, 1e-14 * k.norm() * turn.norm());
      const Vector eigenvalues = dense::eigenvalues(k);
      TEST_COMPARE(std::abs(eigenvalues[2]), <, 1e-13 * k.norm());
      TEST_COMPARE(eigenvalues[3], >, 1e-2);  // order of mu, for any lambda
      TEST_EQUALITY((k - k.transpose()).norm(), 0.0);
      const Matrix taken = stiffness(block, {"m", 1.0, poisson}, plane) - k;
      TEST_COMPARE(dense::eigenvalues(taken)[0], >, -1e-12 * k.norm());
    }
  for (const double poisson : {-0.4, 0.0, 0.3, 0.4999})
    for (const double radius : {0.0, 0.5, 100.0}) {  // the first at the axis
      CellBlock square = sample::axisParallel(Cell::Quadrilateral4, 1.0, 0.7);
      for (const CellBlock& block : {revolved(square, radius), revolved(sample::distorted(Cell::Quadrilateral4), radius + 0.1)}) {
        const Matrix k = stiffness(block, enhanced(1.0, poisson));
        const Vector along = nodal(block, [](const Point&) -> Point { return {0.0, 1.0, 0.0}; });
        TEST_COMPARE((k * along).norm(), <, 1e-14 * k.norm() * along.norm());
        const Vector eigenvalues = dense::eigenvalues(k);
        TEST_COMPARE(std::abs(eigenvalues[0]), <, 1e-13 * k.norm());
        TEST_COMPARE(eigenvalues[1], >, radius > 1.0 ? 1e-3 : 1e-2);  // the thin ring's hoop strain is small
        TEST_EQUALITY((k - k.transpose()).norm(), 0.0);
      }
    }
}

TEUCHOS_UNIT_TEST(EnhancedModes, BendARectangleAsABeamDoes) {
  // u = (x y, -x^2 / 2): the stress E' y alone, for any element shape. Energy E' I length.
  const double length = 7.0, height = 1.0;
  for (const double poisson : {0.0, 0.3, 0.4999})
    for (const PlaneModel plane : {PlaneModel::Strain, PlaneModel::Stress})
      for (const bool turned : {false, true}) {
        CellBlock block = sample::axisParallel(Cell::Quadrilateral4, length, height);
        Vector u = nodal(block, [&](const Point& p) -> Point {
          const double x = p[0] - length / 2, y = p[1] - height / 2;
          return {x * y, -x * x / 2, 0.0};
        });
        if (turned)
          for (int i = 0; i < block.nodes(); ++i) {
            const double c = std::cos(0.7), s = std::sin(0.7);
            const auto turn = [&](double& x, double& y) { std::tie(x, y) = std::make_tuple(c * x - s * y, s * x + c * y); };
            turn(block.coordinates[2 * i], block.coordinates[2 * i + 1]);
            turn(u[2 * i], u[2 * i + 1]);
          }
        const double young = 3.0, modulus = plane == PlaneModel::Strain ? young / (1 - poisson * poisson) : young;
        const double energy = u.dot(stiffness(block, enhanced(young, poisson), plane) * u);
        TEST_FLOATING_EQUALITY(energy, modulus * std::pow(height, 3) / 12 * length, 1e-8);
        TEST_COMPARE(u.dot(stiffness(block, {"m", young, poisson}, plane) * u), >, 10 * energy);  // the standard element
      }
}

TEUCHOS_UNIT_TEST(EnhancedModes, BendABrickAsABeamDoesAboutEveryAxis) {
  // Stress E y along x alone: u = (x y, -x^2/2 - nu (y^2 - z^2)/2, -nu y z) and its permutations.
  const double sizes[3] = {7.0, 1.0, 0.5}, young = 3.0;
  const CellBlock block = sample::brick(Cell::Hexahedron8, sizes[0], sizes[1], sizes[2]);
  for (const double nu : {0.0, 0.3, 0.4999})
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        if (i == j) continue;
        const int k = 3 - i - j;
        const Vector u = nodal(block, [&](const Point& p) -> Point {
          const double x = p[i] - sizes[i] / 2, y = p[j] - sizes[j] / 2, z = p[k] - sizes[k] / 2;
          Point value{0, 0, 0};
          value[i] = x * y;
          value[j] = -x * x / 2 - nu * (y * y - z * z) / 2;
          value[k] = -nu * y * z;
          return value;
        });
        const double energy = u.dot(stiffness(block, enhanced(young, nu)) * u);
        TEST_FLOATING_EQUALITY(energy, young * std::pow(sizes[j], 3) / 12 * sizes[i] * sizes[k], 1e-8);
        // The stress at the centre is zero; at the end of the section it is E y.
        HookesLaw<3> law(enhanced(young, nu), PlaneModel::Strain);
        ElementStress<3> stress(block, 0, referenceElement(Cell::Hexahedron8, Rule::Stiffness), law, u, {});
        stress.at(0);
        StressVector<3> expected = StressVector<3>::Zero();
        expected[i] = young * (stress.map().place()[j] - sizes[j] / 2);
        TEST_COMPARE((stress.stress() - expected).norm(), <, 1e-7 * std::abs(expected[i]));
      }
}

TEUCHOS_UNIT_TEST(EnhancedModes, BendABrickOfAnyMaterialAsABeamDoes) {
  // A stress y along x alone, strains C y with C a column of the compliance: they are compatible for any law.
  const double length = 5.0, height = 1.0, width = 0.6;
  const CellBlock block = sample::brick(Cell::Hexahedron8, length, height, width);
  const Matrix random = dense::random(6, 6, 5);
  Material material = enhanced(3.0, 0.3);
  const ElasticStiffness stiff = random * random.transpose() + 3.0 * Matrix::Identity(6, 6);
  material.law = std::make_shared<GivenLaw>(stiff);
  const Eigen::Matrix<double, 6, 1> c = stiff.inverse().col(0);  // xx, yy, zz, xy, yz, xz
  const Vector u = nodal(block, [&](const Point& p) -> Point {
    const double x = p[0] - length / 2, y = p[1] - height / 2, z = p[2] - width / 2;
    return {c[0] * x * y + c[3] * y * y / 2 + c[5] * y * z / 2, (c[1] * y * y - c[0] * x * x - c[2] * z * z - c[5] * x * z) / 2,
            c[2] * y * z + c[4] * y * y / 2 + c[5] * x * y / 2};
  });
  const double energy = c[0] * std::pow(height, 3) / 12 * length * width;
  TEST_FLOATING_EQUALITY(u.dot(stiffness(block, material) * u), energy, 1e-10);
}

TEUCHOS_UNIT_TEST(EnhancedModes, BendADiscAsAPlateDoes) {
  // u = (r z, -r^2 / 2 - nu / (1 - nu) z^2): stresses E / (1 - nu) z along radius and hoop. Exact except for the mean of the radius.
  const double inner = 4.0, width = 1.0, height = 0.3, young = 3.0;
  for (const double nu : {0.0, 0.3, 0.4999}) {
    const CellBlock block = revolved(sample::axisParallel(Cell::Quadrilateral4, width, height), inner);
    const Vector u = nodal(block, [&](const Point& p) -> Point {
      const double z = p[1] - height / 2;
      return {p[0] * z, -p[0] * p[0] / 2, 0.0};
    });
    const double area = pi * (std::pow(inner + width, 2) - inner * inner);
    const double exact = 2 * young / (1 - nu) * std::pow(height, 3) / 12 * area;
    TEST_FLOATING_EQUALITY(u.dot(stiffness(block, enhanced(young, nu)) * u), exact, 1e-2);
    TEST_COMPARE(u.dot(stiffness(block, {"m", young, nu}) * u), >, 1.5 * exact);
  }
}

TEUCHOS_UNIT_TEST(EnhancedModes, LeaveOneConstraintOfIncompressibility) {
  // One eigenvalue of the order of lambda, as in elements with one pressure.
  const Material rubber = enhanced(1.0, 0.499999);
  for (const CellBlock& block : {sample::distorted(Cell::Quadrilateral4), revolved(sample::distorted(Cell::Quadrilateral4), 1.0)})
    TEST_EQUALITY((dense::eigenvalues(stiffness(block, rubber)).array() > 1e3).count(), 1);
  TEST_EQUALITY((dense::eigenvalues(stiffness(sample::distortedSolid(Cell::Hexahedron8), rubber)).array() > 1e3).count(), 1);
}

TEUCHOS_UNIT_TEST(EnhancedModes, FollowATemperatureThatBendsThem) {
  // e_0 = alpha x in all directions: u = alpha (x^2 / 2 - (y^2 + z^2) / 2, x y, x z) leaves no stress anywhere.
  ElasticModel model;
  model.dimension = 3;
  model.bodies = {"body"};
  model.loads = {Load::temperature(0.0, 0.0)};
  model.loads[0].expressions = {Expression("x - 0.3")};
  Material material = enhanced(2e5, 0.3);
  material.expansion = 1e-3;
  const CellBlock block = sample::brick(Cell::Hexahedron8, 2.0, 1.0, 0.7);
  const InitialState initial(model, 0);
  const auto materialOf = [&](int) -> const Material& { return material; };
  const Vector u = nodal(block, [&](const Point& p) -> Point {
    const double x = p[0] - 0.3;
    return {1e-3 * (x * x - p[1] * p[1] - p[2] * p[2]) / 2, 1e-3 * x * p[1], 1e-3 * x * p[2]};
  });
  const Vector force = initialForces(block, materialOf, PlaneModel::Strain, initial);
  TEST_COMPARE((stiffness(block, material) * u - force).norm(), <, 1e-10 * force.norm());
  const HookesLaw<3> law(material, PlaneModel::Strain);
  ElementStress<3> stress(block, 0, referenceElement(Cell::Hexahedron8, Rule::Recovery), law, u, initial);
  for (int q = 0; q < 8; ++q) {
    stress.at(q);
    TEST_COMPARE(stress.stress().norm(), <, 1e-8 * 2e5 * 1e-3);
  }
}

}  // namespace enhancedmodes
