// Strict bounds of forces and displacements against exact values, on any number of ranks.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

#include <algorithm>
#include <cmath>

namespace suture {
namespace {

constexpr double kYoungOfColumn = 2e6, kPoissonOfColumn = 0.3, kWeightOfColumn = 3e4, kPushed = 0.01, kPressed = 2e4;
constexpr double kHeightOfColumn = 2.0;
/// Stress for a unit strain without lateral strain.
const double kUniaxialOfColumn = kYoungOfColumn * (1 - kPoissonOfColumn) / ((1 + kPoissonOfColumn) * (1 - 2 * kPoissonOfColumn));

/// Two boxes of height one, one upon the other, on a smooth floor between smooth walls, under their weight; at the top pressed, or moved.
Scene column(Cell cell, int cells, bool isMoved, const std::vector<std::string>& settings) {
  Box lower{"a", 0, 1, 0, 1, cells, cells, cell}, upper = lower;
  lower.nz = upper.nz = cells;
  upper.name = "b";
  const int dimension = dimensionOf(cell);
  (dimension == 2 ? upper.y0 : upper.z0) = 1;
  (dimension == 2 ? upper.y1 : upper.z1) = 2;
  ElasticModel model;
  model.dimension = dimension;
  std::vector<Condition> held;
  for (const Box* box : {&lower, &upper}) {
    model.addBody(box->name, std::make_shared<IsotropicLaw>(IsotropicModuli{kYoungOfColumn, kPoissonOfColumn}));
    for (const char* side : {"_left", "_right"}) held.push_back(Condition::bilateral(box->name + side));
    if (dimension == 3)
      for (const char* side : {"_front", "_back"}) held.push_back(Condition::bilateral(box->name + side));
  }
  held.push_back(Condition::bilateral("a_bottom"));
  if (isMoved) held.push_back(Condition::displacement("b_top", {-kPushed}, {dimension - 1}));
  Point weight{0, 0, 0};
  weight[static_cast<std::size_t>(dimension - 1)] = -kWeightOfColumn;
  model.loads = {Load::bodyForce(weight)};
  model.loads.back().name = "weight";
  if (!isMoved) {
    model.loads.push_back(Load::pressure("b_top", kPressed));
    model.loads.back().name = "press";
  }
  std::vector<std::string> all = settings;
  all.push_back("Partition/METIS/Subdomains=4");
  return makeScene(
      model,
      [lower, upper] {
        return boxes({lower, upper});
      },
      held, {Contact::between("b_bottom", "a_top")}, all);
}

const ForceInterval& named(const std::vector<ForceInterval>& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](const ForceInterval& one) { return one.name == name; });
}

struct Expected {
  std::string name;
  int component;
  double force;
};

std::vector<ForceInterval> intervalsOf(const Scene& scene, double& error) {
  Simulation simulation(blocks::world(), scene);
  const Solution& solution = simulation.solve();
  error = solution.bound.value().relative();
  return solution.intervals;
}

void requireForces(const Scene& scene, const std::vector<Expected>& expected, double largest, Teuchos::FancyOStream& out, bool& success) {
  double error = 0.0;
  const std::vector<ForceInterval> found = intervalsOf(scene, error);
  for (const Expected& one : expected) {
    const ForceInterval& own = named(found, one.name);
    out << one.name << ": " << own.reason << "\n";
    TEST_EQUALITY(own.reason, "");
    const Interval force = own.force[static_cast<std::size_t>(one.component)].value();
    out << one.name << " " << force.low << " " << one.force << " " << force.high << ", error " << error << "\n";
    TEST_COMPARE(force.low, <=, one.force + 1e-6 * largest);
    TEST_COMPARE(force.high, >=, one.force - 1e-6 * largest);
    TEST_COMPARE(force.high - force.low, <=, 4 * error * largest);
  }
}

const std::vector<std::string> kAllOf{"Outer Solver/Tolerance=1e-12", "Output/Strict Error Bars={All}"};

