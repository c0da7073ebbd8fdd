// Bounds of the error in the energy norm, against exact energies, on any number of ranks: 2 (J(u_h) - J(u)) = |u - u_h|^2.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

#include <cmath>

namespace suture {
namespace {

constexpr double kYoung = 2e6, kPoisson = 0.3, kWeight = 3e3;
/// Stress for a unit strain without lateral strain.
const double kUniaxial = kYoung * (1 - kPoisson) / ((1 + kPoisson) * (1 - 2 * kPoisson));

/// Boxes one upon the other on a rigid floor, between smooth walls.
struct Column {
  ElasticModel model;
  std::vector<Box> bodies;
  std::vector<Condition> held{};
  std::vector<Contact> contacts{};
  int dimension;

  explicit Column(std::vector<Box> all) : bodies(std::move(all)), dimension(dimensionOf(bodies.front().cell)) {
    model.dimension = dimension;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const std::string& name = bodies[i].name;
      model.addBody(name, std::make_shared<IsotropicLaw>(IsotropicModuli{kYoung, kPoisson}));
      for (const char* side : {"_left", "_right"}) held.push_back(Condition::bilateral(name + side));
      if (dimension == 3)
        for (const char* side : {"_front", "_back"}) held.push_back(Condition::bilateral(name + side));
      if (i > 0) contacts.push_back(Contact::between(name + "_bottom", bodies[i - 1].name + "_top"));
    }
    held.push_back(Condition::bilateral(bodies.front().name + "_bottom"));
  }
  void addWeight() { model.loads = {Load::bodyForce(dimension == 2 ? Point{0, -kWeight, 0} : Point{0, 0, -kWeight})}; }
  Scene scene(std::vector<std::string> settings = {}) const {
    for (const char* more : {"Outer Solver/Tolerance=1e-13", "Partition/METIS/Subdomains=5", "Output/Error Bound=true"})
      settings.push_back(more);
    return makeScene(
        model, [all = bodies] { return boxes(all); }, held, contacts, settings);
  }
};

Column single(Cell cell, int cells) {
  Box box{"a", 0, 1, 0, 1, cells, cells, cell};
  box.nz = cells;
  return Column({box});
}

/// Two boxes of height one.
Column pair(Cell cell, int cells) {
  Box lower{"a", 0, 1, 0, 1, cells, cells, cell}, upper = lower;
  upper.name = "b";
  lower.nz = upper.nz = cells;
  (dimensionOf(cell) == 2 ? upper.y0 : upper.z0) = 1;
  (dimensionOf(cell) == 2 ? upper.y1 : upper.z1) = 2;
  return Column({lower, upper});
}

/// Potential energy of a column of this height under its weight: strain -w (H - y) / E'.
double energyOfColumn(double height) { return -kWeight * kWeight * height * height * height / (6 * kUniaxial); }

ErrorBound boundOf(const Scene& scene, double* energy = nullptr) {
  Simulation simulation(blocks::world(), scene);
  const Solution& solution = simulation.solve();
  if (energy) *energy = solution.energy;
  return solution.bound.value();
}

// Elements of second order represent a column under its weight, those of first order a compressed one: no error, also across a contact.
TEUCHOS_UNIT_TEST(ErrorBounds, VanishForExactSolutions) {
  for (const Cell cell : {Cell::Triangle6, Cell::Tetrahedron10, Cell::Triangle3, Cell::Tetrahedron4})
    for (const bool two : {false, true}) {
      const bool quadratic = cell == Cell::Triangle6 || cell == Cell::Tetrahedron10;
      Column column = two ? pair(cell, 3) : single(cell, 3);
      column.addWeight();
      if (!quadratic) column.model.loads = {Load::pressure(column.bodies.back().name + "_top", 5e3)};
      const ErrorBound bound = boundOf(column.scene());
      out << static_cast<int>(cell) << " " << two << ": " << bound.relative() << "\n";
      for (const std::string& reason : bound.reasons) out << reason << "\n";
      TEST_ASSERT(bound.strict);
      TEST_COMPARE(bound.relative(), <, 1e-7);  // the square root of round-off in the gap
      TEST_COMPARE(bound.solutionNorm, >, 0.0);
    }
}

// A column under its weight with elements of first order: the error is known from the energies.
TEUCHOS_UNIT_TEST(ErrorBounds, ExceedTheError) {
  struct Case {
    Cell cell;
    int cells;
    double most;  // effectivity
  };
  for (const Case& one : {Case{Cell::Triangle3, 6, 1.6}, Case{Cell::Triangle3, 12, 1.6}, Case{Cell::Tetrahedron4, 3, 1.7}})
    for (const bool two : {false, true}) {
      Column column = two ? pair(one.cell, one.cells) : single(one.cell, one.cells);
      column.addWeight();
      double energy = 0.0;
      const ErrorBound bound = boundOf(column.scene(), &energy);
      const double exact = energyOfColumn(two ? 2 : 1), error = std::sqrt(2 * (energy - exact));
      out << static_cast<int>(one.cell) << " " << one.cells << ": error " << error << ", bound " << bound.total << ", effectivity "
          << bound.total / error << "\n";
      for (const std::string& reason : bound.reasons) out << reason << "\n";
      TEST_ASSERT(bound.strict);
      TEST_COMPARE(bound.total, >=, error * (1 - 1e-9));
      TEST_COMPARE(bound.total, <=, one.most * error);
      TEST_COMPARE(bound.energyLower, <=, exact + 1e-9 * std::abs(exact));
      TEST_COMPARE(bound.energyUpper, >=, exact);
      TEST_COMPARE(bound.imbalance, <, 1e-10);
    }
}

// Forces at points have no stress of finite energy; the figure is an estimate, and says why.
TEUCHOS_UNIT_TEST(ErrorBounds, AreEstimatesWithReasons) {
  Column column = single(Cell::Triangle3, 4);
  column.model.loads = {Load::pointForce({0.5, 1, 0}, {0, -100, 0})};
  const ErrorBound concentrated = boundOf(column.scene());
  TEST_ASSERT(!concentrated.strict && concentrated.exists);
  TEST_COMPARE(concentrated.reasons.size(), >, 0u);
  for (const std::string& reason : concentrated.reasons) out << reason << "\n";

  Column round = single(Cell::Triangle3, 4);
  round.model.axisymmetric = true;
  round.addWeight();
  TEST_ASSERT(!boundOf(round.scene()).strict);
}

}  // namespace
}  // namespace suture
