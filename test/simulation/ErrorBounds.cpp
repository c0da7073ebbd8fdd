// Bounds of the error in the energy norm, against exact energies, on any number of ranks: 2 (J(u_h) - J(u)) = |u - u_h|^2.
#include <Eigen/LU>
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/base/Expression.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/elasticity/OrthotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

#include <algorithm>
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

  explicit Column(std::vector<Box> all, std::shared_ptr<const MaterialLaw> law = nullptr)
      : bodies(std::move(all)), dimension(dimensionOf(bodies.front().cell)) {
    model.dimension = dimension;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      const std::string& name = bodies[i].name;
      model.addBody(name, law ? law : std::make_shared<IsotropicLaw>(IsotropicModuli{kYoung, kPoisson}));
      for (const char* side : {"_left", "_right"}) held.push_back(Condition::bilateral(name + side));
      if (dimension == 3)
        for (const char* side : {"_front", "_back"}) held.push_back(Condition::bilateral(name + side));
      if (i > 0) contacts.push_back(Contact::between(name + "_bottom", bodies[i - 1].name + "_top"));
    }
    held.push_back(Condition::bilateral(bodies.front().name + "_bottom"));
  }
  void addWeight() { model.loads = {Load::bodyForce(dimension == 2 ? Point{0, -kWeight, 0} : Point{0, 0, -kWeight})}; }
  Scene scene(const std::string& tolerance = "1e-13") const {
    return makeScene(model, [all = bodies] { return boxes(all); }, held, contacts,
                     {"Outer Solver/Tolerance=" + tolerance, "Partition/METIS/Subdomains=5", "Output/Error Bound=true"});
  }
};

