// Bounds of the error with friction, elastic supports and sides that do not separate, against exact energies on any number of ranks.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/base/Expression.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/pairs/FrictionLaws.hpp>
#include <suture/simulation/Simulation.hpp>

#include <algorithm>
#include <cmath>

namespace suture {
namespace {

constexpr double kStiff = 2e6;
const std::vector<std::string> settings{"Outer Solver/Tolerance=1e-13", "Partition/METIS/Subdomains=4", "Output/Error Bound=true"};

std::shared_ptr<const ContactLaw> dryFriction(double cohesion, double coefficient) {
  return std::make_shared<DryFriction>(Expression(std::to_string(cohesion)), Expression(std::to_string(coefficient)));
}

Load variable(Load load, const std::vector<std::string>& components) {
  for (const std::string& text : components) load.expressions.emplace_back(text, Constants());
  return load;
}

struct BoundedRun {
  ErrorBound bound;
  double energy = 0.0;
};

BoundedRun found(const Scene& scene, Teuchos::FancyOStream& out) {
  Simulation simulation(blocks::world(), scene);
  const Solution& solution = simulation.solve();
  for (const std::string& reason : solution.bound.value().reasons) out << reason << "\n";
  return {solution.bound.value(), solution.energy};
}

/// A square block on a rigid floor whose top moves down and to the right, so that it slips everywhere. Without Poisson's effect, with
/// tractions on its sides and a force f to the right per volume, its shear stress is g - f y, g the friction stress.
struct SlidingBlock {
  Cell cell = Cell::Triangle3;
  int cells = 4;
  double force = 0.0;
  static constexpr double young = kStiff, shear = kStiff / 2, pressure = 1e3, friction = 300, moved = 2e-3;

  Scene scene(std::shared_ptr<const ContactLaw> law) const {
    ElasticModel model;
    model.addBody("a", std::make_shared<IsotropicLaw>(IsotropicModuli{young, 0.0}));
    const std::string stress = std::to_string(friction) + "-" + std::to_string(force) + "*y";
    model.loads = {variable(Load::traction("a_right", {0, 0, 0}), {"0", stress}),
                   variable(Load::traction("a_left", {0, 0, 0}), {"0", "-(" + stress + ")"})};
    if (force != 0.0) model.loads.push_back(Load::bodyForce({force, 0, 0}));
    Scene scene = makeScene(
        model,
        [*this] {
          return boxes({{"a", 0, 1, 0, 1, cells, cells, cell}});
        },
        {Condition::displacement("a_top", {moved, -pressure / young})}, {Contact::with(Obstacle::line({0, 0, 0}, {0, 1, 0}), "a_bottom")},
        settings);
    scene.laws = ContactLaws({law});
    return scene;
  }
  double slip() const { return moved - (friction - force / 2) / shear; }
  /// Potential energy and friction bound times slip.
  double energy() const {
    const double g = friction, f = force;
    return (g * g - g * f + f * f / 3) / (2 * shear) + pressure * pressure / (2 * young) - f * (moved - (g / 2 - f / 3) / shear) +
           g * slip();
  }
};

bool onlyFriction(const ErrorBound& bound) { return bound.reasons.size() == 1 && bound.reasons[0].find("friction: proved for") == 0; }

/// Difference between the given bounds of friction and those of the contact forces, from the reason.
double changeOf(const ErrorBound& bound) {
  const std::string &reason = bound.reasons.at(0), before = "solution by ";
  return std::stod(reason.substr(reason.find(before) + before.size()));
}

TEUCHOS_UNIT_TEST(FrictionBounds, VanishForAUniformShear) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8}) {
    const SlidingBlock block{cell};
    const ErrorBound tresca = found(block.scene(dryFriction(SlidingBlock::friction, 0.0)), out).bound;
    TEST_ASSERT(tresca.strict);
    TEST_COMPARE(tresca.relative(), <, 1e-7);
    const ErrorBound coulomb = found(block.scene(dryFriction(0.0, SlidingBlock::friction / SlidingBlock::pressure)), out).bound;
    TEST_ASSERT(onlyFriction(coulomb));
    TEST_COMPARE(coulomb.relative(), <, 1e-7);
    TEST_COMPARE(changeOf(coulomb), <, 1e-9);
  }
}

