#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>

namespace suture {
namespace {

using namespace blocks;

// A plate [0, 2] x [0, 1], rotated by an angle about the origin, held in the normal direction on its left and lower sides, the left one
// displaced by `shift`, and pulled at its right end: plane stress, s = pull along the plate, exact for linear triangles.
struct Plate {
  static constexpr double young = 7.0, poisson = 0.25, pull = 0.3, shift = 0.02, length = 2.0, height = 1.0;
  double angle;
  Scene scene;
  Point along, across;

  explicit Plate(double a) : angle(a), along{std::cos(a), std::sin(a), 0}, across{-std::sin(a), std::cos(a), 0} {
    Box box;
    box.x1 = length;
    box.nx = 5;
    box.ny = 3;
    scene = scenes::fromBoxes({box}, young, poisson);
    scene.model.plane = PlaneModel::Stress;
    for (int node = 0; node < scene.mesh.nodes(); ++node) {
      const Point p = scene.mesh.point(node);
      for (int k = 0; k < 2; ++k) scene.mesh.coordinates[2 * node + k] = p[0] * along[k] + p[1] * across[k];
    }
    for (int node : scene.nodesOf("body_left")) hold(node, 0, shift);
    for (int node : scene.nodesOf("body_bottom")) hold(node, 1, 0.0);
    scene.traction("body_right", {pull * along[0], pull * along[1], 0});
  }
  void hold(int node, int component, double value) {
    scene.holdNode(node, component, value);
    scene.ruleOf(node).axes = {along, across, {0, 0, 1}};
  }
  Vector exact(const SubdomainMesh& mesh) const {
    Vector u(2 * mesh.nodes());
    for (int node = 0; node < mesh.nodes(); ++node) {
      const Point p = mesh.point(node);
      const double x = p[0] * along[0] + p[1] * along[1], y = p[0] * across[0] + p[1] * across[1];
      const double ux = shift + pull / young * x, uy = -poisson * pull / young * y;
      for (int k = 0; k < 2; ++k) u(2 * node + k) = ux * along[k] + uy * across[k];
    }
    return u;
  }
};

TEUCHOS_UNIT_TEST(Subdomain, NumbersItsFreeUnknowns) {
  const Plate plate(0.4);
  const Blocks body(plate.scene, alone(), 1);
  const Subdomain& s = *body.subdomains[0];
  TEST_EQUALITY(s.dofs(), 2 * 6 * 4 - 4 - 6);  // left: 4 nodes, bottom: 6, one component each
  for (int i = 0; i < s.dofs(); ++i) {
    TEST_EQUALITY(s.dof(s.nodeOf(i), s.componentOf(i)), i);
    TEST_EQUALITY(s.globalDof(i), 2 * s.mesh().globalNodes[s.nodeOf(i)] + s.componentOf(i));
  }
  for (const NodeRule& rule : s.mesh().rules)
    for (int k = 0; k < 2; ++k) TEST_EQUALITY(s.dof(rule.node, k) < 0, rule.fixed[k]);
}

TEUCHOS_UNIT_TEST(Subdomain, AConstantStrainStateIsExactInTurnedAxes) {
  for (double angle : {0.0, 0.4, 2.0}) {
    const Plate plate(angle);
    const Blocks body(plate.scene, alone(), 1);
    const Subdomain& s = *body.subdomains[0];
    TEST_EQUALITY(s.kernel().cols(), 0);
    const Vector exact = plate.exact(s.mesh());
    const Vector v = solveSymmetric(s.stiffness().dense(), s.load());
    TEST_COMPARE(difference(s.cartesian(v), exact), <, 1e-12);
    TEST_COMPARE(difference(s.freeValues(exact), v), <, 1e-12);
    // stored energy less the work of the pull
    const double stored = plate.pull * plate.pull / plate.young * plate.length * plate.height / 2;
    const double work = plate.pull * plate.height * (plate.shift + plate.pull / plate.young * plate.length);
    const double energy = 0.5 * v.dot(s.stiffness() * v) - v.dot(s.load()) + s.constantEnergy();
    TEST_FLOATING_EQUALITY(energy, stored - work, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(Subdomain, ReactionsBalanceTheLoads) {
  const Plate plate(0.4);
  const Blocks body(plate.scene, alone(), 1);
  const Subdomain& s = *body.subdomains[0];
  Point applied{0, 0, 0}, reactions{0, 0, 0};
  double absolute = 0.0;
  s.resultants(solveSymmetric(s.stiffness().dense(), s.load()), applied, reactions, absolute);
  for (int k = 0; k < 2; ++k) {
    TEST_COMPARE(std::abs(applied[k] - plate.pull * plate.height * plate.along[k]), <, 1e-13);
    TEST_COMPARE(std::abs(reactions[k] + plate.pull * plate.height * plate.along[k]), <, 1e-12);
  }
  TEST_COMPARE(absolute, >=, 2 * plate.pull * plate.height);
  TEST_COMPARE(absolute, <, 4 * plate.pull * plate.height);
}

TEUCHOS_UNIT_TEST(Subdomain, ABodyOnAnInclineCanSlide) {
  Plate plate(0.4);
  for (NodeRule& rule : plate.scene.constraints.rules) rule.fixed[0] = false;  // only the lower side is held
  const Blocks body(plate.scene, alone(), 1);
  const Subdomain& s = *body.subdomains[0];
  TEST_EQUALITY(s.kernel().cols(), 1);
  TEST_COMPARE((s.stiffness() * s.kernel()).norm(), <, 1e-13 * s.stiffness().dense().norm() * s.kernel().norm());
  Vector sliding(2 * s.mesh().nodes());
  for (int node = 0; node < s.mesh().nodes(); ++node) sliding.segment(2 * node, 2) << plate.along[0], plate.along[1];
  const Vector expected = s.freeValues(sliding), found = s.kernel().col(0);
  TEST_COMPARE(difference(found * (found.dot(expected) / found.squaredNorm()), expected), <, 1e-12);
}

// Loads and prescribed values changed after the assembly, against a subdomain assembled with them.
TEUCHOS_UNIT_TEST(Subdomain, TakesOtherLoadsAsIfItWereAssembledWithThem) {
  Plate plate(0.4), other(0.4);
  other.scene.model.loads[0].factor = -2.5;
  for (int node : other.scene.nodesOf("body_left")) other.scene.ruleOf(node).value[0] = 3.0 * Plate::shift;
  Blocks body(plate.scene, alone(), 2);
  const Blocks expected(other.scene, alone(), 2);
  body.model.loads[0].factor = -2.5;
  for (std::size_t i = 0; i < body.subdomains.size(); ++i) {
    Subdomain& s = *body.subdomains[i];
    const Subdomain& e = *expected.subdomains[i];
    body.meshes[i].rules = e.mesh().rules;
    s.reload();
    TEST_COMPARE(difference(s.load(), e.load()), <, 1e-14);
    TEST_COMPARE(difference(s.nodalLoads(), e.nodalLoads()), <, 1e-14);
    TEST_COMPARE(std::abs(s.constantEnergy() - e.constantEnergy()), <, 1e-14);
    TEST_COMPARE(difference(s.cartesian(s.freeValues(e.cartesian(e.load()))), e.cartesian(e.load())), <, 1e-14);
  }
}

// The same force by the matrix and by element loops, in rotated axes and with prescribed components.
TEUCHOS_UNIT_TEST(Subdomain, ItsForcesAndLoadsAreThoseOfElementLoops) {
  const Plate plate(0.4);
  const Blocks body(plate.scene, alone(), 3);
  for (const auto& subdomain : body.subdomains) {
    const SubdomainMesh& mesh = subdomain->mesh();
    Vector u(2 * mesh.nodes());
    for (int i = 0; i < u.size(); ++i) u(i) = std::sin(1.0 + 3.7 * i);  // prescribed components as they are: K u is computed, not a state
    const auto materialOf = [&](int e) -> const Material& { return plate.scene.model.materialOf(mesh, e, mesh.body); };
    const ElementForces found = subdomain->internalForces(u), expected = elementForces(mesh, materialOf, plate.scene.model.plane, u);
    TEST_COMPARE(difference(found.internal, expected.internal), <, 1e-13);
    TEST_COMPARE(difference(subdomain->nodalLoads(), subdomainLoads(mesh, plate.scene.model)), <, 1e-14);
    for (int node = 0; node < mesh.nodes(); ++node) {  // orders only
      TEST_COMPARE(found.stiffness(node), <, 4 * expected.stiffness(node));
      TEST_COMPARE(found.stiffness(node), >, expected.stiffness(node) / 4);
    }
    const Matrix stresses = elementStresses(mesh, materialOf, plate.scene.model.plane, u);
    TEST_COMPARE((subdomain->stresses(u) - stresses).norm(), <, 1e-14 * stresses.norm());
  }
}

// A subdomain with a user's physics: the base class checks its input.
class Broken : public Subdomain {
 public:
  Broken(const SubdomainMesh& mesh, int size, double diagonal) : Subdomain(mesh), size_(size), diagonal_(diagonal) {}

 protected:
  void doAssemble(SparseMatrix& stiffness, Vector&) override {
    stiffness.resize(size_, size_);
    stiffness.setIdentity();
    stiffness.coeffRef(5, 5) = diagonal_;
  }
  Matrix doRigidModes() const override { return Matrix(2 * mesh().nodes(), 0); }
  Matrix doStresses(const Vector&) const override { return Matrix::Zero(size_, 4); }

 private:
  int size_;
  double diagonal_;
};

TEUCHOS_UNIT_TEST(Subdomain, RefusesAMatrixOfTheWrongSizeOrWithoutStiffness) {
  const Scene scene = square(1, 2);
  const Blocks body(scene, alone(), 1);
  const int n = 2 * body.meshes[0].nodes();
  TEST_THROW(Broken(body.meshes[0], n - 1, 1.0).assemble(), NumericalError);
  TEST_THROW(Broken(body.meshes[0], n, 0.0).assemble(), NumericalError);
  TEST_NOTHROW(Broken(body.meshes[0], n, 1.0).assemble());
}

TEUCHOS_UNIT_TEST(Subdomain, HasHintsAtItsFreeUnknownsAndOneOfAUsersOwnNone) {
  const Scene scene = clampedSquare(1, 3, 7e9);
  const Blocks body(scene, alone(), 1);
  TEST_EQUALITY(body.subdomains[0]->hint(Hint::kYoungModulus).values, Matrix::Constant(2 * (16 - 4), 1, 7e9));
  TEST_ASSERT(body.subdomains[0]->hint("colour").empty());
  Broken users(body.meshes[0], 2 * 16, 1.0);
  users.assemble();
  TEST_ASSERT(users.hint(Hint::kYoungModulus).empty());
  TEST_EQUALITY(users.hint(Hint::kCoarseModes).values, users.rigidModes());
}

}  // namespace
}  // namespace suture
