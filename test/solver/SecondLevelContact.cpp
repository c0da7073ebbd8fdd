// The coarse problem of BDDC solved by a level more, with closed contact pairs among its edges.
#include <Teuchos_UnitTestHarness.hpp>
#include <precond/DensePair.hpp>
#include <precond/Preconditioners.hpp>
#include <solver/ContactMethods.hpp>

namespace suture {
namespace {

using namespace blocks;

/// pressedBlocks() in 24 subdomains: more than the level needs to be used.
Scene manyBlocks() {
  std::vector<Box> all(2);
  for (int k = 0; k < 2; ++k) {
    all[k].name = k == 0 ? "lower" : "upper";
    all[k].x0 = -1;
    all[k].y0 = k - 1;
    all[k].y1 = k;
    all[k].nx = 16;
    all[k].ny = 12;
    all[k].blocksX = 4;
    all[k].blocksY = 3;
  }
  Scene scene = scenes::fromBoxes(all, 100.0, 0.3);
  scene.model.materialOfBody[1].young = 40.0;
  scene.pairUp();
  for (ContactPair& pair : scene.constraints.pairs) pair.gap = 0.02 * std::cos(3.0 * pair.position[0] + 0.5);
  scene.fixLower();
  scene.hold("upper_top", 0, 0.01);
  scene.hold("upper_top", 1, -0.015);
  return scene;
}

using Settings = std::vector<std::string>;

constexpr double kAccuracy = 0.1;  // the default of `Coarse Accuracy`

Settings with(Settings settings, const std::string& one) {
  settings.push_back(one);
  return settings;
}

const std::vector<Settings>& combinations() {
  static const std::vector<Settings> all{{"Edge Constraints=Rigid Modes"},
                                         {"Edge Constraints=Averages"},
                                         {"Edge Constraints=Adaptive", "Adaptive/Threshold=3", "Weighting=Deluxe"},
                                         {"Edge Constraints=Adaptive", "Adaptive/Threshold=100"}};
  return all;
}

/// Every third pair open, or none.
Teuchos::RCP<InterfaceOperator> matrixOf(const OnInterface& one, const Scene& scene, bool open) {
  std::vector<Vector> zeros;
  for (const auto& subdomain : one.all.subdomains) zeros.emplace_back(Vector::Zero(subdomain->dofs()));
  std::map<int, PairStatus> status;
  for (const ContactPair& pair : scene.constraints.pairs)
    if (open && pair.id % 3 == 1) status[pair.id] = PairStatus::Open;
  return one.problem.linearise(one.problem.stateOf(zeros, status)).matrix;
}

// With P within the accuracy of the coarse inverse, M^-1 is within the accuracy of the exact one: additive, and both terms positive.
TEUCHOS_UNIT_TEST(SecondLevelContact, PreconditionerIsPositiveAndWithinItsAccuracyOfTheExactOne) {
  const Scene scene = manyBlocks();
  for (const bool open : {false, true}) {
    const OnInterface one(scene, world());
    const auto matrix = matrixOf(one, scene, open);
    for (const Settings& settings : combinations()) {
      const DensePair exact(*matrix, *bddcWith(matrix, with(settings, "Coarse Level Above=1000")));
      const DensePair level(*matrix, *bddcWith(matrix, with(settings, "Coarse Level Above=10")));
      TEST_COMPARE(difference(level.m, level.m.transpose()), <, 1e-9);
      TEST_COMPARE(difference(level.m, exact.m), >, 1e-6);  // the level is used
      const Vector values = level.eigenvalues();
      const double largest = exact.eigenvalues().maxCoeff();
      out << settings.front() << ": " << values(0) << " .. " << values(values.size() - 1) << ", exactly 1 .. " << largest << "\n";
      TEST_COMPARE(values(0), >, 1.0 - kAccuracy);
      TEST_COMPARE(values(values.size() - 1), <, (1.0 + kAccuracy) * largest);
    }
  }
}

TEUCHOS_UNIT_TEST(SecondLevelContact, PreconditionerIsTheSameOnAnyNumberOfRanks) {
  const Scene scene = manyBlocks();
  const OnInterface spread(scene, world()), single(scene, alone());
  const auto a = matrixOf(spread, scene, true), b = matrixOf(single, scene, true);
  for (const Settings& settings : combinations()) {
    const Settings level = with(with(settings, "Coarse Level Above=10"), "Coarse Clusters=6");
    const DensePair one(*a, *bddcWith(a, level)), other(*b, *bddcWith(b, level));
    TEST_COMPARE(difference(one.m, other.m), <, 1e-7);
  }
}

// Contact nodes in Cartesian unknowns on an inclined line: each closed pair is an equation between four of them, which clusters cannot
// divide among them. Where that fails the user is told which parameter to change, and changing it helps.
TEUCHOS_UNIT_TEST(SecondLevelContact, SaysWhichParameterWhereClustersHaveMechanisms) {
  const Scene scene = turned(manyBlocks(), 0.5);
  const OnInterface one(scene, world());
  const auto matrix = matrixOf(one, scene, false);
  for (const Settings& settings : combinations()) {
    try {
      bddcWith(matrix, with(with(settings, "Coarse Level Above=10"), "Coarse Clusters=5"));
      success = false;
      out << settings.front() << ": not refused\n";
    } catch (const InputError& error) {
      TEST_EQUALITY(error.problems().front().path, "Preconditioner/BDDC/Coarse Level Above");
      out << error.what() << "\n";
    }
    const DensePair exact(*matrix, *bddcWith(matrix, with(settings, "Coarse Level Above=24")));
    TEST_COMPARE(exact.eigenvalues()(0), >, 1.0 - 1e-7);
  }
}

TEUCHOS_UNIT_TEST(SecondLevelContact, LeadsToTheReferencesSolution) {
  const Scene scene = manyBlocks();
  Monitor silent;
  const MonolithicResult reference = solveMonolithic(scene.mesh, scene.constraints, scene.model, MonolithicOptions(), silent);
  TEST_ASSERT(reference.converged);
  const OnInterface one(scene, world());
  for (const Settings& settings : combinations()) {
    int pcg[2];
    for (const bool level : {false, true}) {
      const OuterResult result = solveWith("Active Set", one.problem, 1e-10, [&] {
        Settings all = with(with(settings, level ? "Coarse Level Above=10" : "Coarse Level Above=1000"), "Coarse Clusters=6");
        for (std::string& setting : all) setting = "BDDC/" + setting;
        all.insert(all.begin(), "Type=BDDC");
        return makePreconditioner(resolved("Preconditioner", preconditionerSchema(), all));
      });
      TEST_ASSERT(result.converged);
      pcg[level] = result.pcgTotal;
      const Distance far = distance(one.all, one.problem.recover(result.state), reference);
      TEST_COMPARE(far.displacement, <, 1e-7);
      TEST_COMPARE(far.force, <, 1e-6);
      TEST_EQUALITY(far.otherwise, 0);
    }
    out << settings.front() << ": PCG " << pcg[0] << " exactly, " << pcg[1] << " with the level\n";
    TEST_COMPARE(pcg[1], <, 1.3 * pcg[0] + 5);
  }
}

}  // namespace
}  // namespace suture
