// 3D element stiffness: against tractions on the elements' sides and closed forms; effects of rotations and incompressibility.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/mesh/Generators.hpp>

#include <cmath>
#include <map>
#include <set>

#include <support/DenseAlgebra.hpp>
#include "SampleCells.hpp"

using namespace suture;

namespace solidstiffness {

namespace {

using Field = std::function<Point(const Point&)>;

Matrix stiffness(const CellBlock& block, const Material& material) {
  const int n = 3 * block.nodes();
  Matrix sum = Matrix::Zero(n, n);
  elementStiffnesses(block, material, PlaneModel::Strain, [&](int e, ConstLocalView k) {
    const Span<const int> nodes = block.nodesOf(e);
    for (std::size_t a = 0; a < nodes.size(); ++a)
      for (std::size_t b = 0; b < nodes.size(); ++b) sum.block<3, 3>(3 * nodes[a], 3 * nodes[b]) += k.block<3, 3>(3 * a, 3 * b);
  });
  return sum;
}

Vector nodal(const CellBlock& block, const Field& field) {
  Vector u(3 * block.nodes());
  for (int i = 0; i < block.nodes(); ++i) {
    const Point value = field(block.point(i));
    u.segment<3>(3 * i) << value[0], value[1], value[2];
  }
  return u;
}

Eigen::Matrix3d turn() {  // about no axis of the mesh
  return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
}

// An anisotropic law without symmetry about the scene's axes: 21 constants.
std::shared_ptr<const MaterialLaw> skewLaw() {
  const Matrix random = dense::random(6, 6, 5);
  return std::make_shared<GivenLaw>(ElasticStiffness(random * random.transpose() + 3.0 * Matrix::Identity(6, 6)));
}

std::vector<Material> materials(Cell cell) {
  std::vector<Material> all{{"soft", 3.0, 0.3}, {"nearly", 3.0, 0.4999}};
  all.push_back({"skew", 3.0, 0.3});
  all.back().law = skewLaw();
  if (mayBeEnhanced(cell))
    for (std::size_t i = 0; i < 3; ++i) {
      Material enhanced = all[i];
      enhanced.enhanced = true;
      all.push_back(enhanced);
    }
  if (cell == Cell::Tetrahedron4) return all;
  for (std::size_t i = 0; i < 3; ++i) {
    Material mixed = all[i];
    mixed.element = ElementForm::Mixed;
    if (!mixed.law) all.push_back(mixed);
  }
  return all;
}

// Calls take(block, material) for every cell, straight and curved, and every material.
template <typename Take>
void forEachElement(const Take& take) {
  for (const Cell cell : sample::solids())
    for (const CellBlock& block : {sample::distortedSolid(cell), sample::curvedSolid(cell)})
      for (const Material& material : materials(cell)) take(block, material);
}

}  // namespace

TEUCHOS_UNIT_TEST(SolidStiffness, AConstantStressNeedsItsTractionsOnTheSides) {
  Eigen::Matrix3d gradient;
  gradient << 0.7, -0.4, 0.1, 0.9, 0.2, -0.3, 0.5, 0.6, -0.8;
  forEachElement([&](const CellBlock& block, const Material& material) {
    const Vector u = nodal(block, [&](const Point& p) -> Point {
      const Eigen::Vector3d value = gradient * Eigen::Vector3d(p[0], p[1], p[2]);
      return {value[0], value[1], value[2]};
    });
    StressVector<3> strain;
    for (int c = 0; c < 6; ++c) {
      const int i = kStressAxes[c][0], j = kStressAxes[c][1];
      strain[c] = i == j ? gradient(i, i) : gradient(i, j) + gradient(j, i);
    }
    const StressVector<3> s = material.stiffness() * strain;
    Eigen::Matrix3d stress;
    stress << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
    Vector flux = Vector::Zero(u.size());  // integrals of N n over all sides
    for (const Side& side : sample::sidesOfElement(block)) addSideFlux(block, side, 1.0, flux);
    Vector expected(u.size());
    for (int a = 0; a < block.nodes(); ++a) expected.segment<3>(3 * a) = stress * flux.segment<3>(3 * a);
    TEST_COMPARE((stiffness(block, material) * u - expected).norm(), <, 2e-13 * expected.norm());
  });
}

TEUCHOS_UNIT_TEST(SolidStiffness, HasTheSixRigidModesAndNothingElseInItsNullSpace) {
  forEachElement([&](const CellBlock& block, const Material& material) {
    const Matrix k = stiffness(block, material);
    Matrix rigid(k.rows(), 6);
    for (int i = 0; i < 3; ++i) {
      Point axis{0, 0, 0};
      axis[i] = 1.0;
      rigid.col(i) = nodal(block, [&](const Point&) { return axis; });
      rigid.col(3 + i) = nodal(block, [&](const Point& p) -> Point {
        const Eigen::Vector3d value = Eigen::Vector3d::Unit(i).cross(Eigen::Vector3d(p[0], p[1], p[2]));
        return {value[0], value[1], value[2]};
      });
    }
    TEST_COMPARE((k * rigid).norm(), <, 1e-14 * k.norm() * rigid.norm());
    TEST_EQUALITY((k - k.transpose()).norm(), 0.0);
    const Vector eigenvalues = dense::eigenvalues(k);
    TEST_COMPARE(std::abs(eigenvalues[5]), <, 1e-13 * k.norm());
    TEST_COMPARE(eigenvalues[6], >, 1e-3);  // order of mu times a length, for any lambda
  });
}

TEUCHOS_UNIT_TEST(SolidStiffness, IsTheClosedFormOfALinearTetrahedron) {
  const CellBlock block = sample::distortedSolid(Cell::Tetrahedron4);
  Eigen::Matrix4d vertices;  // rows 1, x, y, z: columns of the inverse are the coefficients of the shape functions
  for (int a = 0; a < 4; ++a) vertices.row(a) << 1.0, block.point(a)[0], block.point(a)[1], block.point(a)[2];
  const Matrix functions = dense::inverse(vertices);
  const double volume = dense::determinant(vertices) / 6.0;
  Matrix b = Matrix::Zero(6, 12);
  for (int a = 0; a < 4; ++a)
    for (int c = 0; c < 6; ++c) {
      const int i = kStressAxes[c][0], j = kStressAxes[c][1];
      b(c, 3 * a + i) += functions(1 + j, a);
      if (i != j) b(c, 3 * a + j) += functions(1 + i, a);
    }
  for (const Material& material : materials(Cell::Tetrahedron4)) {
    const Matrix expected = volume * b.transpose() * material.stiffness() * b;
    TEST_COMPARE((stiffness(block, material) - expected).norm(), <, 1e-14 * expected.norm());
  }
}

TEUCHOS_UNIT_TEST(SolidStiffness, IntegratesQuadraticFieldsExactlyOnQuadraticCells) {
  const double a = 1.7, b = 0.6, c = 1.1;
  const Material material{"m", 3.0, 0.3};
  const ElasticStiffness d = material.stiffness();
  for (const Cell cell : {Cell::Tetrahedron10, Cell::Hexahedron20, Cell::Hexahedron27}) {
    const CellBlock block = sample::brick(cell, a, b, c);
    const Matrix k = stiffness(block, material);
    const double volume = a * b * c, part = cell == Cell::Tetrahedron10 ? 1.0 / 60 : 1.0 / 3;
    const double xx = part * volume * a * a, yy = part * volume * b * b, zz = part * volume * c * c;
    // (x^2, 0, 0): strain xx = 2 x. (0, x y, 0): yy = x, xy = y. (0, 0, y z): zz = y, yz = z. (z^2, 0, 0): xz = 2 z.
    const Vector u = nodal(block, [](const Point& p) -> Point { return {p[0] * p[0], 0, 0}; });
    const Vector v = nodal(block, [](const Point& p) -> Point { return {0, p[0] * p[1], 0}; });
    const Vector w = nodal(block, [](const Point& p) -> Point { return {0, 0, p[1] * p[2]}; });
    const Vector s = nodal(block, [](const Point& p) -> Point { return {p[2] * p[2], 0, 0}; });
    TEST_FLOATING_EQUALITY(u.dot(k * u), 4 * d(0, 0) * xx, 1e-13);
    TEST_FLOATING_EQUALITY(v.dot(k * v), d(1, 1) * xx + d(3, 3) * yy, 1e-13);
    TEST_FLOATING_EQUALITY(w.dot(k * w), d(2, 2) * yy + d(4, 4) * zz, 1e-13);
    TEST_FLOATING_EQUALITY(s.dot(k * s), 4 * d(5, 5) * zz, 1e-13);
    TEST_FLOATING_EQUALITY(u.dot(k * v), 2 * d(0, 1) * xx, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(SolidStiffness, TurnsWithItsElement) {
  const Eigen::Matrix3d r = turn();
  forEachElement([&](const CellBlock& block, const Material& material) {
    if (material.law) return;  // isotropic
    CellBlock turned = block;
    Matrix all = Matrix::Zero(3 * block.nodes(), 3 * block.nodes());
    for (int a = 0; a < block.nodes(); ++a) {
      const Eigen::Vector3d place = r * Eigen::Map<const Eigen::Vector3d>(block.coordinates.data() + 3 * a);
      for (int k = 0; k < 3; ++k) turned.coordinates[3 * a + k] = place[k];
      all.block<3, 3>(3 * a, 3 * a) = r;
    }
    const Matrix expected = all * stiffness(block, material) * all.transpose();
    TEST_COMPARE((stiffness(turned, material) - expected).norm(), <, 1e-13 * expected.norm());
  });
}

TEUCHOS_UNIT_TEST(SolidStiffness, OfMixedElementsCountsItsPressures) {
  // As many eigenvalues of the order of lambda as pressures, hence as many constraints in the limit.
  for (const Cell cell : sample::solids()) {
    if (cell == Cell::Tetrahedron4) continue;
    const Material rubber{"m", 1.0, 0.499999, ElementForm::Mixed};
    const Vector values = dense::eigenvalues(stiffness(sample::curvedSolid(cell), rubber));
    TEST_EQUALITY((values.array() > 3e3).count(), cell == Cell::Hexahedron27 ? 4 : 1);
  }
}

namespace {

// Energy of a beam whose ends are rotated against each other.
double bendingEnergy(Cell cell, const Material& material) {
  Box box;
  box.cell = cell;
  box.x1 = 4;
  const bool quadratic = cellInfo(cell).order == 2;
  box.nx = quadratic ? 3 : 6;
  box.ny = quadratic ? 1 : 2;
  box.nz = quadratic ? 1 : 2;
  const Mesh mesh = boxes({box});
  const Matrix k = stiffness(mesh, material);
  std::set<int> held;
  for (const char* group : {"body_left", "body_right"})
    for (const Side& side : mesh.sideGroups.at(group))
      for (const int node : mesh.nodesOf(side))
        for (int c = 0; c < 3; ++c) held.insert(3 * node + c);
  const std::vector<int> boundary(held.begin(), held.end());
  const Matrix schur = dense::denseSchur(k, boundary);
  Vector u(boundary.size());
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    const Point p = mesh.point(boundary[i] / 3);
    const double at = p[0] == 0.0 ? -0.1 : 0.1;
    u[i] = boundary[i] % 3 == 0 ? at * (p[2] - 0.5) : 0.0;
  }
  return u.dot(schur * u);
}

}  // namespace

TEUCHOS_UNIT_TEST(SolidStiffness, OfMixedElementsDoesNotLock) {
  for (const Cell cell : sample::solids()) {
    if (cell == Cell::Tetrahedron4) continue;
    const Material moderate{"m", 3.0, 0.49, ElementForm::Mixed}, nearly{"m", 3.0, 0.4999, ElementForm::Mixed};
    const double more = bendingEnergy(cell, nearly) / bendingEnergy(cell, moderate);
    out << cellInfo(cell).name << ": energy times " << more << "\n";
    TEST_COMPARE(more, <, 1.06);
    TEST_COMPARE(more, >, 0.98);
  }
  const double locked = bendingEnergy(Cell::Hexahedron8, {"m", 3.0, 0.4999}) / bendingEnergy(Cell::Hexahedron8, {"m", 3.0, 0.49});
  TEST_COMPARE(locked, >, 2.0);  // such locking the test would detect
}

TEUCHOS_UNIT_TEST(SolidStiffness, RefusesAnInvertedElement) {
  for (const Cell cell : sample::solids()) {
    const CellBlock block = sample::mapped(cell, [](const Point& p) -> Point { return {-p[0], p[1], p[2]}; });
    TEST_THROW(stiffness(block, {"m", 1.0, 0.3}), InputError);
  }
}

}  // namespace solidstiffness
