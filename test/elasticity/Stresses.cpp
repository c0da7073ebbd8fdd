#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/ElasticModel.hpp>

#include <support/DenseAlgebra.hpp>
#include "SampleCells.hpp"

using namespace suture;

namespace {

const Material steel{"steel", 210e9, 0.3};
const Material& steelOf(int) { return steel; }

// Stresses of the linear displacement u = G x on one element.
Vector stressOf(const CellBlock& block, const Eigen::Matrix2d& gradient, PlaneModel plane) {
  Vector u(2 * block.nodes());
  for (int i = 0; i < block.nodes(); ++i) u.segment<2>(2 * i) = gradient * Eigen::Vector2d(block.point(i)[0], block.point(i)[1]);
  return elementStresses(block, steelOf, plane, u).row(0).transpose();
}

Eigen::Matrix2d gradient(double xx, double xy, double yx, double yy) {
  Eigen::Matrix2d g;
  g << xx, xy, yx, yy;
  return g;
}

Matrix rows(std::initializer_list<std::array<double, 4>> all) {
  Matrix m(all.size(), 4);
  int i = 0;
  for (const auto& row : all) {
    for (int k = 0; k < 4; ++k) m(i, k) = row[k];
    ++i;
  }
  return m;
}

}  // namespace

TEUCHOS_UNIT_TEST(Stresses, FollowHookesLawInThreeDimensions) {
  // The inverse law: strains from stresses, e_xx = (s_xx - nu (s_yy + s_zz)) / E, and so on.
  const double exx = 1e-3, eyy = -4e-4, half = 3e-4;  // half the engineering shear
  const double e = steel.young, nu = steel.poisson;
  for (Cell cell : sample::cells())
    for (const CellBlock& block : {sample::distorted(cell), sample::curved(cell)})
      for (PlaneModel plane : {PlaneModel::Strain, PlaneModel::Stress}) {
        // An added rotation must change nothing.
        const Vector s = stressOf(block, gradient(exx, half + 0.01, half - 0.01, eyy), plane);
        TEST_COMPARE(std::abs((s[0] - nu * (s[1] + s[2])) / e - exx), <, 1e-15);
        TEST_COMPARE(std::abs((s[1] - nu * (s[0] + s[2])) / e - eyy), <, 1e-15);
        TEST_COMPARE(std::abs(s[3] * (1 + nu) / e - half), <, 1e-15);
        if (plane == PlaneModel::Strain) {
          TEST_COMPARE(std::abs((s[2] - nu * (s[0] + s[1])) / e), <, 1e-15);
        } else {
          TEST_EQUALITY(s[2], 0.0);
        }
      }
}

TEUCHOS_UNIT_TEST(Stresses, AcrossTheMeridianPlaneAreTheHoopStress) {
  const double a = 1e-3, b = -4e-4, e = steel.young, nu = steel.poisson;
  for (ElementForm form : {ElementForm::Displacement, ElementForm::Mixed})
    for (Cell cell : sample::cells()) {
      if (cell == Cell::Triangle3 && form == ElementForm::Mixed) continue;
      CellBlock block = sample::curved(cell);
      for (int i = 0; i < block.nodes(); ++i) block.coordinates[2 * i] += 0.5;
      block.axisymmetric = true;
      const Material material{"steel", e, nu, form};
      Vector u(2 * block.nodes());
      for (int i = 0; i < block.nodes(); ++i) u.segment<2>(2 * i) << a * block.point(i)[0], b * block.point(i)[1];
      const Vector s = elementStresses(
                           block, [&](int) -> const Material& { return material; }, PlaneModel::Strain, u)
                           .row(0)
                           .transpose();
      TEST_COMPARE(std::abs((s[0] - nu * (s[1] + s[2])) / e - a), <, 1e-15);
      TEST_COMPARE(std::abs((s[1] - nu * (s[0] + s[2])) / e - b), <, 1e-15);
      TEST_COMPARE(std::abs((s[2] - nu * (s[0] + s[1])) / e - a), <, 1e-15);
      TEST_COMPARE(std::abs(s[3] / e), <, 1e-15);
    }
}

