// The verdict accepts right answers of every solver, for any partition.
#include <Teuchos_UnitTestHarness.hpp>
#include <answer/Judged.hpp>
#include <interface/RecoveredPairs.hpp>
#include <solver/ContactMethods.hpp>
#include <solver/RoundScenes.hpp>
#include <support/Cases.hpp>

namespace suture {
namespace {

using namespace blocks;

void holds(const Verification& verdict, bool& success, Teuchos::FancyOStream& out, bool carries = true) {
  TEST_ASSERT(verdict.holds());
  TEST_EQUALITY(verdict.checks.size(), carries ? 14 : 13);  // with `slide`
  for (const Check& check : verdict.checks)
    out << "  " << check.name << " " << check.value << " of " << check.bound << " " << check.where << "\n";
}

std::vector<Scene> sceneList() {
  Scene stiff = pressedBlocks();
  stiff.model.materialOfBody[1].young *= 1e3;
  return {pressedBlocks(),
          stiff,
          swapped(pressedBlocks()),
          turned(pressedBlocks(), 0.5),
          heldOnTheLine(),
          stackedBlocks(2),
          crossingBlocks(),
          looseBlock(),
          mortarBlock(),
          blockOnObstacle(),
          strongAndWeak(1e-6)};
}

TEUCHOS_UNIT_TEST(RightAnswers, OfTheReference) {
  for (const Scene& scene : sceneList()) {
    const Judged answer(scene);
    holds(answer.verdict(), success, out);
  }
  holds(Judged(liftedBlock()).verdict(), success, out, false);
}

/// The balance of a scene that is pressed down: loads by their integrals.
TEUCHOS_UNIT_TEST(RightAnswers, BalanceAppliedAndReactions) {
  const Verification verdict = Judged(looseBlock()).verdict();
  const Balance& balance = verdict.balance;
  TEST_FLOATING_EQUALITY(balance.applied[1], -(0.01 * 2 + 0.004 * 1), 1e-12);
  TEST_FLOATING_EQUALITY(balance.reactions[1], 0.01 * 2 + 0.004 * 1, 1e-10);
  TEST_COMPARE(std::abs(balance.reactions[0]), <, 1e-12);
  TEST_COMPARE(balance.imbalance, <, 1e-11);
  Judged ground(blockOnObstacle());
  double pressing = 0.0, all = 0.0;
  for (const PairResult& pair : ground.pairs) pressing += pair.force;
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, pressing, Teuchos::outArg(all));
  const Verification onGround = ground.verdict();
  TEST_COMPARE(all, >, 0.0);
  TEST_COMPARE(std::abs(onGround.balance.reactions[1]), <, 1e-11 * all);  // the top carries the push of the ground
  TEST_COMPARE(onGround.balance.imbalance, <, 1e-11);
}

Verification ofRecovered(const Scene& scene, const Blocks& all, const InterfaceProblem& problem, const OuterResult& result,
                         double tolerance) {
  const InterfaceProblem::Recovered found = problem.recover(result.state);
  return verify(*world(), {all.meshes, all.model, displacements(all, found), pairsOf(all, found), scene.constraints.pieces, tolerance});
}

TEUCHOS_UNIT_TEST(RightAnswers, OfTheDecomposition) {
  for (const Scene& scene : sceneList())
    for (const double tolerance : casesOf({1e-10, 1e-6, 1e-8})) {
      const OnInterface named(scene, world());
      for (const char* preconditioner : {"BDDC", "Neumann-Neumann"}) {
        const OuterResult result = solveWith("Active Set", named.problem, tolerance, preconditioner);
        TEST_ASSERT(result.converged);
        out << preconditioner << " " << tolerance << " " << result.failure << "\n";
        if (result.converged) holds(ofRecovered(scene, named.all, named.problem, result, tolerance), success, out);
      }
      const Blocks groups(scene, world());
      const CondensedProblem condensed(world(), groups.partition, groups.subdomains, localSolver(), schurOf());
      if (condensed.space()->size() == 0) continue;
      const OuterResult result = solveWith("Semismooth Newton", condensed, tolerance);
      TEST_ASSERT(result.converged);
      out << "Condensed Groups " << tolerance << " " << result.failure << "\n";
      if (result.converged) holds(ofRecovered(scene, groups, condensed, result, tolerance), success, out);
    }
}

/// Second order, nearly incompressible, axisymmetric.
TEUCHOS_UNIT_TEST(RightAnswers, OfOtherElements) {
  for (const bool axisymmetric : {false, true})
    for (const double poisson : {0.3, 0.4999}) {
      const Material material{"ring", 10.0, poisson, poisson > 0.4 ? ElementForm::Mixed : ElementForm::Displacement};
      Scene scene = scenes::quarterRing(Cell::Quadrilateral9, 1.0, 2.0, 4, 8, material, axisymmetric);
      scene.pressure("body_left", 0.1);
      Monitor silent;
      const MonolithicResult found = solveMonolithic(scene.mesh, scene.constraints, scene.model, MonolithicOptions(), silent);
      const Blocks all(scene, world(), 4, 1, false);
      std::vector<Vector> displacement;
      for (const SubdomainMesh& mesh : all.meshes) {
        Vector& u = displacement.emplace_back(2 * mesh.nodes());
        for (int node = 0; node < mesh.nodes(); ++node) u.segment<2>(2 * node) = found.displacement.segment<2>(2 * mesh.globalNodes[node]);
      }
      const Verification verdict = verify(*world(), {all.meshes, all.model, displacement, {}, {}, 1e-8});
      holds(verdict, success, out, false);
      TEST_COMPARE(verdict.balance.imbalance, <, 1e-10);
      // the same answer with another modulus
      Blocks other(scene, world(), 4, 1, false);
      other.model.materialOfBody[0].young *= 1.001;
      TEST_ASSERT(!verify(*world(), {other.meshes, other.model, displacement, {}, {}, 1e-8}).holds());
    }
}

}  // namespace
}  // namespace suture