// Stress s(y) = -E d / H - w H / 2 + w y.
TEUCHOS_UNIT_TEST(ForceIntervals, ContainTheForcesOfAMovedColumn) {
  for (const Cell cell : {Cell::Triangle3, Cell::Tetrahedron4})
    for (const bool isMonolithic : {false, true}) {
      const int axis = dimensionOf(cell) - 1;
      const double pushed = kUniaxialOfColumn * kPushed / kHeightOfColumn, weight = kWeightOfColumn * kHeightOfColumn / 2;
      const double ratio = kPoissonOfColumn / (1 - kPoissonOfColumn);
      std::vector<std::string> settings = kAllOf;
      if (isMonolithic) settings.push_back("Outer Solver/Type=Monolithic");
      requireForces(column(cell, axis == 1 ? 8 : 3, true, settings),
                    {{"a_bottom", axis, pushed + weight},
                     {"b_top", axis, -pushed + weight},
                     {"a_left", 0, ratio * (pushed + weight - kWeightOfColumn / 2)},
                     {"a_right", 0, -ratio * (pushed + weight - kWeightOfColumn / 2)},
                     {"b_bottom on a_top", axis, -pushed}},
                    pushed + weight, out, success);
    }
}

// Equilibrium determines the force of the floor; the weight of the press falls on the contact.
TEUCHOS_UNIT_TEST(ForceIntervals, ContainTheDisplacementOfAPressedColumn) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6}) {
    double error = 0.0;
    const std::vector<ForceInterval> found = intervalsOf(column(cell, 6, false, kAllOf), error);
    const double exact = (kPressed * kHeightOfColumn + kWeightOfColumn * kHeightOfColumn * kHeightOfColumn / 2) / kUniaxialOfColumn;
    const ForceInterval& press = named(found, "press");
    TEST_EQUALITY(press.reason, "");
    const Interval displacement = press.ofDisplacement.value();
    out << displacement.low << " " << exact << " " << displacement.high << ", computed " << press.displacement.value() << "\n";
    TEST_COMPARE(displacement.low, <=, exact * (1 + 1e-6));
    TEST_COMPARE(displacement.high, >=, exact * (1 - 1e-6));
    TEST_COMPARE(displacement.high - displacement.low, <=, 4 * std::max(error, 1e-6) * exact * 2);
    TEST_COMPARE(std::abs(press.displacement.value() / exact - 1), <, 0.01);
    const Interval floor = named(found, "a_bottom").force[1].value();
    const double all = kPressed + kWeightOfColumn * kHeightOfColumn;
    out << floor.low << " " << all << " " << floor.high << "\n";
    TEST_COMPARE(floor.low, <=, all * (1 + 1e-6));
    TEST_COMPARE(floor.high, >=, all * (1 - 1e-6));
    TEST_EQUALITY(named(found, "weight").reason, "it is not a traction, force or pressure on sides");
  }
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

// No bounds where J is infinite or not convex, with the reason.
TEUCHOS_UNIT_TEST(ForceIntervals, SayWhyTheyAreMissing) {
  ElasticModel model;
  model.addBody("a", std::make_shared<IsotropicLaw>(IsotropicModuli{kYoungOfColumn, kPoissonOfColumn}));
  std::vector<Condition> held{Condition::displacement("a_bottom", {0, 0}), Condition::displacement("a_left", {0, 0})};
  model.loads = {Load::pressure("a_top", kPressed)};
  for (const ElementForm form : {ElementForm::Displacement, ElementForm::Mixed}) {
    const Box box{"a", 0, 1, 0, 1, 4, 4, Cell::Triangle6};
    model.materialOfBody.front().element = form;
    const Scene scene = makeScene(model, [box] { return boxes({box}); }, held, {}, {"Output/Strict Error Bars={a_left}"});
    double error = 0.0;
    const std::vector<ForceInterval> found = intervalsOf(scene, error);
    TEST_EQUALITY(found.size(), 1u);
    TEST_ASSERT(says(found.front().reason, form == ElementForm::Displacement ? "shares nodes with another support" : "no strict bound"));
    TEST_ASSERT(!found.front().force[0]);
  }
  TEST_THROW(makeScene(model, [] { return Mesh(); }, held, {}, {"Output/Strict Error Bars={a_lefd}"}), InputError);
}

}  // namespace
}  // namespace suture
