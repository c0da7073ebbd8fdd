// Bounds of the error in the energy norm on hexahedra, wedges and pyramids, against exact energies: 2 (J(u_h) - J(u)) = |u - u_h|^2. On any
// number of ranks.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/base/Expression.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace suture {
namespace {

constexpr double kYoungOfSolids = 2e6, kPoissonOfSolids = 0.3, kWeightOfSolids = 3e3, kRisingWeightOfSolids = 2e3;
const double kUniaxialOfSolids = kYoungOfSolids * (1 - kPoissonOfSolids) / ((1 + kPoissonOfSolids) * (1 - 2 * kPoissonOfSolids));

enum class Shape { Bricks, Skewed, Warped };

/// Cubes one upon the other on a rigid floor, between smooth walls.
struct Tower {
  std::vector<Box> bodies;
  Shape shape = Shape::Bricks;
  bool enhanced = false;
  std::vector<Load> loads{};
  bool cutIntoPyramids = false;  ///< every second hexahedron

  Tower(Cell cell, int cells, int height) {
    for (int i = 0; i < height; ++i) {
      Box box{std::string(1, char('a' + i)), 0, 1, 0, 1, cells, cells, cell};
      box.nz = cells;
      box.z0 = i, box.z1 = i + 1;
      bodies.push_back(box);
    }
  }
  const std::string& top() const { return bodies.back().name; }
  Scene scene(const std::string& subdomains = "5", const std::string& tolerance = "1e-13") const;
};

/// Nodes at integer coordinates stay in their planes, so that sides at the boundary stay plane. Skewed: edges along z stay vertical.
Mesh deformed(Mesh mesh, Shape shape) {
  const std::vector<double> old = mesh.coordinates;
  for (int node = 0; node < mesh.nodes() && shape != Shape::Bricks; ++node) {
    const double* p = &old[std::size_t(node) * 3];
    const double x = std::sin(M_PI * p[0]), y = std::sin(M_PI * p[1]), z = std::sin(M_PI * p[2]);
    mesh.coordinates[std::size_t(node) * 3] += 0.08 * x * y;
    mesh.coordinates[std::size_t(node) * 3 + 1] -= 0.06 * x * y;
    if (shape == Shape::Warped) {
      mesh.coordinates[std::size_t(node) * 3] += 0.05 * x * std::sin(3 * p[1] + 2 * p[2]) * z;
      mesh.coordinates[std::size_t(node) * 3 + 2] += 0.06 * z * std::cos(2 * p[0] - 3 * p[1]);
    }
  }
  for (int e = 0; e < mesh.elements(); ++e) {  // other nodes at the means of the vertices around them
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const Span<const int> nodes = mesh.nodesOf(e);
    const auto put = [&](int local, const std::vector<int>& of) {
      for (int k = 0; k < 3; ++k) {
        double sum = 0.0;
        for (const int i : of) sum += mesh.coordinates[std::size_t(nodes[i]) * 3 + k] / double(of.size());
        mesh.coordinates[std::size_t(nodes[local]) * 3 + k] = sum;
      }
    };
    if (cell.order == 1) continue;
    for (std::size_t i = 0; i < cell.edges.size(); ++i) put(cell.vertices + int(i), {cell.edges[i][0], cell.edges[i][1]});
    if (mesh.cells[e] != Cell::Hexahedron27) continue;
    for (const std::vector<int>& side : cell.sideNodes) put(side.back(), {side[0], side[1], side[2], side[3]});
    put(26, {0, 1, 2, 3, 4, 5, 6, 7});
  }
  return mesh;
}

/// Every second hexahedron becomes six pyramids around its centre.
Mesh withPyramids(const Mesh& given) {
  Mesh mesh = given;
  mesh.cells.clear(), mesh.connectivity.clear(), mesh.offsets.assign(1, 0);
  std::vector<int> parent;
  std::vector<std::array<int, 6>> sideOf;  // element on each side of a given one
  const auto add = [&](Cell cell, const std::vector<int>& nodes, int from) {
    mesh.cells.push_back(cell);
    mesh.connectivity.insert(mesh.connectivity.end(), nodes.begin(), nodes.end());
    mesh.offsets.push_back(int(mesh.connectivity.size()));
    parent.push_back(from);
    return mesh.elements() - 1;
  };
  const CellInfo& cube = cellInfo(Cell::Hexahedron8);
  for (int e = 0; e < given.elements(); ++e) {
    const Span<const int> nodes = given.nodesOf(e);
    std::array<int, 6> own{};
    if (e % 2 == 0) {
      own.fill(add(Cell::Hexahedron8, std::vector<int>(nodes.begin(), nodes.end()), e));
      sideOf.push_back(own);
      continue;
    }
    const int centre = mesh.nodes();
    for (int k = 0; k < 3; ++k) {
      double sum = 0.0;
      for (const int node : nodes) sum += given.coordinates[std::size_t(node) * 3 + k] / 8;
      mesh.coordinates.push_back(sum);
    }
    for (int s = 0; s < 6; ++s) {
      const std::vector<int>& side = cube.sideNodes[s];  // from outside: the base of a pyramid is seen from its apex
      own[s] = add(Cell::Pyramid5, {nodes[side[0]], nodes[side[3]], nodes[side[2]], nodes[side[1]], centre}, e);
    }
    sideOf.push_back(own);
  }
  for (auto& [name, sides] : mesh.sideGroups)
    for (Side& side : sides) {
      const int old = side.element;
      side.element = sideOf[old][side.side];
      if (mesh.cells[side.element] == Cell::Pyramid5) side.side = 0;
    }
  for (auto& [name, elements] : mesh.elementGroups) {
    const std::set<int> before(elements.begin(), elements.end());
    elements.clear();
    for (int e = 0; e < mesh.elements(); ++e)
      if (before.count(parent[e]) > 0) elements.push_back(e);
  }
  return mesh;
}

Scene Tower::scene(const std::string& subdomains, const std::string& tolerance) const {
  ElasticModel model;
  model.dimension = 3;
  std::vector<Condition> held;
  std::vector<Contact> contacts;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string& name = bodies[i].name;
    model.addBody(name, std::make_shared<IsotropicLaw>(IsotropicModuli{kYoungOfSolids, kPoissonOfSolids}));
    for (const char* side : {"_left", "_right", "_front", "_back"}) held.push_back(Condition::bilateral(name + side));
    if (i > 0) contacts.push_back(Contact::between(name + "_bottom", bodies[i - 1].name + "_top"));
  }
  held.push_back(Condition::bilateral("a_bottom"));
  for (Material& material : model.materialOfBody) material.enhanced = enhanced;
  model.loads = loads;
  const auto make = [all = bodies, form = shape, cut = cutIntoPyramids] {
    const Mesh mesh = deformed(boxes(all), form);
    return cut ? withPyramids(mesh) : mesh;
  };
  return makeScene(model, make, held, contacts,
                   {"Outer Solver/Tolerance=" + tolerance, "Partition/METIS/Subdomains=" + subdomains, "Output/Error Bound=true"});
}

