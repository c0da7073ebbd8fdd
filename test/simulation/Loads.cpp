// All loads and elastic supports: the decomposition against the monolithic reference and closed forms, on any number of ranks.
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

namespace suture {
namespace {

std::shared_ptr<const MaterialLaw> isotropic(double young, double poisson) {
  return std::make_shared<IsotropicLaw>(IsotropicModuli{young, poisson});
}

double overRanks(Teuchos::EReductionType how, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(*blocks::world(), how, mine, Teuchos::outArg(all));
  return all;
}

/// A block on another one, [0, 2] x [0, 1] on [0, 3] x [-1, 0], of second order.
struct Stack {
  ElasticModel model;
  std::vector<Condition> held{Condition::displacement("lower_bottom", {0, 0}), Condition::displacement("upper_left", {0}, {0})};
  std::vector<Contact> contacts{Contact::between("upper_bottom", "lower_top")};

  Stack(double poisson = 0.3, PlaneModel plane = PlaneModel::Strain) {
    model.plane = plane;
    model.addBody("upper", isotropic(2e6, poisson));
    model.addBody("lower", isotropic(1e7, poisson));
    for (Material& material : model.materialOfBody) material.density = 5.0, material.expansion = 2e-5;
  }

  static Mesh mesh() {
    std::vector<Box> all{{"upper", 0, 2, 0, 1, 8, 4}, {"lower", 0, 3, -1, 0, 9, 4}};
    for (Box& box : all) box.cell = Cell::Quadrilateral8;
    return boxes(all);
  }
  Scene scene(std::vector<std::string> settings) const {
    for (const char* more : {"Outer Solver/Tolerance=1e-11", "Partition/METIS/Subdomains=5"}) settings.push_back(more);
    return makeScene(model, mesh, held, contacts, settings);
  }
};

/// Largest difference of the displacements of two simulations of one scene, over the largest displacement.
double difference(const Simulation& a, const Simulation& b) {
  double far = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.meshes().size(); ++i) {
    const SubdomainMesh &one = a.meshes()[i], &other = b.meshes()[i];
    const Vector &u = a.solution().displacement[i], &v = b.solution().displacement[i];
    for (Eigen::Index k = 0; k < u.size(); ++k) {
      far = std::max(far, std::abs(one.total(u, k) - other.total(v, k)));
      size = std::max(size, std::abs(other.total(v, k)));
    }
  }
  return overRanks(Teuchos::REDUCE_MAX, far) / overRanks(Teuchos::REDUCE_MAX, size);
}

/// All ways of solving give one verified answer.
void checkWays(const Stack& stack, Teuchos::FancyOStream& out, bool& success) {
  Simulation reference(blocks::world(), stack.scene({"Outer Solver/Type=Monolithic"}));
  reference.solve();
  out << "monolithic: " << reference.solution().failure << "\n";
  TEST_ASSERT(reference.ending() == ExitCode::Done);
  const std::vector<std::vector<std::string>> ways{
      {"Outer Solver/Type=Active Set"},
      {"Outer Solver/Type=Active Set", "Preconditioner/Type=Neumann-Neumann"},
      {"Formulation=Condensed Groups", "Outer Solver/Type=Semismooth Newton", "Preconditioner/Type=Neumann-Neumann"}};
  for (const std::vector<std::string>& way : ways) {
    Simulation simulation(blocks::world(), stack.scene(way));
    simulation.solve();
    out << way.back() << ": " << simulation.solution().failure << "\n";
    TEST_ASSERT(simulation.ending() == ExitCode::Done);
    TEST_COMPARE(difference(simulation, reference), <, 1e-8);
    const Balance &own = simulation.solution().verification.balance, &other = reference.solution().verification.balance;
    TEST_COMPARE(own.imbalance, <, 1e-8);
    TEST_COMPARE(norm(minus(own.applied, other.applied)), <=, 1e-8 * (norm(other.applied) + 1.0));
    TEST_COMPARE(norm(minus(own.reactions, other.reactions)), <=, 1e-6 * (norm(other.reactions) + 1.0));
  }
}

TEUCHOS_UNIT_TEST(Loads, OnMassAgreeWithTheReference) {
  Stack stack;
  stack.model.loads = {Load::gravity({0, -9.81, 0}), Load::rotation({0, 0, 2.0}, {1.0, 3.0, 0}, "upper")};
  checkWays(stack, out, success);
}

TEUCHOS_UNIT_TEST(Loads, ThatAreResultantsAgreeWithTheReference) {
  Stack stack(0.3, PlaneModel::Stress);
  stack.model.loads = {Load::force("upper_top", {30.0, -500.0, 0}), Load::moment("upper_right", 20.0),
                       Load::pointForce({3.0, 0.0, 0}, {5.0, -7.0, 0})};
  checkWays(stack, out, success);
}

TEUCHOS_UNIT_TEST(Loads, OfTemperatureAndStrainAgreeWithTheReference) {
  for (const double poisson : {0.3, 0.4999}) {
    Stack stack(poisson);
    Load heat = Load::temperature(0.0, 20.0, "upper");
    heat.expressions = {Expression([](const Point& p) { return 80.0 + 30.0 * p[0] - 10.0 * p[1] * p[1]; })};
    stack.model.loads = {heat, Load::initialStrain({0.0, 1e-3, 0.0, 2e-4}, "lower"), Load::initialStress({-10.0, 20.0, 5.0, 3.0}, "upper"),
                         Load::pressure("upper_top", 900.0)};
    checkWays(stack, out, success);
  }
}

TEUCHOS_UNIT_TEST(Loads, OnElasticSupportsAgreeWithTheReference) {
  // Nothing but springs holds the lower block, and the upper one leans against a spring.
  Stack stack;
  stack.held.clear();
  stack.model.supports = {{{"lower_bottom"}, 3e5, 1e4}, {{"upper_left"}, 1e5, 0.0}};
  stack.model.loads = {Load::gravity({0, -9.81, 0}), Load::force("upper_top", {-20.0, -300.0, 0})};
  checkWays(stack, out, success);
}

TEUCHOS_UNIT_TEST(Loads, SinkIntoABedByPressureOverStiffness) {
  Stack stack(0.0);
  stack.held.clear();
  stack.contacts.clear();
  stack.model.supports = {{{"lower_bottom", "upper_bottom"}, 2e5, 1e3}};
  stack.model.loads = {Load::pressure("lower_top", 500.0), Load::pressure("upper_top", 300.0)};
  Simulation simulation(blocks::world(), stack.scene({}));
  const Solution& solution = simulation.solve();
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  double wrong = 0.0;
  for (std::size_t i = 0; i < simulation.meshes().size(); ++i) {
    const SubdomainMesh& mesh = simulation.meshes()[i];
    const bool lower = mesh.body == 1;
    const double pressure = lower ? 500.0 : 300.0, young = lower ? 1e7 : 2e6, foot = lower ? -1.0 : 0.0;
    for (int node = 0; node < mesh.nodes(); ++node) {
      const double expected = -pressure / 2e5 - pressure / young * (mesh.point(node)[1] - foot);
      wrong = std::max(wrong, std::abs(solution.displacement[i][2 * node + 1] - expected));
      wrong = std::max(wrong, std::abs(solution.displacement[i][2 * node]));
    }
  }
  TEST_COMPARE(overRanks(Teuchos::REDUCE_MAX, wrong), <, 1e-10 * 500.0 / 2e5);
  TEST_FLOATING_EQUALITY(solution.verification.balance.reactions[1], 2100.0, 1e-9);
}

TEUCHOS_UNIT_TEST(Loads, DoNotMoveRockThatCarriesItsWeight) {
  Stack stack;
  stack.held = {Condition::bilateral("lower_bottom"), Condition::bilateral("lower_left"), Condition::bilateral("lower_right")};
  stack.contacts.clear();
  Load in = Load::initialStress({0, 0, 0, 0}, "lower");
  const double weight = 5.0 * 9.81;
  const auto vertical = [=](const Point& p) { return weight * p[1]; };
  const auto across = [=](const Point& p) { return 0.7 * weight * p[1]; };
  const auto none = [](const Point&) { return 0.0; };
  in.expressions = {Expression(across), Expression(vertical), Expression(across), Expression(none)};
  stack.model = ElasticModel();
  stack.model.addBody("lower", isotropic(1e7, 0.3));
  stack.model.materialOfBody[0].density = 5.0;
  stack.model.loads = {Load::gravity({0, -9.81, 0}), in};
  const auto mesh = [] {
    Box box{"lower", 0, 3, -1, 0, 9, 4};
    box.cell = Cell::Quadrilateral4;
    return boxes({box});
  };
  Simulation simulation(blocks::world(), makeScene(stack.model, mesh, stack.held, {}, {"Partition/METIS/Subdomains=5"}));
  const Solution& solution = simulation.solve();
  out << solution.failure << "\n";
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  double moved = 0.0;
  for (const Vector& u : solution.displacement) moved = std::max(moved, u.lpNorm<Eigen::Infinity>());
  TEST_COMPARE(overRanks(Teuchos::REDUCE_MAX, moved), <, 1e-12 * weight / 1e7);
}

TEUCHOS_UNIT_TEST(Loads, OfTemperatureOnABodyThatMayNotGrowAreReactionsOnly) {
  Stack stack;
  stack.contacts.clear();
  stack.held.clear();
  for (const char* side : {"left", "right", "bottom", "top"})
    for (const char* body : {"upper_", "lower_"}) stack.held.push_back(Condition::displacement(std::string(body) + side, {0, 0}));
  stack.model.loads = {Load::temperature(50.0, 0.0)};
  Simulation simulation(blocks::world(), stack.scene({}));
  const Solution& solution = simulation.solve();
  out << solution.failure << "\n";
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  double moved = 0.0;
  for (const Vector& u : solution.displacement) moved = std::max(moved, u.lpNorm<Eigen::Infinity>());
  TEST_COMPARE(overRanks(Teuchos::REDUCE_MAX, moved), <, 1e-12 * 2e-5 * 50.0);
  TEST_COMPARE(norm(solution.verification.balance.applied), <, 1e-9);
}

}  // namespace
}  // namespace suture
