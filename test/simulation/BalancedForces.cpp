// Element forces of the corrected displacements balance at each node for any accuracy of the interface solve, and the energy of the
// correction is a bound of the algebraic error. Forces are summed by loops over elements, loads and pairs, without any object of the
// solver.
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/answer/verdict/NodalForces.hpp>
#include <suture/answer/verdict/SeamExchange.hpp>
#include <suture/base/Gather.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/Simulation.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace suture {
namespace {

using Settings = std::vector<std::string>;
using SceneWith = std::function<Scene(const Settings& settings)>;

double over(Teuchos::EReductionType how, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(*blocks::world(), how, mine, Teuchos::outArg(all));
  return all;
}

/// Pairs with other forces, on rank 0.
std::vector<PairResult> withForces(std::vector<PairResult> pairs, const std::map<int, PairForce>& forces) {
  std::vector<PairForce> mine;
  for (const auto& [id, force] : forces) mine.push_back(force);
  for (const PairForce& force : joinOnRoot(*blocks::world(), mine)) {
    PairResult& pair = pairs.at(static_cast<std::size_t>(force.id));
    pair.force = force.force;
    pair.tangential = force.tangential;
  }
  return pairs;
}

/// Largest unbalanced force at a node along directions in which it can move, relative to the largest force at a node.
double imbalance(const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const std::vector<Vector>& displacement,
                 const std::vector<PairResult>& pairs) {
  const Comm& comm = *blocks::world();
  const SeamExchange seams(comm, meshes);
  const NodalForces forces = nodalForces(comm, {meshes, model, displacement, pairs, {}}, seams);
  double rest = 0.0, largest = 0.0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const SubdomainMesh& mesh = meshes[i];
    const int d = mesh.dimension;
    const NodalRows rows{d};
    const RigidGroupNodes rigid(mesh.rigidGroups, d);
    std::vector<const NodeRule*> rules(static_cast<std::size_t>(mesh.nodes()), nullptr);
    for (const NodeRule& rule : mesh.rules) rules[static_cast<std::size_t>(rule.node)] = &rule;
    for (int node = 0; node < mesh.nodes(); ++node) {
      const auto at = [&](int row) { return pointOf(&forces.nodes[i](row, node), d); };
      Point free = minus(plus(at(rows.applied()), at(rows.contact())), at(rows.internal()));
      for (const int row : {rows.applied(), rows.contact(), rows.internal()}) largest = std::max(largest, norm(at(row)));
      if (rigid.contains(node)) free = pointOf(&forces.masters[i](MasterRows{d}.rest(), node), d);
      if (const NodeRule* rule = rules[static_cast<std::size_t>(node)]; rule && !rigid.contains(node)) {
        const Point whole = std::exchange(free, Point{0, 0, 0});
        for (int k = 0; k < d; ++k)
          if (!rule->fixed[k]) free = plus(free, scaled(dot(whole, rule->axes[k]), rule->axes[k]));
      }
      rest = std::max(rest, norm(free));
    }
  }
  return over(Teuchos::REDUCE_MAX, rest) / over(Teuchos::REDUCE_MAX, largest);
}

/// Sum of a(v, v) over the subdomains, by loops over elements.
double energyOf(const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const std::vector<Vector>& v) {
  double sum = 0.0;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    if (v[i].size() == 0) continue;
    const auto materialOf = [&](int element) -> const Material& { return model.materialOf(meshes[i], element, meshes[i].body); };
    sum += v[i].dot(elementForces(meshes[i], materialOf, model.plane, v[i]).internal);
  }
  return over(Teuchos::REDUCE_SUM, sum);
}

struct Found {
  SolvedScene solved;
  ElasticModel model;
  const Solution& solution() const { return solved.solution(); }
  const std::vector<SubdomainMesh>& meshes() const { return solved.meshes(); }
};

