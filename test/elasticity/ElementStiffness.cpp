#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/ElasticModel.hpp>

#include <support/DenseAlgebra.hpp>
#include "SampleCells.hpp"

using namespace suture;

namespace {

const Material rock{"rock", 0.52e10, 0.18};

Matrix stiffness(const CellBlock& block, const Material& material, PlaneModel plane) {
  Matrix k;
  elementStiffnesses(block, material, plane, [&](int, ConstLocalView one) { k = one; });
  return k;
}

// Node-major vector of a displacement field.
template <typename Field>
Vector nodal(const CellBlock& block, const Field& field) {
  Vector u(2 * block.nodes());
  for (int i = 0; i < block.nodes(); ++i) {
    const Point p = block.point(i);
    const std::array<double, 2> value = field(p[0], p[1]);
    u[2 * i] = value[0];
    u[2 * i + 1] = value[1];
  }
  return u;
}

}  // namespace

TEUCHOS_UNIT_TEST(ElementStiffness, IsTheClosedFormOfALinearTriangle) {
  const CellBlock block = sample::distorted(Cell::Triangle3);
  // B from the cofactors of the triangle, D written out for plane strain.
  double x[3], y[3];
  for (int i = 0; i < 3; ++i) {
    x[i] = block.point(i)[0];
    y[i] = block.point(i)[1];
  }
  const double area = 0.5 * ((x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]));
  Eigen::Matrix<double, 3, 6> b = Eigen::Matrix<double, 3, 6>::Zero();
  for (int i = 0; i < 3; ++i) {
    const double dx = (y[(i + 1) % 3] - y[(i + 2) % 3]) / (2 * area), dy = (x[(i + 2) % 3] - x[(i + 1) % 3]) / (2 * area);
    b(0, 2 * i) = dx;
    b(1, 2 * i + 1) = dy;
    b(2, 2 * i) = dy;
    b(2, 2 * i + 1) = dx;
  }
  const double nu = rock.poisson, factor = rock.young / ((1 + nu) * (1 - 2 * nu));
  Eigen::Matrix3d d;
  d << 1 - nu, nu, 0, nu, 1 - nu, 0, 0, 0, 0.5 - nu;
  d *= factor;
  const Matrix expected = area * b.transpose() * d * b;
  TEST_COMPARE((stiffness(block, rock, PlaneModel::Strain) - expected).norm(), <, 1e-14 * expected.norm());
}

TEUCHOS_UNIT_TEST(ElementStiffness, IsThePublishedOneOfTheUnitSquareInPlaneStress) {
  // Row 1 of the 8 x 8 matrix in O. Sigmund, "A 99 line topology optimization code written in Matlab" (2001), E = 1, nu = 0.3.
  const double nu = 0.3;
  Vector row(8);
  row << 0.5 - nu / 6, 0.125 + nu / 8, -0.25 - nu / 12, -0.125 + 3 * nu / 8, -0.25 + nu / 12, -0.125 - nu / 8, nu / 6, 0.125 - 3 * nu / 8;
  row /= 1 - nu * nu;
  const Matrix k = stiffness(sample::axisParallel(Cell::Quadrilateral4, 1, 1), {"unit", 1.0, nu}, PlaneModel::Stress);
  TEST_COMPARE((k.row(0).transpose() - row).norm(), <, 1e-15);
}

TEUCHOS_UNIT_TEST(ElementStiffness, HasTheRigidModesAndNothingElseInItsNullSpace) {
  for (Cell cell : sample::cells())
    for (const CellBlock& block : {sample::distorted(cell), sample::curved(cell)}) {
      const Matrix k = stiffness(block, rock, PlaneModel::Strain);
      Matrix rigid(k.rows(), 3);
      rigid.col(0) = nodal(block, [](double, double) { return std::array<double, 2>{1, 0}; });
      rigid.col(1) = nodal(block, [](double, double) { return std::array<double, 2>{0, 1}; });
      rigid.col(2) = nodal(block, [](double x, double y) { return std::array<double, 2>{-y, x}; });
      TEST_COMPARE((k * rigid).norm(), <, 1e-14 * k.norm() * rigid.norm());
      const Vector eigenvalues = dense::eigenvalues(k);
      TEST_COMPARE(std::abs(eigenvalues[2]), <, 1e-12 * k.norm());
      TEST_COMPARE(eigenvalues[3], >, 1e-4 * k.norm());
      TEST_EQUALITY((k - k.transpose()).norm(), 0.0);
    }
}