TEUCHOS_UNIT_TEST(Stresses, OfMixedElementsHaveTheMeanPressureOfTheElement) {
  // u = (x^2, 0) on the square [0, 1]^2: the dilatation 2 x is 1 on average, and at the centroid if it is linear.
  for (Cell cell : {Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    const CellBlock block = sample::axisParallel(cell, 1, 1);
    Vector u = Vector::Zero(2 * block.nodes());
    for (int i = 0; i < block.nodes(); ++i) u[2 * i] = block.point(i)[0] * block.point(i)[0];
    const Material material{"m", 1.0, 0.4999, ElementForm::Mixed};
    const Matrix s = elementStresses(
        block, [&](int) -> const Material& { return material; }, PlaneModel::Strain, u);
    const double lambda = 0.4999 / (1.4999 * 0.0002), mu = 1 / (2 * 1.4999);
    TEST_FLOATING_EQUALITY(s(0, 1), lambda, 1e-10);
    TEST_FLOATING_EQUALITY(s(0, 0), lambda + 2 * mu, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(Stresses, In3DFollowHookesLaw) {
  const double e = steel.young, nu = steel.poisson;
  Eigen::Matrix3d g;
  g << 1e-3, 2e-4, -3e-4, 5e-4, -4e-4, 1e-4, 7e-4, -6e-4, 2e-4;
  for (const ElementForm form : {ElementForm::Displacement, ElementForm::Mixed})
    for (const Cell cell : sample::solids()) {
      if (cell == Cell::Tetrahedron4 && form == ElementForm::Mixed) continue;
      for (const CellBlock& block : {sample::distortedSolid(cell), sample::curvedSolid(cell)}) {
        const Material material{"steel", e, nu, form};
        Vector u(3 * block.nodes());
        for (int i = 0; i < block.nodes(); ++i)
          u.segment<3>(3 * i) = g * Eigen::Map<const Eigen::Vector3d>(block.coordinates.data() + 3 * i);
        const Vector s = elementStresses(
                             block, [&](int) -> const Material& { return material; }, PlaneModel::Strain, u)
                             .row(0)
                             .transpose();
        TEST_EQUALITY(s.size(), 6);
        for (int k = 0; k < 3; ++k)  // strains from stresses
          TEST_COMPARE(std::abs(((1 + nu) * s[k] - nu * (s[0] + s[1] + s[2])) / e - g(k, k)), <, 1e-15);
        TEST_COMPARE(std::abs(2 * (1 + nu) / e * s[3] - g(0, 1) - g(1, 0)), <, 1e-15);
        TEST_COMPARE(std::abs(2 * (1 + nu) / e * s[4] - g(1, 2) - g(2, 1)), <, 1e-15);
        TEST_COMPARE(std::abs(2 * (1 + nu) / e * s[5] - g(0, 2) - g(2, 0)), <, 1e-15);
      }
    }
}

TEUCHOS_UNIT_TEST(Stresses, HaveThePrincipalValuesOfTheCharacteristicPolynomial) {
  const Matrix random = dense::random(50, 6, 3);
  const Matrix principal = principalStresses(random);
  TEST_EQUALITY(principal.cols(), 9);
  for (int i = 0; i < random.rows(); ++i) {
    Eigen::Matrix3d t;
    t << random(i, 0), random(i, 3), random(i, 5), random(i, 3), random(i, 1), random(i, 4), random(i, 5), random(i, 4), random(i, 2);
    const double first = t.trace(), second = 0.5 * (first * first - (t * t).trace()),
                 third = t.row(0).cross(t.row(1)).dot(t.row(2));  // the invariants
    for (int k = 0; k < 3; ++k) {
      const double s = principal(i, k);
      TEST_COMPARE(std::abs(((s - first) * s + second) * s - third), <, 1e-13);
    }
    TEST_COMPARE(principal(i, 0), >=, principal(i, 1));
    TEST_COMPARE(principal(i, 1), >=, principal(i, 2));
    TEST_COMPARE(std::abs(principal.row(i).head<3>().sum() - first), <, 1e-13);
    for (const auto& [value, column] : {std::make_pair(0, 3), {2, 6}}) {
      const Eigen::Vector3d axis = principal.row(i).segment<3>(column);
      TEST_COMPARE((t * axis - principal(i, value) * axis).norm(), <, 1e-13);
      TEST_FLOATING_EQUALITY(axis.norm(), 1.0, 1e-13);
      TEST_FLOATING_EQUALITY(axis.cwiseAbs().maxCoeff(), axis.maxCoeff(), 1e-15);
    }
    // von Mises by the second invariant of the deviator.
    const Eigen::Matrix3d deviator = t - first / 3.0 * Eigen::Matrix3d::Identity();
    TEST_FLOATING_EQUALITY(vonMises(random.row(i))[0], std::sqrt(1.5) * deviator.norm(), 1e-13);
  }
}

TEUCHOS_UNIT_TEST(Stresses, AreTensionPositive) {
  const Vector s = stressOf(sample::distorted(Cell::Triangle3), gradient(1e-3, 0, 0, 0), PlaneModel::Stress);
  TEST_COMPARE(s[0], >, 0.0);
}

TEUCHOS_UNIT_TEST(Stresses, HavePrincipalValuesThatAreThoseOfTheTurnedTensor) {
  const double s1 = 5e6, s2 = -2e6;
  for (double angle : {0.0, 0.3, 1.2, -0.7, -1.5}) {
    const double c = std::cos(angle), s = std::sin(angle);
    const Matrix tensor = rows({{s1 * c * c + s2 * s * s, s1 * s * s + s2 * c * c, 7e7, (s1 - s2) * s * c}});
    const Matrix principal = principalStresses(tensor);
    TEST_FLOATING_EQUALITY(principal(0, 0), s1, 1e-13);
    TEST_FLOATING_EQUALITY(principal(0, 1), s2, 1e-13);
    TEST_COMPARE(std::abs(principal(0, 2) - angle), <, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(Stresses, HaveTheVonMisesStressOfKnownCases) {
  const double t = 3e6;
  const Vector v = vonMises(rows({{t, 0, 0, 0}, {t, t, t, 0}, {0, 0, 0, t}, {t, t, 0, 0}, {0, 0, -t, 0}, {t, -t, 0, 0}}));
  TEST_FLOATING_EQUALITY(v[0], t, 1e-14);                   // uniaxial
  TEST_COMPARE(std::abs(v[1]), <, 1e-6);                    // hydrostatic
  TEST_FLOATING_EQUALITY(v[2], std::sqrt(3.0) * t, 1e-14);  // pure shear
  TEST_FLOATING_EQUALITY(v[3], t, 1e-14);                   // equibiaxial: like uniaxial out of plane
  TEST_FLOATING_EQUALITY(v[4], t, 1e-14);
  TEST_FLOATING_EQUALITY(v[5], std::sqrt(3.0) * t, 1e-14);  // pure shear, rotated by 45 degrees
}