Found solutionOf(const SceneWith& scene, Settings settings) {
  settings.push_back("Output/Error Bound=true");
  PreparedScene prepared = prepare(check(cut(read(RunContext(blocks::world()), scene(settings)))));
  ElasticModel model = prepared.scene().model;  // with the loads of rigid groups
  return {solve(std::move(prepared)), std::move(model)};
}

std::vector<Vector> corrected(const Solution& solution) {
  std::vector<Vector> sum = solution.displacement;
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (solution.balancing->correction[i].size() > 0) sum[i] += solution.balancing->correction[i];
  return sum;
}

// Of a solution: without and with the correction.
struct Imbalances {
  double before, after;
};

Imbalances imbalancesOf(const Found& found) {
  const Solution& solution = found.solution();
  return {imbalance(found.meshes(), found.model, solution.displacement, solution.pairs),
          imbalance(found.meshes(), found.model, corrected(solution), withForces(solution.pairs, solution.balancing->forces))};
}

// Scenes.

/// A block on a larger one, held by contact and a guide only, pressed down eccentrically. 3D: the same with a thickness of one.
struct BlockOnBlock {
  Cell cell;
  int cellsBelow = 8, cellsAbove = 4;  // along each side; above along half of it
  std::optional<Obstacle> obstacle{};  // instead of the lower block

  SceneWith scene() const {
    return [*this](const Settings& settings) {
      const bool is3D = cellInfo(cell).dimension == 3;
      ElasticModel model;
      model.dimension = is3D ? 3 : 2;
      model.addBody("upper", std::make_shared<IsotropicLaw>(IsotropicModuli{200.0, 0.3}));
      if (!obstacle) model.addBody("lower", std::make_shared<IsotropicLaw>(IsotropicModuli{50.0, 0.25}));
      const Point press = is3D ? Point{0.2, 0.1, -1.0} : Point{0.2, -1.0, 0.0};
      model.loads = {Load::traction("upper_top", press)};
      const auto mesh = [*this, is3D] {
        Box upper{"upper", 0, 1, 0, 1, cellsAbove, cellsAbove, cell},
            lower{"lower", 0, 2, is3D ? 0.0 : -1.0, is3D ? 1.0 : 0.0, cellsBelow, std::max(1, cellsBelow / 2), cell};
        if (is3D) upper.nz = cellsAbove, lower.z0 = -1, lower.z1 = 0, lower.nz = std::max(1, cellsBelow / 2);
        return boxes(obstacle ? std::vector<Box>{upper} : std::vector<Box>{upper, lower});
      };
      std::vector<Condition> conditions{Condition::displacement("upper_right", {0}, {0})};
      if (is3D) conditions.push_back(Condition::displacement("upper_back", {0}, {1}));
      if (!obstacle)
        conditions.push_back(Condition::displacement("lower_bottom", is3D ? std::vector<double>{0, 0, 0} : std::vector<double>{0, 0},
                                                     is3D ? std::vector<int>{0, 1, 2} : std::vector<int>{0, 1}));
      return makeScene(model, mesh, conditions,
                       {obstacle ? Contact::with(*obstacle, "upper_bottom") : Contact::between("upper_bottom", "lower_top")}, settings);
    };
  }
};

SceneWith fromFile(const std::string& path) {
  return [path](const Settings& settings) {
    return sceneOf(*blocks::world(), readScene(*blocks::world(), std::string(SUTURE_SOURCE_DIR) + "/" + path, sceneSchema(), settings));
  };
}

const std::string kEarly = "Outer Solver/Tolerance=1e-2";