// Every cell, displacement and mixed, except the mixed 3-node triangle, which does not exist.
template <typename Take>
void forEachElement(const Take& take) {
  for (Cell cell : sample::cells())
    for (ElementForm form : {ElementForm::Displacement, ElementForm::Mixed})
      if (cell != Cell::Triangle3 || form != ElementForm::Mixed)
        for (const CellBlock& block : {sample::distorted(cell), sample::curved(cell)}) take(cell, form, block);
}

TEUCHOS_UNIT_TEST(ElementStiffness, OfMixedElementsHasTheRigidModesAndNothingElseInItsNullSpace) {
  for (double poisson : {-0.4, 0.0, 0.3, 0.4999})
    forEachElement([&](Cell cell, ElementForm form, const CellBlock& block) {
      const Matrix k = stiffness(block, {"m", 1.0, poisson, form}, PlaneModel::Strain);
      const Vector turn = nodal(block, [](double x, double y) { return std::array<double, 2>{-y, x}; });
      TEST_COMPARE((k * turn).norm(), <, 1e-14 * k.norm() * turn.norm());
      const Vector eigenvalues = dense::eigenvalues(k);
      TEST_COMPARE(std::abs(eigenvalues[2]), <, 1e-13 * k.norm());
      TEST_COMPARE(eigenvalues[3], >, 1e-3);  // order of mu, for any lambda
      TEST_EQUALITY((k - k.transpose()).norm(), 0.0);
      // Energy: the projection removes energy, and removes none if lambda is zero.
      const Matrix pointwise = stiffness(block, {"m", 1.0, poisson}, PlaneModel::Strain);
      const double least = dense::eigenvalues(poisson < 0 ? Matrix(k - pointwise) : Matrix(pointwise - k))[0];
      TEST_COMPARE(least, >, -1e-12 * k.norm());
      if (poisson == 0.0) TEST_COMPARE((k - pointwise).norm(), <, 1e-14 * k.norm());
      (void)cell;
    });
}

TEUCHOS_UNIT_TEST(ElementStiffness, OfMixedElementsCountsItsPressures) {
  // As many eigenvalues of the order of lambda as pressures, hence as many constraints in the limit.
  const std::map<Cell, int> pressures{
      {Cell::Triangle6, 1}, {Cell::Quadrilateral4, 1}, {Cell::Quadrilateral8, 1}, {Cell::Quadrilateral9, 3}};
  for (const bool axisymmetric : {false, true})
    for (const auto& [cell, count] : pressures) {
      CellBlock block = sample::curved(cell);
      for (int i = 0; i < block.nodes(); ++i) block.coordinates[2 * i] += 1.0;
      block.axisymmetric = axisymmetric;
      const Vector values = dense::eigenvalues(stiffness(block, {"m", 1.0, 0.499999, ElementForm::Mixed}, PlaneModel::Strain));
      TEST_EQUALITY((values.array() > 1e3).count(), count);
    }
}

TEUCHOS_UNIT_TEST(ElementStiffness, OfBodiesOfRevolutionHasTheTranslationAlongTheAxisOnlyInItsNullSpace) {
  for (double poisson : {0.0, 0.3, 0.4999})
    forEachElement([&](Cell, ElementForm form, CellBlock block) {
      for (int i = 0; i < block.nodes(); ++i) block.coordinates[2 * i] += 0.5;
      block.axisymmetric = true;
      const Matrix k = stiffness(block, {"m", 1.0, poisson, form}, PlaneModel::Strain);
      const Vector along = nodal(block, [](double, double) { return std::array<double, 2>{0, 1}; });
      TEST_COMPARE((k * along).norm(), <, 1e-14 * k.norm() * along.norm());
      const Vector eigenvalues = dense::eigenvalues(k);
      TEST_COMPARE(std::abs(eigenvalues[0]), <, 1e-13 * k.norm());
      TEST_COMPARE(eigenvalues[1], >, 1e-2);
      TEST_EQUALITY((k - k.transpose()).norm(), 0.0);
    });
}

TEUCHOS_UNIT_TEST(ElementStiffness, GivesARevolvedRectangleTheEnergyOfItsStretches) {
  // u = (a r, b y): strains (a, b, a), the same everywhere; volume pi (r1^2 - r0^2) height, or by Pappus for the triangle.
  const double r0 = 0.7, a = 0.3, b = -0.8;
  forEachElement([&](Cell cell, ElementForm form, const CellBlock&) {
    CellBlock block = sample::axisParallel(cell, 1.5, 2.0);
    for (int i = 0; i < block.nodes(); ++i) block.coordinates[2 * i] += r0;
    block.axisymmetric = true;
    const Vector u = nodal(block, [&](double x, double y) { return std::array<double, 2>{a * x, b * y}; });
    const double pi = std::acos(-1.0);
    const double volume = sample::isTriangle(cell) ? 1.5 * 2 * pi * (r0 + 0.5) : pi * ((r0 + 1.5) * (r0 + 1.5) - r0 * r0) * 2.0;
    const double e = 3.0, nu = 0.3, lambda = e * nu / ((1 + nu) * (1 - 2 * nu)), mu = e / (2 * (1 + nu));
    const double density = lambda * (2 * a + b) * (2 * a + b) + 2 * mu * (2 * a * a + b * b);
    TEST_FLOATING_EQUALITY(u.dot(stiffness(block, {"m", e, nu, form}, PlaneModel::Strain) * u), volume * density, 1e-13);
  });
}

