// The coarse problem of BDDC solved by a further level, with closed contact pairs among its edges.
#include <Teuchos_UnitTestHarness.hpp>
#include <precond/DensePair.hpp>
#include <precond/Preconditioners.hpp>
#include <solver/ContactMethods.hpp>
#include <support/Cases.hpp>

namespace suture {
namespace {

using namespace blocks;

/// pressedBlocks() in 24 subdomains: more than the minimum for this level.
Scene manyBlocks() { return pressed(wavyBlocks(twoBoxes(16, 12, 4, 3))); }

using Settings = std::vector<std::string>;

constexpr double kAccuracy = 0.1;  // the default of `Coarse Accuracy`

Settings with(Settings settings, const std::string& one) {
  settings.push_back(one);
  return settings;
}

std::vector<Settings> combinations() {
  return casesOf<Settings>({{"Edge Constraints=Adaptive", "Adaptive/Threshold=3", "Weighting=Deluxe"},
                            {"Edge Constraints=Rigid Modes"},
                            {"Edge Constraints=Averages"},
                            {"Edge Constraints=Adaptive", "Adaptive/Threshold=100"}},
                           2);
}

// With P within the accuracy of the coarse inverse, M^-1 is within the accuracy of the exact one: additive, and both terms positive.
TEUCHOS_UNIT_TEST(SecondLevelContact, PreconditionerIsPositiveAndWithinItsAccuracyOfTheExactOne) {
  const Scene scene = manyBlocks();
  for (const int open : {0, 3}) {
    const OnInterface one(scene, world());
    const auto matrix = one.matrix(scene, open);
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

// Clusters depend on the ranks: only with an accurate coarse solve the preconditioner does not.
TEUCHOS_UNIT_TEST(SecondLevelContact, AccuratePreconditionerIsTheSameOnAnyNumberOfRanks) {
  const Scene scene = manyBlocks();
  const OnInterface spread(scene, world()), single(scene, alone());
  const auto a = spread.matrix(scene, 3), b = single.matrix(scene, 3);
  for (const Settings& settings : combinations()) {
    const Settings level = with(with(with(settings, "Coarse Level Above=10"), "Coarse Clusters=6"), "Coarse Accuracy=1e-9");
    const DensePair one(*a, *bddcWith(a, level)), other(*b, *bddcWith(b, level));
    TEST_COMPARE(difference(one.m, other.m), <, 1e-7);
  }
}

// Contact nodes in Cartesian unknowns on an inclined line: each closed pair is an equation between four of them, and local problems name
// unknowns that only others determine. Clusters would be loose in them: the coarse problem is solved exactly, and the user is warned.
TEUCHOS_UNIT_TEST(SecondLevelContact, IsLeftOutWhereRowsHaveSeveralTerms) {
  const Scene scene = turned(manyBlocks(), 0.5);
  const OnInterface one(scene, world());
  const auto matrix = one.matrix(scene);
  for (const Settings& settings : combinations()) {
    const auto level = bddcWith(matrix, with(with(settings, "Coarse Level Above=10"), "Coarse Clusters=5"));
    TEST_INEQUALITY(level->remark().find("solved exactly"), std::string::npos);
    const auto exact = bddcWith(matrix, with(settings, "Coarse Level Above=24"));
    TEST_EQUALITY(exact->remark().find("solved exactly"), std::string::npos);
    const DensePair one(*matrix, *level), other(*matrix, *exact);
    TEST_COMPARE(difference(one.m, other.m), <, 1e-9);
    TEST_COMPARE(other.eigenvalues()(0), >, 1.0 - 1e-7);
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
        return makePreconditioner(
            bddcList(with(with(settings, level ? "Coarse Level Above=10" : "Coarse Level Above=1000"), "Coarse Clusters=6")));
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