/// The forces balance with the correction, and without it they do not.
void balances(const std::string& name, const SceneWith& scene, Settings settings, bool& success, Teuchos::FancyOStream& out,
              double balanced = 1e-11) {
  for (const std::string& setting : settings) out << setting << "  ";
  settings.push_back(kEarly);
  const Found found = solutionOf(scene, settings);
  const Solution& solution = found.solution();
  TEST_ASSERT(solution.converged);
  TEST_EQUALITY(solution.notBalanced, "");
  TEST_ASSERT(solution.balancing.has_value());
  if (!solution.balancing) return;
  const Imbalances at = imbalancesOf(found);
  const double energy = energyOf(found.meshes(), found.model, solution.balancing->correction);
  out << name << ": unbalanced " << at.before << ", with the correction " << at.after << ", on the interface "
      << solution.balancing->imbalance << "\n";
  TEST_COMPARE(at.before, >, 1e-5);
  TEST_COMPARE(at.after, <, balanced);
  TEST_COMPARE(solution.balancing->imbalance, <, balanced);
  TEST_FLOATING_EQUALITY(solution.balancing->energy, energy, 1e-8);
}

const Settings kCut{"Partition/METIS/Subdomains=9"};

TEUCHOS_UNIT_TEST(BalancedForces, BalanceInEveryCellHoweverEarlyTheSolverStops) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral8})
    balances(cellInfo(cell).name, BlockOnBlock{cell}.scene(), kCut, success, out);
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4})
    balances(cellInfo(cell).name, BlockOnBlock{cell, 4, 2}.scene(), kCut, success, out);
}

TEUCHOS_UNIT_TEST(BalancedForces, BalanceAtMortarsAndObstacles) {
  balances("mortar", BlockOnBlock{Cell::Triangle3, 8, 7}.scene(), kCut, success, out);
  balances("mortar", BlockOnBlock{Cell::Quadrilateral8, 8, 3}.scene(), kCut, success, out);
  balances("mortar in 3D", BlockOnBlock{Cell::Hexahedron8, 4, 3}.scene(), kCut, success, out);
  balances("inclined obstacle", BlockOnBlock{Cell::Triangle3, 8, 8, Obstacle::line({0, 0, 0}, {0.1, 1, 0})}.scene(), kCut, success, out);
  balances("disc", BlockOnBlock{Cell::Triangle6, 8, 8, Obstacle::circle({0.4, -5.0, 0}, 5.0)}.scene(), kCut, success, out);
}

// Two subdomains for two bodies, on up to four ranks: some ranks have none.
TEUCHOS_UNIT_TEST(BalancedForces, BalanceWithMoreRanksThanSubdomains) {
  balances("two bodies", BlockOnBlock{Cell::Triangle3}.scene(), {"Partition/METIS/Subdomains=2"}, success, out);
}

TEUCHOS_UNIT_TEST(BalancedForces, BalanceWithEveryPreconditionerAndFormulation) {
  const SceneWith scene = BlockOnBlock{Cell::Triangle3, 16, 8}.scene();
  for (const Settings& settings :
       std::vector<Settings>{{"Preconditioner/Type=Neumann-Neumann"},
                             {"Preconditioner/BDDC/Coarse Level Above=0"},
                             {"Preconditioner/BDDC/Edge Constraints=Adaptive", "Preconditioner/BDDC/Weighting=Deluxe"},
                             {"Preconditioner/BDDC/Local Inverses=Sparse"},
                             {"Subdomain/Schur Complement=Implicit", "Subdomain/Implicit/Precision=Single"},
                             {"Formulation=Condensed Groups"},
                             {"Formulation=Condensed Groups", "Preconditioner/Type=Neumann-Neumann"}}) {
    Settings all = settings;
    all.push_back("Partition/METIS/Subdomains=24");
    balances("block on block", scene, all, success, out);
  }
}