// With a force per volume the displacement is quadratic: known error of first-order elements, none of second-order ones.
TEUCHOS_UNIT_TEST(FrictionBounds, ExceedTheErrorOfASlidingBlock) {
  for (const int cells : {4, 8})
    for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral9}) {
      const SlidingBlock block{cell, cells, 500};
      const BoundedRun one = found(block.scene(dryFriction(SlidingBlock::friction, 0.0)), out);
      const double upper = one.bound.energyUpper, square = 2 * (upper - block.energy());
      TEST_ASSERT(one.bound.strict);
      TEST_COMPARE(std::abs(upper - one.energy - SlidingBlock::friction * block.slip()), <, 0.02 * std::abs(upper));
      if (cellInfo(cell).order == 2) {
        TEST_COMPARE(one.bound.relative(), <, 1e-7);
        TEST_FLOATING_EQUALITY(upper, block.energy(), 1e-9);
        continue;
      }
      out << "effectivity " << one.bound.total / std::sqrt(square) << "\n";
      TEST_COMPARE(square, >, 1e-4 * one.bound.solutionNorm * one.bound.solutionNorm);
      TEST_COMPARE(one.bound.total, >=, std::sqrt(square));
      TEST_COMPARE(one.bound.total, <=, 1.6 * std::sqrt(square));
      TEST_COMPARE(one.bound.energyLower, <=, block.energy());
    }
}

/// Two blocks of equal width, the upper one pressed and pushed: it slips in part.
Scene pushedBlocks(Cell cell, int cells, std::shared_ptr<const ContactLaw> law) {
  ElasticModel model;
  std::vector<Box> all{{"a", 0, 2, -1, 0, 2 * cells, cells, cell}, {"b", 0, 2, 0, 1, 2 * cells, cells, cell}};
  model.dimension = dimensionOf(cell);
  for (Box& box : all) {
    box.z1 = 0.5;
    box.nz = std::max(1, cells / 2);
    model.addBody(box.name, std::make_shared<IsotropicLaw>(IsotropicModuli{kStiff, 0.2}));
  }
  std::vector<Condition> held;
  if (model.dimension == 3) {
    for (Box& box : all) std::swap(box.y0, box.z0), std::swap(box.y1, box.z1), std::swap(box.ny, box.nz);
    held = {Condition::displacement("a_bottom", {0, 0, 0}, {0, 1, 2}), Condition::displacement("b_top", {1.5e-3, 0, -3e-3}, {0, 1, 2})};
  } else {
    held = {Condition::displacement("a_bottom", {0, 0}), Condition::displacement("b_top", {1.5e-3, -3e-3})};
  }
  Scene scene = makeScene(
      model, [all] { return boxes(all); }, held, {Contact::between("b_bottom", "a_top")}, settings);
  scene.laws = ContactLaws({law});
  return scene;
}

// The energy of the exact solution lies in the intervals of all meshes.
TEUCHOS_UNIT_TEST(FrictionBounds, HaveIntervalsThatMeet) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8}) {
    double lower = -1e300, upper = 1e300;
    for (const int cells : {2, 4, 8}) {
      const BoundedRun one = found(pushedBlocks(cell, cells, dryFriction(420.0, 0.0)), out);
      out << static_cast<int>(cell) << " " << cells << ": " << one.bound.relative() << " [" << one.bound.energyLower << ", "
          << one.bound.energyUpper << "]\n";
      TEST_ASSERT(one.bound.strict);
      TEST_COMPARE(one.bound.energyUpper, >, one.energy + 1e-3 * std::abs(one.energy));  // it slips
      lower = std::max(lower, one.bound.energyLower);
      upper = std::min(upper, one.bound.energyUpper);
      TEST_COMPARE(lower, <=, upper);
    }
    TEST_COMPARE(upper - lower, <, 0.03 * std::abs(upper));
  }
}

TEUCHOS_UNIT_TEST(FrictionBounds, AreEstimatesForFrictionThatDependsOnPressure) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Tetrahedron4}) {
    const BoundedRun one = found(pushedBlocks(cell, 4, dryFriction(100.0, 0.1)), out);
    out << one.bound.relative() << " change " << changeOf(one.bound) << "\n";
    TEST_ASSERT(onlyFriction(one.bound));
    TEST_COMPARE(changeOf(one.bound), >=, 0.0);
    TEST_COMPARE(changeOf(one.bound), <, cell == Cell::Tetrahedron4 ? 0.3 : 0.05);
    TEST_COMPARE(one.bound.relative(), <, 0.5);
  }
}

