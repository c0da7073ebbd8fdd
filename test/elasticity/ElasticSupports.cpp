// Elastic supports of sides: forces of a bed of springs under given motions, and symmetry of their stiffness.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/loads/ElasticSupports.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/Mesh.hpp>

#include <cmath>

using namespace suture;

namespace {

constexpr double kPi = 3.14159265358979323846, normal = 50.0, tangential = 3.0;

Mesh bar(Cell cell) {
  Box box{"bar", 1, 5, 0, 1, 8, 3};
  box.cell = cell;
  Mesh mesh = boxes({box});
  assignBodies(mesh, {"bar"});
  return mesh;
}

ElasticModel onBed() {
  ElasticModel model;
  model.bodies = {"bar"};
  model.supports = {{{"bar_bottom"}, normal, tangential}};
  return model;
}

Vector moved(const Mesh& mesh, double x, double y, double turn) {
  Vector u(2 * mesh.nodes());
  for (int i = 0; i < mesh.nodes(); ++i) {
    u[2 * i] = x - turn * mesh.point(i)[1];
    u[2 * i + 1] = y + turn * mesh.point(i)[0];
  }
  return u;
}

Point sumOf(const Vector& forces) {
  Point sum{0, 0, 0};
  for (Eigen::Index i = 0; i < forces.size(); ++i) sum[i % 2] += forces[i];
  return sum;
}

}  // namespace

TEUCHOS_UNIT_TEST(ElasticSupports, AnswerATranslationByTheirStiffnessAndArea) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    const Mesh mesh = bar(cell);
    const ElasticModel model = onBed();
    const Vector u = moved(mesh, 0.2, -0.1, 0.0);
    const ElasticSupports supports(mesh, mesh.sideGroups, model);
    int count = 0;
    supports.forEachSupport(u, [&](int number, const Vector& forces) {
      TEST_EQUALITY(number, 0);
      TEST_FLOATING_EQUALITY(sumOf(forces)[0], -4.0 * tangential * 0.2, 1e-12);
      TEST_FLOATING_EQUALITY(sumOf(forces)[1], 4.0 * normal * 0.1, 1e-12);
      TEST_COMPARE((forces + supports.forces(u).nodal).norm(), <=, 1e-14 * forces.norm());
      ++count;
    });
    TEST_EQUALITY(count, 1);
  }
}

TEUCHOS_UNIT_TEST(ElasticSupports, AnswerARotationByTheirSecondMoment) {
  const Mesh mesh = bar(Cell::Quadrilateral8);
  const ElasticModel model = onBed();
  const Vector u = moved(mesh, 0.0, 0.0, 0.01);
  // energy: k turn^2 integral of x^2 from 1 to 5
  TEST_FLOATING_EQUALITY(u.dot(ElasticSupports(mesh, mesh.sideGroups, model).forces(u).nodal), normal * 1e-4 * 124.0 / 3.0, 1e-12);
}

TEUCHOS_UNIT_TEST(ElasticSupports, CarryTheWholeCircleOfAnAxisymmetricBody) {
  Mesh mesh = bar(Cell::Quadrilateral4);
  makeAxisymmetric(mesh);
  const ElasticModel model = onBed();
  const Vector forces = ElasticSupports(mesh, mesh.sideGroups, model).forces(moved(mesh, 0.0, -0.1, 0.0)).nodal;
  TEST_FLOATING_EQUALITY(sumOf(forces)[1], -0.1 * normal * kPi * 24.0, 1e-12);
}

TEUCHOS_UNIT_TEST(ElasticSupports, AddAStiffnessConsistentWithTheirForces) {
  const Mesh mesh = bar(Cell::Triangle6);
  const ElasticModel model = onBed();
  const Material steel{"steel", 2e3, 0.3};
  const auto materialOf = [&](int) -> const Material& { return steel; };
  Matrix with = Matrix::Zero(2 * mesh.nodes(), 2 * mesh.nodes()), without = with;
  const auto into = [&](Matrix& sum) {
    return [&](int e, ConstLocalView k) {
      const Span<const int> nodes = mesh.nodesOf(e);
      for (std::size_t a = 0; a < nodes.size(); ++a)
        for (std::size_t b = 0; b < nodes.size(); ++b) sum.block<2, 2>(2 * nodes[a], 2 * nodes[b]) += k.block<2, 2>(2 * a, 2 * b);
    };
  };
  supportedStiffnesses(mesh, mesh.sideGroups, materialOf, model, into(with));
  elementStiffnesses(mesh, materialOf, model.plane, into(without));
  const Vector u = Vector::Random(2 * mesh.nodes());
  const Vector expected = ElasticSupports(mesh, mesh.sideGroups, model).forces(u).nodal;
  TEST_COMPARE(((with - without) * u - expected).norm(), <=, 1e-9 * expected.norm());
  TEST_COMPARE((with - with.transpose()).norm(), <=, 1e-13 * with.norm());
}
