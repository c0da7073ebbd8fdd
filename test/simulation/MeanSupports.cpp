// Bodies that only prescribed mean displacements hold, against closed forms and statics, on any number of ranks.
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/base/Errors.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/MeanSupports.hpp>
#include <suture/simulation/Simulation.hpp>

#include <functional>

namespace suture {
namespace {

/// A scene in preparation.
struct MeanScene {
  ElasticModel model;
  std::vector<Box> bodies;
  std::vector<Condition> held{};
  std::vector<Contact> contacts{};

  explicit MeanScene(std::vector<Box> all, PlaneModel plane = PlaneModel::Stress) : bodies(std::move(all)) {
    model.plane = plane;
    for (const Box& box : bodies)
      if (dimensionOf(box.cell) == 3) model.dimension = 3;
  }
  void addBodies(double young, double poisson) {
    for (const Box& box : bodies) model.addBody(box.name, std::make_shared<IsotropicLaw>(IsotropicModuli{young, poisson}));
  }
  void mean(const std::string& group, int component, double value) {
    model.loads.push_back(Load::meanDisplacement(group, component, value));
  }
  Scene scene(std::vector<std::string> settings = {}) const {
    for (const char* more : {"Outer Solver/Tolerance=1e-11", "Partition/METIS/Subdomains=5"}) settings.push_back(more);
    return makeScene(
        model, [all = bodies] { return boxes(all); }, held, contacts, settings);
  }
};

const std::vector<std::vector<std::string>> kMeanWays{
    {"Outer Solver/Type=Monolithic"},
    {},
    {"Formulation=Condensed Groups", "Outer Solver/Type=Semismooth Newton", "Preconditioner/Type=Neumann-Neumann"}};

/// Largest distance of the displacements from those of a closed form.
double distanceFrom(const Simulation& simulation, const std::function<Point(const Point&)>& exact) {
  double mine = 0.0, all = 0.0;
  for (std::size_t i = 0; i < simulation.meshes().size(); ++i) {
    const SubdomainMesh& mesh = simulation.meshes()[i];
    for (int node = 0; node < mesh.nodes(); ++node)
      for (int k = 0; k < mesh.dimension; ++k) {
        const double u = mesh.total(simulation.solution().displacement[i], Eigen::Index(node) * mesh.dimension + k);
        mine = std::max(mine, std::abs(u - exact(mesh.point(node))[std::size_t(k)]));
      }
  }
  Teuchos::reduceAll(*blocks::world(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all;
}

std::string refusalOf(const Scene& scene) {
  try {
    Simulation(blocks::world(), scene).solve();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool names(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// A bar that is pulled at one end; the mean of the other end, and the means across of both, hold it: uniform stress, as the force of a
// mean is a uniform traction.
TEUCHOS_UNIT_TEST(MeanSupports, HoldAPulledBar) {
  MeanScene bar({{"bar", 0, 2, 0, 1, 8, 4, Cell::Quadrilateral4}});
  bar.addBodies(2e6, 0.25);
  bar.model.loads = {Load::traction("bar_right", {100.0, 0.0, 0.0})};
  bar.mean("bar_left", 0, 3e-3), bar.mean("bar_left", 1, 0.0), bar.mean("bar_right", 1, 0.0);
  for (const std::vector<std::string>& way : kMeanWays) {
    Simulation simulation(blocks::world(), bar.scene(way));
    const Solution& solution = simulation.solve();
    out << solution.failure << "\n";
    TEST_ASSERT(simulation.ending() == ExitCode::Done);
    const double strain = 100.0 / 2e6;
    const auto exact = [&](const Point& x) { return Point{3e-3 + strain * x[0], -0.25 * strain * (x[1] - 0.5), 0.0}; };
    TEST_COMPARE(distanceFrom(simulation, exact), <, 1e-9 * strain);
    TEST_FLOATING_EQUALITY(solution.verification.reactions.loads[1].force[0], -100.0, 1e-8);
    TEST_COMPARE(std::abs(solution.verification.reactions.loads[2].force[1]), <, 1e-6);
    for (const Resultant& support : solution.verification.reactions.supports) TEST_COMPARE(norm(support.force), ==, 0.0);
    TEST_EQUALITY(solution.verification.checks.back().name, "controlled_loads");
  }
}

// The same in 3D: six means, of three groups.
TEUCHOS_UNIT_TEST(MeanSupports, HoldAPulledBarIn3D) {
  Box box{"bar", 0, 2, 0, 1, 3, 2, Cell::Hexahedron8};
  box.nz = 2;
  MeanScene bar({box});
  bar.addBodies(2e6, 0.25);
  bar.model.loads = {Load::traction("bar_right", {100.0, 0.0, 0.0})};
  for (int k = 0; k < 3; ++k) bar.mean("bar_left", k, 0.0);
  bar.mean("bar_right", 1, 0.0), bar.mean("bar_right", 2, 0.0), bar.mean("bar_back", 2, 0.0);
  Simulation simulation(blocks::world(), bar.scene());
  const Solution& solution = simulation.solve();
  out << solution.failure << "\n";
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  const double strain = 100.0 / 2e6;
  const auto exact = [&](const Point& x) { return Point{strain * x[0], -0.25 * strain * (x[1] - 0.5), -0.25 * strain * (x[2] - 0.5)}; };
  TEST_COMPARE(distanceFrom(simulation, exact), <, 1e-8 * strain);
  TEST_FLOATING_EQUALITY(solution.verification.reactions.loads[1].force[0], -100.0, 1e-8);

  bar.model.loads.pop_back();  // the bar can turn about its axis
  TEST_ASSERT(names(refusalOf(bar.scene()), "body 'bar' can turn about"));
}

TEUCHOS_UNIT_TEST(MeanSupports, HoldAPulledCylinder) {
  MeanScene cylinder({{"rod", 0, 1, 0, 2, 4, 6, Cell::Quadrilateral8}}, PlaneModel::Strain);
  cylinder.model.axisymmetric = true;
  cylinder.addBodies(2e6, 0.25);
  cylinder.model.loads = {Load::traction("rod_top", {0.0, 100.0, 0.0})};
  cylinder.mean("rod_bottom", 1, 0.5);
  Simulation simulation(blocks::world(), cylinder.scene());
  const Solution& solution = simulation.solve();
  out << solution.failure << "\n";
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  const double strain = 100.0 / 2e6;
  TEST_COMPARE(distanceFrom(simulation,
                            [&](const Point& x) {
                              return Point{-0.25 * strain * x[0], 0.5 + strain * x[1], 0.0};
                            }),
               <, 1e-8 * strain);
  TEST_FLOATING_EQUALITY(solution.verification.reactions.loads[1].force[1], -100.0 * M_PI, 1e-8);
}

// Two means of the same direction stretch a bar that carries a body force b: u'' = -b / E between them, with the mean's force at the
// ends.
TEUCHOS_UNIT_TEST(MeanSupports, StretchABarBetweenThem) {
  MeanScene bar({{"bar", 0, 2, 0, 1, 8, 4, Cell::Quadrilateral8}});
  bar.addBodies(2e6, 0.0);
  bar.model.loads = {Load::bodyForce({50.0, 0.0, 0.0})};
  bar.mean("bar_left", 0, 0.0), bar.mean("bar_right", 0, 1e-4), bar.mean("bar_left", 1, 0.0), bar.mean("bar_right", 1, 0.0);
  Simulation simulation(blocks::world(), bar.scene());
  const Solution& solution = simulation.solve();
  out << solution.failure << "\n";
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  TEST_COMPARE(distanceFrom(simulation,
                            [](const Point& x) {
                              return Point{5e-5 * x[0] + 12.5e-6 * x[0] * (2.0 - x[0]), 0.0, 0.0};
                            }),
               <, 1e-12);
  TEST_FLOATING_EQUALITY(solution.verification.reactions.loads[1].force[0], -150.0, 1e-7);  // -(E d / l + b l / 2)
  TEST_FLOATING_EQUALITY(solution.verification.reactions.loads[2].force[0], 50.0, 1e-7);
}

// A spring that is much softer than the body exerts a uniform traction, too: the fields differ by a translation only.
TEUCHOS_UNIT_TEST(MeanSupports, EqualASoftSpringUpToATranslation) {
  MeanScene mean({{"block", 0, 2, 0, 1, 8, 4, Cell::Quadrilateral8}});
  mean.addBodies(2e6, 0.3);
  mean.held = {Condition::pointSupport({0, 0.5, 0}, {0}, {1}), Condition::pointSupport({2, 0.5, 0}, {0}, {1})};
  mean.held.back().name = "other point";
  mean.model.loads = {Load::traction("block_right", {0.0, 0.0, 0.0})};
  mean.model.loads[0].expressions = {Expression("100*(y - y^2)"), Expression("0")};
  MeanScene spring = mean;
  mean.mean("block_left", 0, 0.0);
  spring.model.supports = {{{"block_left"}, 1.0, 0.0}};
  Simulation a(blocks::world(), mean.scene()), b(blocks::world(), spring.scene());
  a.solve(), b.solve();
  TEST_ASSERT(a.ending() == ExitCode::Done && b.ending() == ExitCode::Done);
  TEST_FLOATING_EQUALITY(a.solution().verification.reactions.loads[1].force[0], -100.0 / 6.0, 1e-8);
  double mine[4] = {-1e300, -1e300, 0.0, 0.0}, all[4];  // largest difference along x, and negated least one; along y; size of the field
  for (std::size_t i = 0; i < a.meshes().size(); ++i)
    for (int node = 0; node < a.meshes()[i].nodes(); ++node) {
      const auto at = [&](const Simulation& one, int k) {
        return one.meshes()[i].total(one.solution().displacement[i], 2 * Eigen::Index(node) + k);
      };
      const double x = at(b, 0) - at(a, 0);
      mine[0] = std::max(mine[0], x), mine[1] = std::max(mine[1], -x);
      mine[2] = std::max(mine[2], std::abs(at(b, 1) - at(a, 1)));
      mine[3] = std::max(mine[3], std::abs(at(a, 1)));
    }
  Teuchos::reduceAll(*blocks::world(), Teuchos::REDUCE_MAX, 4, mine, all);
  TEST_COMPARE(all[0] + all[1], <, 1e-5 * all[3]);
  TEST_COMPARE(all[2], <, 1e-5 * all[3]);
  TEST_FLOATING_EQUALITY(all[0], 100.0 / 6.0, 1e-5);  // force over stiffness
}

/// A block of 2 x 1 under its weight on an obstacle, pushed to the right; the mean of its left side holds it.
MeanScene pushedBlock() {
  MeanScene block({{"block", 0, 2, 0, 1, 8, 4, Cell::Quadrilateral4}});
  block.addBodies(2e6, 0.0);
  block.model.loads = {Load::bodyForce({0.0, -30.0, 0.0}), Load::traction("block_right", {8.0, 0.0, 0.0})};
  block.mean("block_left", 0, -0.25);
  block.contacts = {Contact::with(Obstacle::line({0, 0, 0}, {0, 1, 0}), "block_bottom")};
  return block;
}

TEUCHOS_UNIT_TEST(MeanSupports, HoldABlockOnAnObstacleSideways) {
  for (const std::vector<std::string>& way : kMeanWays) {
    Simulation simulation(blocks::world(), pushedBlock().scene(way));
    const Solution& solution = simulation.solve();
    out << solution.failure << "\n";
    TEST_ASSERT(simulation.ending() == ExitCode::Done);
    TEST_FLOATING_EQUALITY(solution.verification.reactions.loads[2].force[0], -8.0, 1e-7);
    // Uniform tension along, the weight across: u_y = b (y - y^2 / 2) / E
    const auto exact = [](const Point& x) { return Point{-0.25 + 4e-6 * x[0], -15e-6 * (x[1] - x[1] * x[1] / 2), 0.0}; };
    TEST_COMPARE(distanceFrom(simulation, exact), <, 1e-6);
    if (blocks::world()->getRank() == 0) {
      double pressing = 0.0;
      for (const PairResult& pair : solution.pairs) pressing += pair.force;
      TEST_FLOATING_EQUALITY(pressing, 60.0, 1e-7);
    }
  }
}

// Lifted by the mean of its top: the obstacle, which holds the block at the start, has no force at the end.
TEUCHOS_UNIT_TEST(MeanSupports, LiftABlockOffItsObstacle) {
  MeanScene block = pushedBlock();
  block.mean("block_top", 1, 0.1);
  block.mean("block_left", 1, 0.1);
  Simulation simulation(blocks::world(), block.scene());
  const Solution& solution = simulation.solve();
  out << solution.failure << "\n";
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  const std::vector<Resultant>& loads = solution.verification.reactions.loads;
  TEST_FLOATING_EQUALITY(loads[3].force[1], 60.0, 1e-7);  // moments about the left side: all of the weight at the middle of the top
  TEST_COMPARE(std::abs(loads[4].force[1]), <, 1e-5);
  for (const PairResult& pair : solution.pairs) TEST_ASSERT(!pair.state.closed());
}

// Without auxiliary supports, the first force beyond the weight lifts the block away.
TEUCHOS_UNIT_TEST(MeanSupports, LiftABlockThatIsHeldSideways) {
  MeanScene block = pushedBlock();
  block.model.loads.resize(1);
  block.held = {Condition::displacement("block_left", {0}, {0})};
  block.mean("block_top", 1, 0.1);
  Simulation simulation(blocks::world(), block.scene());
  const Solution& solution = simulation.solve();
  out << solution.failure << "\n";
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  TEST_FLOATING_EQUALITY(solution.verification.reactions.loads[1].force[1], 60.0, 1e-7);
}

TEUCHOS_UNIT_TEST(MeanSupports, AreRefusedIfOtherConditionsPrescribeTheSame) {
  MeanScene bar({{"bar", 0, 2, 0, 1, 8, 4, Cell::Quadrilateral4}});
  bar.addBodies(2e6, 0.25);
  bar.held = {Condition::displacement("bar_left", {0}, {0}), Condition::displacement("bar_bottom", {0}, {1})};
  bar.mean("bar_left", 0, 1e-3);
  std::string text = refusalOf(bar.scene());
  out << text << "\n";
  TEST_ASSERT(names(text, "the mean displacement along x is already prescribed, by bar_left: it is 0, which contradicts 0.001"));

  bar.model.loads.clear();
  bar.mean("bar_right", 0, 1e-3), bar.mean("bar_right", 0, 2e-3);
  text = refusalOf(bar.scene());
  out << text << "\n";
  TEST_ASSERT(names(text,
                    "ElasticModel::loads/1: the mean displacement along x follows from that of ElasticModel::loads/2, and the values "
                    "contradict each other"));

  bar.held.pop_back();
  bar.model.loads.pop_back();
  text = refusalOf(bar.scene());
  out << text << "\n";
  TEST_ASSERT(names(text, "body 'bar' can move"));

  bar.mean("bar_right", 1, 0.0);
  TEST_EQUALITY(refusalOf(bar.scene()), "");
  TEST_ASSERT(names(refusalOf(bar.scene({"Load Steps/Times={0.5, 1}"})), "cannot be combined with Load Steps"));
}

}  // namespace
}  // namespace suture