TEUCHOS_UNIT_TEST(ElementStiffness, RefusesAnElementAcrossTheAxis) {
  CellBlock block = sample::axisParallel(Cell::Quadrilateral4, 1, 1);
  for (int i = 0; i < block.nodes(); ++i) block.coordinates[2 * i] -= 0.5;
  block.axisymmetric = true;
  TEST_THROW(stiffness(block, rock, PlaneModel::Strain), InputError);
}

TEUCHOS_UNIT_TEST(ElementStiffness, GivesLinearFieldsTheEnergyOfTheirConstantStress) {
  for (Cell cell : sample::cells())
    for (PlaneModel plane : {PlaneModel::Strain, PlaneModel::Stress}) {
      const CellBlock block = sample::distorted(cell);
      const Vector u = nodal(block, [](double x, double y) { return std::array<double, 2>{0.7 * x - 0.4 * y, 0.9 * x + 0.2 * y}; });
      const Eigen::Vector3d strain(0.7, 0.2, 0.5);
      const double expected =
          sample::polygonArea(block, sample::isTriangle(cell) ? 3 : 4) * strain.dot(elasticity(rock, plane, 2) * strain);
      TEST_FLOATING_EQUALITY(u.dot(stiffness(block, rock, plane) * u), expected, 1e-13);
    }
}

TEUCHOS_UNIT_TEST(ElementStiffness, IntegratesQuadraticFieldsExactlyOnQuadraticCells) {
  const double a = 1.7, b = 0.6;
  const Matrix d = elasticity(rock, PlaneModel::Strain, 2);
  for (Cell cell : {Cell::Triangle6, Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    const CellBlock block = sample::axisParallel(cell, a, b);
    const Matrix k = stiffness(block, rock, PlaneModel::Strain);
    const bool triangle = sample::isTriangle(cell);
    // u = (x^2, 0): strain xx = 2 x. u = (0, x y): strain yy = x, shear y.
    const double xx = triangle ? a * a * a * b / 12 : a * a * a * b / 3, yy = triangle ? a * b * b * b / 12 : a * b * b * b / 3;
    const Vector u = nodal(block, [](double x, double) { return std::array<double, 2>{x * x, 0}; });
    const Vector v = nodal(block, [](double x, double y) { return std::array<double, 2>{0, x * y}; });
    TEST_FLOATING_EQUALITY(u.dot(k * u), 4 * d(0, 0) * xx, 1e-13);
    TEST_FLOATING_EQUALITY(v.dot(k * v), d(1, 1) * xx + d(2, 2) * yy, 1e-13);
    TEST_FLOATING_EQUALITY(u.dot(k * v), 2 * d(0, 1) * xx, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(ElementStiffness, TakesTheMaterialOfEachElement) {
  CellBlock two = sample::axisParallel(Cell::Triangle3, 1, 1);
  two.coordinates.insert(two.coordinates.end(), {1.0, 1.0});
  two.cells.push_back(Cell::Triangle3);
  two.connectivity.insert(two.connectivity.end(), {3, 2, 1});
  two.offsets.push_back(6);
  const std::vector<Material> materials{{"soft", 1.0, 0.3}, {"stiff", 1e6, 0.3}};
  std::vector<Matrix> k;
  elementStiffnesses(
      two, [&](int e) -> const Material& { return materials[e]; }, PlaneModel::Strain,
      [&](int e, ConstLocalView one) {
        TEST_EQUALITY(e, static_cast<int>(k.size()));
        k.push_back(one);
      });
  // The second triangle is the first one rotated by 180 degrees, which does not change the matrix.
  TEST_EQUALITY(k.size(), 2u);
  TEST_COMPARE((k[1] - 1e6 * k[0]).norm(), <, 1e-14 * k[1].norm());
}

TEUCHOS_UNIT_TEST(ElementStiffness, RefusesAnInvertedElement) {
  const CellBlock block = sample::straight(Cell::Triangle3, {{0, 0}, {0, 1}, {1, 0}});
  TEST_THROW(stiffness(block, rock, PlaneModel::Strain), InputError);
}