/// Boxes of height one on top of each other between smooth walls.
struct SupportedColumn {
  Cell cell;
  int cells, boxes;

  /// \param softness  stiffness of the contacts; 0: hard
  Scene scene(const ElasticModel& loads, std::shared_ptr<const ContactLaw> law = nullptr, bool onSprings = false,
              double softness = 0.0) const {
    const int dimension = dimensionOf(cell);
    ElasticModel model = loads;
    model.dimension = dimension;
    std::vector<Box> all;
    std::vector<Condition> held;
    std::vector<Contact> contacts;
    for (int i = 0; i < boxes; ++i) {
      Box box{std::string(1, char('a' + i)), 0, 1, 0, 1, cells, cells, cell};
      box.nz = cells;
      (dimension == 2 ? box.y0 : box.z0) = i;
      (dimension == 2 ? box.y1 : box.z1) = i + 1;
      model.addBody(box.name, std::make_shared<IsotropicLaw>(IsotropicModuli{kStiff, 0.3}));
      model.materialOfBody.back().enhanced = false;  // so that the energy of the solver is that of the displacement
      for (const char* side : {"_left", "_right"}) held.push_back(Condition::bilateral(box.name + side));
      if (dimension == 3)
        for (const char* side : {"_front", "_back"}) held.push_back(Condition::bilateral(box.name + side));
      all.push_back(box);
      if (i > 0) contacts.push_back(Contact::between(all[i].name + "_bottom", all[i - 1].name + "_top"));
      if (i > 0 && softness > 0.0) contacts.back().overclosure = Overclosure::linear(softness);
    }
    if (!onSprings) held.push_back(Condition::bilateral("a_bottom"));
    Scene scene = makeScene(
        model, [all] { return suture::boxes(all); }, held, contacts, settings);
    if (law) scene.laws = ContactLaws(std::vector<std::shared_ptr<const ContactLaw>>(contacts.size(), law));
    return scene;
  }
};

const double kColumn = kStiff * 0.7 / (1.3 * 0.4);  // stress for a unit strain without lateral strain
constexpr double kHeavy = 3e3;

ElasticModel heavy(int dimension) {
  ElasticModel model;
  model.loads = {Load::bodyForce(dimension == 2 ? Point{0, -kHeavy, 0} : Point{0, 0, -kHeavy})};
  return model;
}

/// Elements of second order represent these columns exactly; the error of those of first order is known from the energies.
void checkError(const BoundedRun& one, double exact, Cell cell, Teuchos::FancyOStream& out, bool& success) {
  if (cellInfo(cell).order == 2) {
    TEST_COMPARE(one.bound.relative(), <, 1e-7);
    TEST_FLOATING_EQUALITY(one.energy, exact, 1e-9);
    return;
  }
  const double error = std::sqrt(2 * (one.energy - exact));
  out << "effectivity " << one.bound.total / error << "\n";
  TEST_COMPARE(one.bound.total, >=, error);
  TEST_COMPARE(one.bound.total, <=, 1.7 * error);
}

// Two boxes that do not separate, also where they pull at each other, have the energy of one column.
TEUCHOS_UNIT_TEST(FrictionBounds, HoldWhereSidesDoNotSeparate) {
  for (const auto& law : std::vector<std::shared_ptr<const ContactLaw>>{std::make_shared<Tied>(), std::make_shared<NoSeparation>()})
    for (const auto& [cell, cells] :
         {std::pair(Cell::Triangle3, 6), std::pair(Cell::Triangle6, 3), std::pair(Cell::Tetrahedron4, 3), std::pair(Cell::Tetrahedron10, 2),
          std::pair(Cell::Quadrilateral4, 6), std::pair(Cell::Quadrilateral8, 3)})
      for (const double pull : {0.0, 2e4}) {
        ElasticModel model = heavy(dimensionOf(cell));
        if (pull > 0.0) model.loads.push_back(Load::pressure("b_top", -pull));
        const BoundedRun one = found(SupportedColumn{cell, cells, 2}.scene(model, law), out);
        // Strain (pull - w (2 - y)) / E'.
        const double w = kHeavy, exact = -(2 * pull * pull - 4 * pull * w + w * w * 8 / 3) / (2 * kColumn);
        TEST_ASSERT(one.bound.strict);
        checkError(one, exact, cell, out, success);
      }
}

