// All loads and elastic supports: the decomposition against the monolithic reference and closed forms, on any number of ranks.
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/base/Gather.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

#include <array>
#include <map>

namespace suture {
namespace {

std::shared_ptr<const MaterialLaw> lawOf(double young, double poisson) {
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
    model.addBody("upper", lawOf(2e6, poisson));
    model.addBody("lower", lawOf(1e7, poisson));
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

/// Displacement of a mesh node; trivially copyable.
struct Moved {
  GlobalId node;
  double u[2];
};

/// Displacements of all nodes by their numbers, on all ranks, since methods partition a scene differently.
std::map<GlobalId, std::array<double, 2>> displacementsOf(const Simulation& simulation) {
  std::vector<Moved> mine;
  for (std::size_t i = 0; i < simulation.meshes().size(); ++i) {
    const SubdomainMesh& mesh = simulation.meshes()[i];
    const Vector& u = simulation.solution().displacement[i];
    for (int node = 0; node < mesh.nodes(); ++node)
      mine.push_back({mesh.globalNodes[node], {mesh.total(u, 2 * node), mesh.total(u, 2 * node + 1)}});
  }
  Packer packer;
  packer.put(mine);
  std::map<GlobalId, std::array<double, 2>> all;
  for (const Moved& one : joined<Moved>(allGather(*blocks::world(), packer.bytes()))) all[one.node] = {one.u[0], one.u[1]};
  return all;
}

/// Largest difference of the displacements of two simulations of one scene, over the largest displacement.
double difference(const Simulation& a, const Simulation& b) {
  const auto one = displacementsOf(a), other = displacementsOf(b);
  double far = 0.0, size = 0.0;
  for (const auto& [node, u] : one)
    for (int k = 0; k < 2; ++k) {
      far = std::max(far, std::abs(u[k] - other.at(node)[k]));
      size = std::max(size, std::abs(u[k]));
    }
  return far / size;
}

/// Resultants of all rows: those of conditions, of loads, of elastic supports.
std::vector<Resultant> rowsOf(const Simulation& simulation) {
  const Reactions& all = simulation.solution().verification.reactions;
  std::vector<Resultant> rows = all.supports;
  for (const auto* more : {&all.loads, &all.springs}) rows.insert(rows.end(), more->begin(), more->end());
  return rows;
}

/// Forces and moments of all rows sum to zero, and each equals that of the reference.
void checkReactions(const Simulation& simulation, const Simulation& reference, Teuchos::FancyOStream& out, bool& success) {
  const std::vector<Resultant> own = rowsOf(simulation), other = rowsOf(reference);
  TEST_EQUALITY(own.size(), other.size());
  Resultant sum;
  double force = 0.0, moment = 0.0;
  for (const Resultant& row : other) force = std::max(force, norm(row.force)), moment = std::max(moment, norm(row.moment));
  for (std::size_t i = 0; i < own.size(); ++i) {
    sum.add(own[i]);
    TEST_COMPARE(norm(minus(own[i].force, other[i].force)), <=, 1e-8 * force);
    TEST_COMPARE(norm(minus(own[i].moment, other[i].moment)), <=, 1e-8 * moment);
  }
  if (reference.scene().model.axisymmetric) sum.force[0] = 0.0;  // a sum of magnitudes
  TEST_COMPARE(norm(sum.force), <=, 1e-9 * force);
  TEST_COMPARE(norm(sum.moment), <=, 1e-9 * moment);
}

/// All solution methods give one verified answer.
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
    checkReactions(simulation, reference, out, success);
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
  // Only springs hold the lower block, and the upper one leans against a spring.
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
  const Reactions& reactions = solution.verification.reactions;
  TEST_EQUALITY(reactions.springs.size(), 1);
  TEST_FLOATING_EQUALITY(reactions.springs[0].force[1], 2100.0, 1e-9);
  TEST_FLOATING_EQUALITY(reactions.springs[0].moment[2], 500.0 * 4.5 + 300.0 * 2.0, 1e-9);
}

TEUCHOS_UNIT_TEST(Loads, OfABodyOfRevolutionAgreeWithTheReference) {
  Stack stack;
  stack.model.axisymmetric = true;
  stack.held = {Condition::displacement("lower_bottom", {0}, {1})};
  stack.model.supports = {{{"lower_right"}, 1e5, 2e4}};
  stack.model.loads = {Load::gravity({0, -9.81, 0}), Load::rotation({0, 2.0, 0}), Load::force("upper_top", {0, -800.0, 0}),
                       Load::temperature(70.0, 20.0, "upper"), Load::initialStress({-10.0, 20.0, 5.0, 3.0}, "lower")};
  checkWays(stack, out, success);
}

TEUCHOS_UNIT_TEST(Loads, ThatAreInitialStatesHaveNoResultant) {
  Stack stack;
  stack.model.loads = {Load::temperature(80.0, 20.0, "upper"), Load::initialStress({-10.0, 20.0, 5.0, 3.0}, "lower"),
                       Load::pressure("upper_top", 900.0)};
  Simulation simulation(blocks::world(), stack.scene({}));
  const Reactions& reactions = simulation.solve().verification.reactions;
  for (const int initial : {0, 1}) {
    TEST_EQUALITY(norm(reactions.loads[initial].force), 0.0);
    TEST_EQUALITY(norm(reactions.loads[initial].moment), 0.0);
  }
  TEST_FLOATING_EQUALITY(reactions.loads[2].force[1], -1800.0, 1e-12);
}

std::string complaint(const Stack& stack) {
  Simulation simulation(blocks::world(), stack.scene({}));
  try {
    simulation.solve();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEUCHOS_UNIT_TEST(Loads, ReportsTheMotionThatAnElasticSupportLeavesFree) {
  Stack stack;
  stack.held = {Condition::displacement("lower_bottom", {0, 0})};
  stack.contacts.clear();
  stack.model.supports = {{{"upper_bottom"}, 3e5, 0.0}};
  stack.model.loads = {Load::pressure("upper_top", 300.0)};
  const std::string text = complaint(stack);
  out << text << "\n";
  TEST_ASSERT(text.find("body 'upper' can move") != std::string::npos);
  TEST_ASSERT(text.find("(1, 0)") != std::string::npos);
  stack.model.supports[0].tangential = 1e4;
  TEST_EQUALITY(complaint(stack), "");
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
  stack.model.addBody("lower", lawOf(1e7, 0.3));
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