Column single(Cell cell, int cells, std::shared_ptr<const MaterialLaw> law = nullptr) {
  Box box{"a", 0, 1, 0, 1, cells, cells, cell};
  box.nz = cells;
  return Column({box}, std::move(law));
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

/// Force per volume of a column of second-order elements, times -y: their displacement is of third order.
constexpr double kRisingWeight = 2e3;

/// The same with an additional force per volume -f y: stress -w (H - y) - f (H^2 - y^2) / 2, the energy is minus half the integral of its
/// square over E'.
double energyOfColumn(double height, double f) {
  const double w = kWeight, h2 = height * height, h3 = h2 * height;
  return -(w * w * h3 / 3 + f * f * h2 * h3 * 2 / 15 + w * f * h2 * h2 * 5 / 12) / (2 * kUniaxial);
}

/// The column with elements that do not enhance their strains.
Column plain(Column column) {
  for (Material& material : column.model.materialOfBody) material.enhanced = false;
  return column;
}

/// The mesh of a scene with its inner vertices moved and all edges straight; nodes at integer coordinates stay. \param most  displacement
Scene skewed(Scene scene, double most) {
  scene.mesh = [make = scene.mesh, most](const Comm& comm) {
    Mesh mesh = make(comm);
    const int d = mesh.dimension;
    const std::vector<double> old = mesh.coordinates;
    const auto wave = [&](int node, int k) { return std::sin(M_PI * old[std::size_t(node) * d + k]); };
    for (int node = 0; node < mesh.nodes(); ++node)
      for (int k = 0; k < 2; ++k)
        mesh.coordinates[std::size_t(node) * d + k] += most * (k == 0 ? 1.0 : -0.7) * wave(node, 0) * wave(node, 1);
    for (int e = 0; e < mesh.elements(); ++e) {
      const CellInfo& cell = cellInfo(mesh.cells[e]);
      const Span<const int> nodes = mesh.nodesOf(e);
      const auto middle = [&](int local, const auto& of) {
        for (int k = 0; k < d; ++k) {
          double sum = 0.0;
          for (const int i : of) sum += mesh.coordinates[std::size_t(nodes[i]) * d + k];
          mesh.coordinates[std::size_t(nodes[local]) * d + k] = sum / double(of.size());
        }
      };
      for (std::size_t i = 0; i < cell.edges.size() && cell.order == 2; ++i) middle(cell.vertices + int(i), cell.edges[i]);
      if (mesh.cells[e] == Cell::Quadrilateral9) middle(8, std::vector<int>{0, 1, 2, 3});
    }
    return mesh;
  };
  return scene;
}

ErrorBound boundOf(const Scene& scene, double* energy = nullptr) {
  Simulation simulation(blocks::world(), scene);
  const Solution& solution = simulation.solve();
  if (energy) *energy = solution.energy;
  return solution.bound.value();
}

// Elements of second order represent a column under its weight, those of first order a compressed one: no error, also across a contact.
TEUCHOS_UNIT_TEST(ErrorBounds, VanishForExactSolutions) {
  for (const Cell cell : {Cell::Triangle6, Cell::Tetrahedron10, Cell::Triangle3, Cell::Tetrahedron4, Cell::Quadrilateral4,
                          Cell::Quadrilateral8, Cell::Quadrilateral9})
    for (const bool two : {false, true}) {
      const bool quadratic = cellInfo(cell).order == 2;
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
  for (const Case& one : {Case{Cell::Triangle3, 6, 1.6}, Case{Cell::Triangle3, 12, 1.6}, Case{Cell::Tetrahedron4, 3, 1.7},
                          Case{Cell::Quadrilateral4, 6, 1.1}, Case{Cell::Quadrilateral4, 12, 1.1}})
    for (const bool two : {false, true}) {
      const Column column = [&] {
        Column all = plain(two ? pair(one.cell, one.cells) : single(one.cell, one.cells));
        all.addWeight();
        return all;
      }();
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

// Stiff along one axis: a column of timber under its weight, on its end and on its side.
TEUCHOS_UNIT_TEST(ErrorBounds, ExceedTheErrorOfOrthotropicBodies) {
  const std::array<double, 3> poisson{0.4, 0.3, 0.35}, shear{7e5, 3e5, 6e5};
  for (const std::array<double, 3>& young : {std::array<double, 3>{10e6, 8e5, 5e5}, {8e5, 10e6, 5e5}})
    for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Tetrahedron4}) {
      const double most = cell == Cell::Tetrahedron4 ? 1.7 : 1.6;
      Parameters moduli;
      moduli.set("Young Moduli", Teuchos::Array<double>(young.begin(), young.end()));
      std::array<double, 3> ratios = poisson;
      if (young[0] < young[1]) ratios = {0.4 * young[0] / young[1], 0.35, 0.3};  // nu_12 / E_1 = nu_21 / E_2
      moduli.set("Poisson Ratios", Teuchos::Array<double>(ratios.begin(), ratios.end()));
      moduli.set("Shear Moduli", Teuchos::Array<double>(shear.begin(), shear.end()));
      moduli.set("Angle", 0.0);
      Column column = single(cell, cell == Cell::Tetrahedron4 ? 3 : 6, std::make_shared<OrthotropicLaw>(moduli));
      column.addWeight();
      Eigen::Matrix3d compliance;
      compliance << 1 / young[0], -ratios[0] / young[0], -ratios[2] / young[0],  //
          -ratios[0] / young[0], 1 / young[1], -ratios[1] / young[1],            //
          -ratios[2] / young[0], -ratios[1] / young[1], 1 / young[2];
      const int up = column.dimension - 1;
      const double exact = -kWeight * kWeight / (6 * compliance.inverse()(up, up));
      double energy = 0.0;
      const ErrorBound bound = boundOf(column.scene(), &energy);
      const double error = std::sqrt(std::max(0.0, 2 * (energy - exact)));
      out << static_cast<int>(cell) << ": error " << error << ", bound " << bound.total << "\n";
      for (const std::string& reason : bound.reasons) out << reason << "\n";
      TEST_ASSERT(bound.strict);
      // The solution of second order is exact: its error is the round-off of a difference of energies.
      TEST_COMPARE(bound.total + (cell == Cell::Triangle6 ? 1e-7 * bound.solutionNorm : 0.0), >=, error * (1 - 1e-9));
      const double above = cell == Cell::Triangle6 ? 1e-7 * bound.solutionNorm : most * error;
      TEST_COMPARE(bound.total, <=, above);
      TEST_COMPARE(bound.energyLower, <=, exact + 1e-9 * std::abs(exact));
    }
}

bool hasReason(const ErrorBound& bound, const std::string& part) {
  return std::any_of(bound.reasons.begin(), bound.reasons.end(),
                     [&](const std::string& one) { return one.find(part) != std::string::npos; });
}

/// Traction or body force that is a function of the place.
Load given(Load load, const std::vector<std::string>& components) {
  for (const std::string& text : components) load.expressions.emplace_back(text, Constants());
  return load;
}

Load risingWeight() { return given(Load::bodyForce({0, 0, 0}), {"0", "-2e3*y"}); }

// The energy norm of the error against that of the displacement's own strains, whatever the elements' stress. In a column under its weight
// the displacements of enhanced elements are exact at the nodes: |u - u_h|^2 = w^2 h^2 / (12 E') times the volume, for any nu.
TEUCHOS_UNIT_TEST(ErrorBounds, ExceedTheErrorOfEnhancedQuadrilaterals) {
  for (const double poisson : {kPoisson, 0.49})
    for (const bool two : {false, true}) {
      const int cells = 6;
      Column column = two ? pair(Cell::Quadrilateral4, cells) : single(Cell::Quadrilateral4, cells);
      const auto law = std::make_shared<IsotropicLaw>(IsotropicModuli{kYoung, poisson});
      ElasticModel model;
      for (const Box& body : column.bodies) model.addBody(body.name, law);
      column.model = model;
      column.addWeight();
      const ErrorBound bound = boundOf(column.scene());
      const double uniaxial = kYoung * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
      const double error = kWeight / cells * std::sqrt((two ? 2 : 1) / (12 * uniaxial));
      out << poisson << " " << two << ": error " << error << ", bound " << bound.total << ", effectivity " << bound.total / error << "\n";
      for (const std::string& reason : bound.reasons) out << reason << "\n";
      TEST_ASSERT(bound.strict);
      TEST_COMPARE(bound.total, >=, error * (1 - 1e-9));
      TEST_COMPARE(bound.total, <=, 1.6 * error);
      const double exact = -kWeight * kWeight * (two ? 8 : 1) / (6 * uniaxial);
      TEST_FLOATING_EQUALITY(2 * (bound.energyUpper - exact), error * error, 1e-6);
      TEST_COMPARE(bound.energyLower, <=, exact + 1e-9 * std::abs(exact));
    }
}

// Quadrilaterals that are no parallelograms: the interpolant differs from the displacement.
TEUCHOS_UNIT_TEST(ErrorBounds, HoldOnSkewedQuadrilaterals) {
  struct Case {
    Cell cell;
    double most;
  };
  for (const Case& one : {Case{Cell::Quadrilateral4, 1.1}, Case{Cell::Quadrilateral8, 1.1}, Case{Cell::Quadrilateral9, 1.1}})
    for (const bool enhanced : {false, true})
      for (const bool two : {false, true}) {
        if (enhanced && one.cell != Cell::Quadrilateral4) continue;
        Column column = two ? pair(one.cell, 5) : single(one.cell, 5);
        if (!enhanced) column = plain(column);
        // First order: an exact solution, then one with an error.
        column.model.loads = {Load::pressure(column.bodies.back().name + "_top", 5e3)};
        const ErrorBound vanishes = boundOf(skewed(column.scene(), 0.08));
        out << "affine: " << vanishes.relative() << "\n";
        for (const std::string& reason : vanishes.reasons) out << reason << "\n";
        TEST_ASSERT(vanishes.strict);
        TEST_COMPARE(vanishes.relative(), <, 1e-6);
        column.addWeight();
        const double rising = cellInfo(one.cell).order == 2 ? kRisingWeight : 0.0;
        if (rising > 0.0) column.model.loads.push_back(risingWeight());
        double energy = 0.0;
        const ErrorBound bound = boundOf(skewed(column.scene(), 0.08), &energy);
        // The energy of enhanced elements is not that of their displacements.
        const double exact = energyOfColumn(two ? 2 : 1, rising), found = enhanced ? bound.energyUpper : energy;
        const double error = std::sqrt(2 * (found - exact));
        out << static_cast<int>(one.cell) << " " << two << ": error " << error << ", bound " << bound.total << ", effectivity "
            << bound.total / error << ", relative " << bound.relative() << "\n";
        for (const std::string& reason : bound.reasons) out << reason << "\n";
        TEST_ASSERT(bound.strict);
        TEST_COMPARE(bound.imbalance, <, 1e-10);
        TEST_COMPARE(bound.energyLower, <=, exact + 1e-9 * std::abs(exact));
        TEST_COMPARE(bound.total, >=, error * (1 - 1e-9));
        TEST_COMPARE(bound.total, <=, one.most * error);
        if (!enhanced) TEST_FLOATING_EQUALITY(bound.energyUpper, energy, 1e-7);
      }
}

/// A column of quadrilaterals with one node moved.
ErrorBound boundWithNodeAt(Cell cell, const Point& place, const Point& moved) {
  Column column = single(cell, 4);
  column.addWeight();
  Scene scene = column.scene();
  scene.mesh = [make = scene.mesh, place, moved](const Comm& comm) {
    Mesh mesh = make(comm);
    for (int node = 0; node < mesh.nodes(); ++node)
      if (norm(minus(mesh.point(node), place)) < 1e-9)
        for (int k = 0; k < 2; ++k) mesh.coordinates[std::size_t(node) * 2 + k] = moved[k];
    return mesh;
  };
  return boundOf(scene);
}

// Maps that are not bilinear, and one whose determinant nearly vanishes at a vertex.
TEUCHOS_UNIT_TEST(ErrorBounds, AreEstimatesForDistortedQuadrilaterals) {
  TEST_ASSERT(boundWithNodeAt(Cell::Quadrilateral4, {0.25, 0.25, 0}, {0.2, 0.15, 0}).strict);
  const ErrorBound flat = boundWithNodeAt(Cell::Quadrilateral4, {0.25, 0.25, 0}, {0.1251, 0.1251, 0});
  TEST_ASSERT(flat.exists && !flat.strict && hasReason(flat, "so distorted"));
  for (const Cell cell : {Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    const ErrorBound curved = boundWithNodeAt(cell, {0.25, 0.125, 0}, {0.26, 0.125, 0});
    TEST_ASSERT(curved.exists && !curved.strict && hasReason(curved, "curved sides"));
  }
  const ErrorBound inside = boundWithNodeAt(Cell::Quadrilateral9, {0.125, 0.125, 0}, {0.135, 0.125, 0});
  TEST_ASSERT(inside.exists && !inside.strict && hasReason(inside, "curved sides"));
}

// Bodies of triangles and of quadrilaterals in contact.
TEUCHOS_UNIT_TEST(ErrorBounds, HoldForMixedCells) {
  for (const bool first : {true, false}) {
    Column column = plain(pair(first ? Cell::Triangle3 : Cell::Triangle6, 6));
    column.bodies[1].cell = first ? Cell::Quadrilateral4 : Cell::Quadrilateral8;
    column.addWeight();
    if (!first) column.model.loads.push_back(risingWeight());
    double energy = 0.0;
    const ErrorBound bound = boundOf(column.scene(), &energy);
    for (const std::string& reason : bound.reasons) out << reason << "\n";
    TEST_ASSERT(bound.strict);
    const double exact = energyOfColumn(2, first ? 0.0 : kRisingWeight), error = std::sqrt(std::max(0.0, 2 * (energy - exact)));
    out << "error " << error << ", bound " << bound.total << ", effectivity " << bound.total / error << "\n";
    TEST_COMPARE(bound.total, >=, error * (1 - 1e-9));
    TEST_COMPARE(bound.total, <=, (first ? 1.6 : 1.5) * error);
  }
}

// Functions that vanish at the vertices, the middles or the centre of elements are not overlooked.
TEUCHOS_UNIT_TEST(ErrorBounds, NoticeLoadsThatAreNoPolynomials) {
  struct Case {
    Cell cell;
    std::vector<std::string> components;
    bool isStrict;
  };
  for (const Case& one :
       {Case{Cell::Triangle6, {"0", "x*y"}, true}, Case{Cell::Triangle3, {"0", "1 + x"}, true},
        Case{Cell::Triangle3, {"0", "x*(x - 0.5)"}, false}, Case{Cell::Triangle6, {"0", "x*(x - 0.25)*(x - 0.5)"}, false}}) {
    Column column = single(one.cell, 2);
    column.model.loads = {given(Load::traction("a_top", {0, 0, 0}), one.components)};
    const ErrorBound bound = boundOf(column.scene());
    TEST_EQUALITY(bound.strict, one.isStrict);
    TEST_EQUALITY(hasReason(bound, "tractions are not polynomials"), !one.isStrict);
  }
  // On tetrahedra the function vanishes on the edges along x.
  Column solid = single(Cell::Tetrahedron4, 2);
  solid.model.loads = {given(Load::traction("a_top", {0, 0, 0}), {"0", "0", "y*(y - 0.5)"})};
  TEST_ASSERT(hasReason(boundOf(solid.scene()), "tractions are not polynomials"));
  for (const Case& one : {Case{Cell::Triangle6, {"0", "1 + 2*x - y"}, true}, Case{Cell::Triangle6, {"0", "x^2 - y^2"}, false},
                          Case{Cell::Triangle3, {"0", "x"}, false}}) {
    Column column = single(one.cell, 2);
    column.model.loads = {given(Load::bodyForce({0, 0, 0}), one.components)};
    const ErrorBound bound = boundOf(column.scene());
    TEST_EQUALITY(bound.strict, one.isStrict);
    TEST_EQUALITY(hasReason(bound, "body forces are not polynomials"), !one.isStrict);
  }
}

/// The column with its right side bent outwards.
Scene bent(const Column& column) {
  Scene scene = column.scene();
  scene.mesh = [make = scene.mesh](const Comm& comm) {
    Mesh mesh = make(comm);
    for (int node = 0; node < mesh.nodes(); ++node) {
      const double x = mesh.coordinates[2 * std::size_t(node)], y = mesh.coordinates[2 * std::size_t(node) + 1];
      mesh.coordinates[2 * std::size_t(node)] += 0.2 * x * y * (1 - y);
    }
    return mesh;
  };
  return scene;
}

// Nodes of a roller on a bent wall move along its mean normal, so that they leave the polygon: no displacement of the bounded problem.
TEUCHOS_UNIT_TEST(ErrorBounds, AreEstimatesForRollersOnCurvedSides) {
  Column column = single(Cell::Triangle3, 6);
  column.model.loads = {Load::pressure("a_top", 5e3)};
  const ErrorBound bound = boundOf(bent(column));
  TEST_ASSERT(!bound.strict && bound.exists);
  TEST_ASSERT(hasReason(bound, "rollers support curved sides"));
}

TEUCHOS_UNIT_TEST(ErrorBounds, NeedElementsOfOneOrder) {
  Column mixed = pair(Cell::Triangle3, 4);
  mixed.bodies[1].cell = Cell::Triangle6;
  mixed.bodies[1].nx = mixed.bodies[1].ny = 2;
  mixed.addWeight();
  const ErrorBound bound = boundOf(mixed.scene());
  TEST_ASSERT(!bound.exists && !bound.strict);
  TEST_ASSERT(hasReason(bound, "both orders"));
}

// The same bound on any number of ranks and subdomains, with a solver that stops early.
TEUCHOS_UNIT_TEST(ErrorBounds, HoldHoweverEarlyTheSolverStops) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8}) {
    Column column = plain(pair(cell, 6));
    column.addWeight();
    column.model.loads.push_back(given(Load::traction("b_top", {0, 0, 0}), {"0", "-2e3*x"}));
    double energy = 0.0, exact = 0.0;
    boundOf(column.scene(), &exact);
    for (const char* tolerance : {"1e-1", "1e-3"}) {
      const ErrorBound bound = boundOf(column.scene(tolerance), &energy);
      for (const std::string& reason : bound.reasons) out << reason << "\n";
      TEST_ASSERT(bound.strict);
      // The discrete solution is one of the competitors.
      TEST_COMPARE(bound.total * bound.total, >=, 2 * (energy - exact));
      TEST_COMPARE(bound.algebraic * bound.algebraic, >=, 2 * (energy - exact) - 1e-9 * std::abs(exact));
      TEST_COMPARE(bound.energyLower, <=, exact);
    }
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