ErrorBound boundOfSolids(const Scene& scene, double* energy = nullptr) {
  Simulation simulation(blocks::world(), scene);
  const Solution& solution = simulation.solve();
  if (energy) *energy = solution.energy;
  return solution.bound.value();
}

bool isNotStrictFor(const ErrorBound& bound, const std::string& part) {
  return bound.exists && !bound.strict && std::any_of(bound.reasons.begin(), bound.reasons.end(), [&](const std::string& one) {
           return one.find(part) != std::string::npos;
         });
}

Load weightOfSolids() { return Load::bodyForce({0, 0, -kWeightOfSolids}); }

Load risingWeightOfSolids() {
  Load load = Load::bodyForce({0, 0, 0});
  Constants inSpace;
  inSpace.dimension = 3;
  for (const char* text : {"0", "0", "-2e3*z"}) load.expressions.emplace_back(text, inSpace);
  return load;
}

/// Potential energy under the weight w and an additional force per volume -f z: stress -w (H - z) - f (H^2 - z^2) / 2; the energy is minus
/// half the integral of its square over E'.
double energyOfTower(double height, double f) {
  const double w = kWeightOfSolids, h2 = height * height, h3 = h2 * height;
  return -(w * w * h3 / 3 + f * f * h2 * h3 * 2 / 15 + w * f * h2 * h2 * 5 / 12) / (2 * kUniaxialOfSolids);
}

const std::vector<Cell> kSolids{Cell::Hexahedron8, Cell::Wedge6, Cell::Pyramid5, Cell::Hexahedron20, Cell::Hexahedron27};

/// Sides of second order have a node in the middle of their diagonal if they have 9 nodes and are parallelograms.
bool canTouch(Cell cell, Shape shape) { return cellInfo(cell).order == 1 || (cell == Cell::Hexahedron27 && shape == Shape::Bricks); }

// A constant stress is represented on every mesh: also on warped sides, and across a contact.
TEUCHOS_UNIT_TEST(SolidBounds, VanishForConstantStress) {
  for (const Cell cell : kSolids)
    for (const int height : {1, 2})
      for (const Shape shape : {Shape::Bricks, Shape::Skewed, Shape::Warped}) {
        if (!canTouch(cell, shape) && height == 2) continue;
        Tower tower(cell, 2, height);
        tower.shape = shape;
        tower.loads = {Load::pressure(tower.top() + "_top", 5e3)};
        const ErrorBound bound = boundOfSolids(tower.scene());
        out << int(cell) << " " << height << " " << int(shape) << ": " << bound.relative() << "\n";
        for (const std::string& reason : bound.reasons) out << reason << "\n";
        TEST_ASSERT(bound.strict);
        TEST_COMPARE(bound.relative(), <, 1e-6);
        TEST_COMPARE(bound.solutionNorm, >, 0.0);
      }
}

