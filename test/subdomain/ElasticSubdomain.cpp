#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>
#include <suture/monolithic/Monolithic.hpp>
#include <suture/monolithic/MonolithicSystem.hpp>

#include <support/Blocks.hpp>

namespace suture {
namespace {

using namespace blocks;

// A bar [0, 2] x [0, 1] in plane stress, held on its left, pulled at its right; with zero Poisson's ratio its halves of different Young
// moduli each have a constant strain, which every element can represent.
struct Bar {
  static constexpr double left = 3.0, right = 50.0, pull = 0.6;
  Scene scene;

  explicit Bar(Cell cell) {
    Box box;
    box.x1 = 2;
    box.nx = 8;
    box.ny = 3;
    box.cell = cell;
    box.blocksX = 4;
    box.brickX = 4;
    box.brickY = 3;
    scene = scenes::fromBoxes({box}, left, 0.0);
    scene.model.plane = PlaneModel::Stress;
    scene.region("body_bricks_odd", right);
    scene.hold("body_left", 0, 0.0);
    scene.hold("body_bottom", 1, 0.0);
    scene.traction("body_right", {pull, 0, 0});
  }
  static double exact(double x) { return pull * (std::min(x, 1.0) / left + std::max(x - 1.0, 0.0) / right); }
  static Vector exact(const CellBlock& mesh) {
    Vector u = Vector::Zero(2 * mesh.nodes());
    for (int node = 0; node < mesh.nodes(); ++node) u(2 * node) = exact(mesh.point(node)[0]);
    return u;
  }
};

// Values of subdomains' free unknowns summed over all ranks, by their global numbers.
Vector summed(const Comm& comm, const Blocks& all, int unknowns, const std::function<Vector(const Subdomain&)>& values) {
  Vector mine = Vector::Zero(unknowns), sum(unknowns);
  for (const auto& subdomain : all.subdomains) {
    const Vector own = values(*subdomain);
    for (int i = 0; i < subdomain->dofs(); ++i) mine(subdomain->globalDof(i)) += own(i);
  }
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, unknowns, mine.data(), sum.data());
  return sum;
}

Vector youngOf(const Subdomain& subdomain) { return subdomain.hint(Hint::kYoungModulus).values; }

TEUCHOS_UNIT_TEST(ElasticSubdomain, OfABarOfTwoMaterialsIsInEquilibriumAtTheExactSolution) {
  for (const Cell cell : {Cell::Triangle3, Cell::Quadrilateral4, Cell::Quadrilateral9}) {
    const Bar bar(cell);
    const Blocks all(bar.scene, world());
    const Vector residual = summed(*world(), all, 2 * bar.scene.mesh.nodes(), [](const Subdomain& s) -> Vector {
      return s.stiffness() * s.freeValues(Bar::exact(s.mesh())) - s.load();
    });
    TEST_COMPARE(residual.cwiseAbs().maxCoeff(), <, 1e-13);
    for (const auto& subdomain : all.subdomains) {
      const auto materialOf = [&](int e) -> const Material& { return static_cast<ElasticSubdomain&>(*subdomain).materialOf(e); };
      const Matrix stress = elementStresses(subdomain->mesh(), materialOf, bar.scene.model.plane, Bar::exact(subdomain->mesh()));
      TEST_COMPARE((stress.col(0).array() - Bar::pull).abs().maxCoeff(), <, 1e-13);
    }
    Monitor quiet;
    const MonolithicResult reference = solveMonolithic(bar.scene.mesh, bar.scene.constraints, bar.scene.model, {}, quiet);
    TEST_COMPARE((reference.displacement - Bar::exact(bar.scene.mesh)).cwiseAbs().maxCoeff(), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(ElasticSubdomain, IsTheSameBitByBitWithRegionsOfOneMaterial) {
  Box box;
  box.nx = box.ny = 8;
  box.blocksX = box.blocksY = 2;
  box.brickX = box.brickY = 3;
  const Scene plain = scenes::fromBoxes({box}, 7.0, 0.3);
  Scene bricks = plain;
  bricks.region("body_bricks_odd", 7.0);
  bricks.region("body_bricks_even", 7.0);
  const Blocks one(plain, world()), other(bricks, world());
  for (std::size_t i = 0; i < one.subdomains.size(); ++i)
    TEST_EQUALITY((one.subdomains[i]->stiffness().full() - other.subdomains[i]->stiffness().full()).norm(), 0.0);
  const MonolithicSystem whole(plain.mesh, plain.constraints, plain.model), wholeBricks(bricks.mesh, bricks.constraints, bricks.model);
  TEST_EQUALITY((whole.stiffness().full() - wholeBricks.stiffness().full()).norm(), 0.0);
}

TEUCHOS_UNIT_TEST(ElasticSubdomain, OfOneBrickIsThatOfABodyOfItsMaterial) {
  const int blocks = 4;
  const double jump = 1e6;
  Box box;
  box.nx = box.ny = 2 * blocks;
  box.blocksX = box.blocksY = blocks;
  box.brickX = box.brickY = 2;
  const Scene plain = scenes::fromBoxes({box}, 1.0, 0.3);
  Scene bricks = plain;
  bricks.region("body_bricks_odd", jump);
  std::vector<double> young;  // subdomains are numbered column by column
  for (int i = 0; i < blocks; ++i)
    for (int j = 0; j < blocks; ++j) young.push_back((i + j) % 2 == 0 ? 1.0 : jump);
  const Blocks regions(bricks, world()), bodies(plain, world(), young);
  for (std::size_t i = 0; i < regions.subdomains.size(); ++i) {
    TEST_EQUALITY((regions.subdomains[i]->stiffness().full() - bodies.subdomains[i]->stiffness().full()).norm(), 0.0);
    TEST_EQUALITY((youngOf(*regions.subdomains[i]) - youngOf(*bodies.subdomains[i])).norm(), 0.0);
  }
}

TEUCHOS_UNIT_TEST(ElasticSubdomain, OfBricksIsTheSumOfThePartsOfEachMaterial) {
  // The mesh taken apart: all elements of one colour in one mesh, all of the other colour in another.
  const double soft = 2.0, hard = 3e5;
  Box box;
  box.nx = 7;
  box.ny = 5;
  box.brickX = 2;
  box.brickY = 3;
  Scene scene = scenes::fromBoxes({box}, soft, 0.3);
  scene.region("body_bricks_odd", hard);
  const int unknowns = 2 * scene.mesh.nodes();
  Matrix expected = Matrix::Zero(unknowns, unknowns);
  for (const auto& [group, young] : {std::pair<std::string, double>{"body_bricks_even", soft}, {"body_bricks_odd", hard}}) {
    CellBlock part;
    part.coordinates = scene.mesh.coordinates;
    for (const int e : scene.mesh.elementGroups.at(group)) {
      part.cells.push_back(scene.mesh.cells[e]);
      for (const int node : scene.mesh.nodesOf(e)) part.connectivity.push_back(node);
      part.offsets.push_back(int(part.connectivity.size()));
    }
    elementStiffnesses(part, Material{"", young, 0.3}, scene.model.plane, [&](int e, ConstLocalView k) {
      const auto nodes = part.nodesOf(e);
      for (int a = 0; a < k.rows(); ++a)
        for (int b = 0; b < k.cols(); ++b) expected(2 * nodes[a / 2] + a % 2, 2 * nodes[b / 2] + b % 2) += k(a, b);
    });
  }
  const Blocks whole(scene, alone(), 1);
  TEST_COMPARE(difference(whole.subdomains[0]->stiffness().dense(), expected), <, 1e-14);
  const MonolithicSystem system(scene.mesh, scene.constraints, scene.model);
  TEST_COMPARE(difference(system.stiffness().dense(), expected), <, 1e-14);
}

TEUCHOS_UNIT_TEST(ElasticSubdomain, HasTheLargestYoungModulusAtANode) {
  Box box;
  box.nx = box.ny = 5;
  box.brickX = box.brickY = 1;
  box.cell = Cell::Quadrilateral4;
  for (const double hard : {10.0, 0.1}) {  // the odd cells harder or softer than the even ones, which have the four corners
    Scene scene = scenes::fromBoxes({box}, 1.0, 0.3);
    scene.region("body_bricks_odd", hard);
    const Blocks all(scene, alone(), 1);
    const Subdomain& s = *all.subdomains[0];
    for (int i = 0; i < s.dofs(); ++i) {
      const Point p = s.mesh().point(s.nodeOf(i));
      const bool corner = (p[0] == 0 || p[0] == 1) && (p[1] == 0 || p[1] == 1);
      TEST_EQUALITY(youngOf(s)(i), corner ? 1.0 : std::max(1.0, hard));
    }
  }
}

TEUCHOS_UNIT_TEST(ElasticSubdomain, KnowsItsStiffnessAgainstShapeAloneWhereVolumeIsStiff) {
  // The stiffness is linear in the Lame constant: its value at zero follows from two others with the same shear modulus. Nodes on the left
  // have rotated axes.
  const auto made = [](double poisson) {
    Box box;
    box.nx = box.ny = 6;
    box.cell = Cell::Quadrilateral4;
    Scene scene = scenes::fromBoxes({box}, 2 * 3.0 * (1 + poisson), poisson);
    scene.model.materialOfBody[0].element = ElementForm::Mixed;
    for (int node = 0; node < scene.mesh.nodes(); ++node)
      scene.mesh.coordinates[2 * node] += 0.2 * scene.mesh.coordinates[2 * node + 1] * scene.mesh.coordinates[2 * node + 1];
    scene.hold("body_left", 0, 0.0);
    for (NodeRule& rule : scene.constraints.rules) rule.axes = {{{0.6, 0.8, 0}, {-0.8, 0.6, 0}, {0, 0, 1}}};
    return std::make_unique<Blocks>(scene, alone(), 1);
  };
  const auto lambda = [](double poisson) { return 2 * 3.0 * poisson / (1 - 2 * poisson); };
  const auto low = made(0.2), high = made(0.47);
  TEST_EQUALITY(low->subdomains[0]->hint(Hint::kShearDiagonal).values.cols(), 0);
  const Vector a = low->subdomains[0]->stiffness().diagonal(), b = high->subdomains[0]->stiffness().diagonal();
  const Vector expected = (lambda(0.47) * a - lambda(0.2) * b) / (lambda(0.47) - lambda(0.2));
  TEST_COMPARE((high->subdomains[0]->hint(Hint::kShearDiagonal).values - expected).norm(), <, 1e-12 * expected.norm());
}

TEUCHOS_UNIT_TEST(ElasticSubdomain, CountsTheRandomLoadOfANodeOnce) {
  std::vector<Box> all(2);
  all[0].name = "lower";
  all[1].name = "upper";
  for (Box& box : all) {
    box.nx = box.ny = 6;
    box.blocksX = 3;
    box.blocksY = 2;
  }
  all[1].y0 = 2;
  all[1].y1 = 3;
  for (const std::string body : {"", "upper"}) {
    Scene scene = scenes::fromBoxes(all, 1.0, 0.3);
    Load load;
    load.kind = Load::Kind::Random;
    load.body = body;
    load.value[0] = 0.25;
    load.seed = 11;
    scene.model.loads = {load};
    const Blocks blocks(scene, world());
    const Vector sum = summed(*world(), blocks, 2 * scene.mesh.nodes(), [](const Subdomain& s) { return s.load(); });
    TEST_EQUALITY((sum - nodalLoads(scene.mesh, scene.model)).norm(), 0.0);
    for (int node = 0; node < scene.mesh.nodes(); ++node)
      for (int k = 0; k < 2; ++k) {
        const bool loaded = body.empty() || scene.mesh.point(node)[1] > 1.5;
        TEST_EQUALITY(sum(2 * node + k), loaded ? randomForce(load, node, k) : 0.0);
      }
  }
}

}  // namespace
}  // namespace suture