// A column on springs under its weight sinks by w / k; a block on springs along its side moves to the right.
TEUCHOS_UNIT_TEST(FrictionBounds, HoldOnElasticSupports) {
  const double stiffness = 5e5;
  for (const auto& [cell, cells] : {std::pair(Cell::Triangle3, 6), std::pair(Cell::Triangle6, 3), std::pair(Cell::Tetrahedron4, 3),
                                    std::pair(Cell::Quadrilateral4, 6), std::pair(Cell::Quadrilateral8, 3)}) {
    ElasticModel model = heavy(dimensionOf(cell));
    model.supports = {{{"a_bottom"}, stiffness, 0.0}};
    const BoundedRun one = found(SupportedColumn{cell, cells, 1}.scene(model, nullptr, true), out);
    const double exact = -kHeavy * kHeavy / (2 * stiffness) - kHeavy * kHeavy / (6 * kColumn);
    TEST_ASSERT(one.bound.strict);
    TEST_COMPARE(one.bound.energyLower, <=, exact + 1e-9 * std::abs(exact));
    TEST_COMPARE(one.bound.energyUpper, >=, exact - 1e-9 * std::abs(exact));
    // Energy norm with the springs: twice the energy of a body without prescribed displacements.
    TEST_FLOATING_EQUALITY(one.bound.solutionNorm * one.bound.solutionNorm, -2 * one.energy, 1e-8);
    checkError(one, exact, cell, out, success);
  }
}

// Springs between the boxes, pressed by the weight of the upper one.
TEUCHOS_UNIT_TEST(FrictionBounds, HoldForSoftenedContact) {
  const double stiffness = 2e5;
  for (const auto& [cell, cells] : {std::pair(Cell::Triangle3, 6), std::pair(Cell::Triangle6, 3), std::pair(Cell::Tetrahedron4, 3),
                                    std::pair(Cell::Quadrilateral4, 6), std::pair(Cell::Quadrilateral8, 3)}) {
    const BoundedRun one = found(SupportedColumn{cell, cells, 2}.scene(heavy(dimensionOf(cell)), nullptr, false, stiffness), out);
    const double exact = -kHeavy * kHeavy * (8.0 / 6 / kColumn + 1 / (2 * stiffness));
    TEST_ASSERT(one.bound.strict);
    TEST_FLOATING_EQUALITY(one.bound.solutionNorm * one.bound.solutionNorm, -2 * one.energy, 1e-8);
    TEST_COMPARE(one.bound.energyLower, <=, exact + 1e-9 * std::abs(exact));
    checkError(one, exact, cell, out, success);
  }
}

/// A block, turned by an angle, on springs below that resist both ways: pushed along its top, with the tractions of a uniform shear.
TEUCHOS_UNIT_TEST(FrictionBounds, VanishForAShearedBlockOnSprings) {
  for (const double angle : {0.0, 0.5}) {
    const double c = std::cos(angle), s = std::sin(angle), push = 700, press = 400;
    ElasticModel model;
    model.addBody("a", std::make_shared<IsotropicLaw>(IsotropicModuli{kStiff, 0.0}));
    const auto turned = [&](double x, double y) { return Point{c * x - s * y, s * x + c * y, 0}; };
    model.loads = {Load::traction("a_top", turned(push, -press)), Load::traction("a_right", turned(0, push)),
                   Load::traction("a_left", turned(0, -push))};
    model.supports = {{{"a_bottom"}, 3e5, 4e5}};
    Scene scene = makeScene(
        model,
        [=] {
          Mesh mesh = boxes({{"a", 0, 1, 0, 1, 4, 4, Cell::Triangle3}});
          for (int node = 0; node < mesh.nodes(); ++node) {
            const Point place = turned(mesh.coordinates[2 * std::size_t(node)], mesh.coordinates[2 * std::size_t(node) + 1]);
            mesh.coordinates[2 * std::size_t(node)] = place[0], mesh.coordinates[2 * std::size_t(node) + 1] = place[1];
          }
          return mesh;
        },
        {}, {}, settings);
    const BoundedRun one = found(scene, out);
    const double exact = -(push * push / 4e5 + press * press / 3e5 + push * push / (kStiff / 2) + press * press / kStiff) / 2;
    TEST_ASSERT(one.bound.strict);
    TEST_COMPARE(one.bound.relative(), <, 1e-7);
    TEST_FLOATING_EQUALITY(one.energy, exact, 1e-9);
  }
}

}  // namespace
}  // namespace suture