// Towers under their weight: the error is known from the energies.
TEUCHOS_UNIT_TEST(SolidBounds, ExceedTheError) {
  for (const Cell cell : kSolids)
    for (const int height : {1, 2})
      for (const Shape shape : {Shape::Bricks, Shape::Skewed, Shape::Warped}) {
        const bool quadratic = cellInfo(cell).order == 2;
        if (!canTouch(cell, shape) && height == 2) continue;
        if (quadratic && shape == Shape::Warped) continue;  // body forces that vary between warped sides and triangles
        Tower tower(cell, quadratic ? 2 : 3, height);
        tower.shape = shape;
        tower.loads = {weightOfSolids()};
        if (quadratic) tower.loads.push_back(risingWeightOfSolids());
        double energy = 0.0;
        const ErrorBound bound = boundOfSolids(tower.scene(), &energy);
        const double exact = energyOfTower(height, quadratic ? kRisingWeightOfSolids : 0.0), error = std::sqrt(2 * (energy - exact));
        out << int(cell) << " " << height << " " << int(shape) << ": error " << error << ", bound " << bound.total << ", effectivity "
            << bound.total / error << ", relative " << bound.relative() << "\n";
        for (const std::string& reason : bound.reasons) out << reason << "\n";
        TEST_ASSERT(bound.strict);
        TEST_COMPARE(bound.total, >=, error * (1 - 1e-9));
        TEST_COMPARE(bound.total, <=, 1.7 * error);
        TEST_COMPARE(bound.energyLower, <=, exact + 1e-9 * std::abs(exact));
        TEST_COMPARE(bound.energyUpper, >=, exact - 1e-9 * std::abs(exact));
        TEST_COMPARE(bound.imbalance, <, 1e-9);
      }
}

// The energy of enhanced hexahedra is not that of their displacements, which are exact at the nodes: |u - u_h|^2 = w^2 h^2 / (12 E') times
// the volume.
TEUCHOS_UNIT_TEST(SolidBounds, ExceedTheErrorOfEnhancedHexahedra) {
  for (const int height : {1, 2}) {
    Tower tower(Cell::Hexahedron8, 3, height);
    tower.enhanced = true;
    tower.loads = {weightOfSolids()};
    const ErrorBound bound = boundOfSolids(tower.scene());
    const double error = kWeightOfSolids / 3 * std::sqrt(height / (12 * kUniaxialOfSolids));
    out << "error " << error << ", bound " << bound.total << ", effectivity " << bound.total / error << "\n";
    for (const std::string& reason : bound.reasons) out << reason << "\n";
    TEST_ASSERT(bound.strict);
    TEST_COMPARE(bound.total, >=, error * (1 - 1e-9));
    TEST_COMPARE(bound.total, <=, 1.7 * error);
    TEST_FLOATING_EQUALITY(2 * (bound.energyUpper - energyOfTower(height, 0.0)), error * error, 1e-6);
  }
}

// Hexahedra beside pyramids in one body, and a body of tetrahedra on one of hexahedra.
TEUCHOS_UNIT_TEST(SolidBounds, HoldForMixedCells) {
  for (const Shape shape : {Shape::Bricks, Shape::Warped}) {
    Tower tower(Cell::Hexahedron8, 3, 1);
    tower.shape = shape;
    tower.cutIntoPyramids = true;
    tower.loads = {weightOfSolids()};
    double energy = 0.0;
    const ErrorBound bound = boundOfSolids(tower.scene(), &energy);
    const double error = std::sqrt(2 * (energy - energyOfTower(1, 0.0)));
    out << "effectivity " << bound.total / error << "\n";
    for (const std::string& reason : bound.reasons) out << reason << "\n";
    TEST_ASSERT(bound.strict);
    TEST_COMPARE(bound.total, >=, error * (1 - 1e-9));
    TEST_COMPARE(bound.total, <=, 1.7 * error);
  }
}

// Neither the subdomains nor the ranks matter.
TEUCHOS_UNIT_TEST(SolidBounds, DoNotDependOnThePartition) {
  for (const Cell cell : {Cell::Hexahedron8, Cell::Wedge6}) {
    Tower tower(cell, 3, 2);
    tower.shape = Shape::Warped;
    tower.loads = {weightOfSolids()};
    const double one = boundOfSolids(tower.scene("2")).total, many = boundOfSolids(tower.scene("7")).total;
    TEST_FLOATING_EQUALITY(one, many, 1e-7);
  }
}

// Warped sides at the boundary, where bodies are not the polyhedra of their tetrahedra.
TEUCHOS_UNIT_TEST(SolidBounds, AreEstimatesForWarpedBoundaries) {
  Tower tower(Cell::Hexahedron8, 2, 1);
  tower.loads = {weightOfSolids()};
  Scene scene = tower.scene();
  scene.mesh = [make = scene.mesh](const Comm& comm) {
    Mesh mesh = make(comm);
    for (int node = 0; node < mesh.nodes(); ++node)
      if (norm(minus(mesh.point(node), {0.5, 0.5, 1})) < 1e-9) mesh.coordinates[std::size_t(node) * 3 + 2] += 0.05;
    return mesh;
  };
  TEST_ASSERT(isNotStrictFor(boundOfSolids(scene), "at the boundary are not plane"));
}

}  // namespace
}  // namespace suture