TEUCHOS_UNIT_TEST(BalancedForces, BalanceWithRigidGroupsCoatingsAndGivenFriction) {
  balances("rigid group in contact", fromFile("test/drivers/platen.xml"), {}, success, out);
  balances("rigid group in 3D", fromFile("test/drivers/rigid_end_3d.xml"), {}, success, out);
  balances("stiff bodies on a coating", fromFile("test/drivers/gasket.xml"), {}, success, out, 1e-9);
  balances("several bodies", fromFile("input/beam_on_blocks/beam_on_blocks.xml"), {}, success, out);
  balances("axisymmetric", fromFile("input/hertz_sphere/hertz_sphere.xml"), {}, success, out);
  balances("Tresca", fromFile("input/friction_block/friction_block.xml"), {"Contact/sole/Law=Tresca", "Contact/sole/Tresca/Bound=1e5"},
           success, out);
}

// Nodal forces of a refined direct solution balance without a correction.
TEUCHOS_UNIT_TEST(BalancedForces, OfMonolithicNeedNoCorrection) {
  const Found found = solutionOf(BlockOnBlock{Cell::Triangle6}.scene(), {"Outer Solver/Type=Monolithic"});
  TEST_ASSERT(found.solution().balancing.has_value());
  TEST_EQUALITY(found.solution().balancing->energy, 0.0);
  TEST_COMPARE(imbalancesOf(found).after, <, 1e-12);
}

// Slipping pairs keep the friction forces that they have: with given bounds friction has an energy.
TEUCHOS_UNIT_TEST(BalancedForces, OfBodiesThatSlideByCoulombsLaw) {
  const Found found = solutionOf(fromFile("input/friction_block/friction_block.xml"), {});
  TEST_ASSERT(found.solution().converged);
  TEST_ASSERT(found.solution().balancing.has_value());
  const Imbalances imbalances = imbalancesOf(found);
  out << imbalances.before << " -> " << imbalances.after << "\n";
  TEST_COMPARE(imbalances.after, <, 1e-11);
}

TEUCHOS_UNIT_TEST(BalancedForces, AreNotComputedUnlessRequested) {
  const SolvedScene solved = solve(prepare(check(cut(read(RunContext(blocks::world()), BlockOnBlock{Cell::Triangle3}.scene()(kCut))))));
  TEST_ASSERT(!solved.solution().balancing);
  TEST_EQUALITY(solved.solution().notBalanced, "");
}

// The error against a solution to twelve digits with the same pair states, by loops over elements.
TEUCHOS_UNIT_TEST(BalancedForces, BoundTheAlgebraicErrorByTheirEnergy) {
  for (const auto& [name, scene] : std::vector<std::pair<std::string, SceneWith>>{
           {"linear", fromFile("input/linear_square/linear_square.xml")}, {"contact", BlockOnBlock{Cell::Triangle3, 16, 8}.scene()}})
    for (const char* tolerance : {"1e-2", "1e-3", "1e-5"}) {
      const auto solved = [&](const char* accuracy) {
        Settings settings = name == "contact" ? Settings{"Partition/METIS/Subdomains=24"} : Settings{};
        settings.push_back(std::string("Outer Solver/Tolerance=") + accuracy);
        return solutionOf(scene, settings);
      };
      const Found rough = solved(tolerance), exact = solved("1e-12");
      for (std::size_t p = 0; p < exact.solution().pairs.size(); ++p)
        TEST_EQUALITY(rough.solution().pairs[p].state.closed(), exact.solution().pairs[p].state.closed());
      std::vector<Vector> error = exact.solution().displacement;
      for (std::size_t i = 0; i < error.size(); ++i) error[i] -= rough.solution().displacement[i];
      const double truth = std::sqrt(energyOf(rough.meshes(), rough.model, error)), bound = std::sqrt(rough.solution().balancing->energy);
      out << name << ", " << tolerance << ": error " << truth << ", bound " << bound << ", " << bound / truth << "\n";
      TEST_COMPARE(truth, >, 0.0);
      TEST_COMPARE(truth, <=, bound * (1.0 + 1e-6));
      TEST_COMPARE(bound, <, 1.25 * truth);  // the largest eigenvalue of M^-1 S is 1.3
    }
}

}  // namespace
}  // namespace suture
