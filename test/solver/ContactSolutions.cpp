// Contact On The Interface with Active Set, Condensed Groups with Semismooth Newton, and the monolithic reference: one solution for any
// partition, preconditioner and number of ranks.
#include <Teuchos_UnitTestHarness.hpp>
#include <solver/ContactMethods.hpp>

namespace suture {
namespace {

using namespace blocks;

MonolithicResult monolithic(const Scene& scene) {
  Monitor silent;
  return solveMonolithic(scene.mesh, scene.constraints, scene.model, MonolithicOptions(), silent);
}

void isTheReferences(const Blocks& all, const InterfaceProblem& problem, const OuterResult& result, const MonolithicResult& reference,
                     bool& success, Teuchos::FancyOStream& out) {
  TEST_ASSERT(result.converged);
  if (!result.converged) {
    out << result.failure << "\n";
    return;
  }
  const InterfaceProblem::Recovered found = problem.recover(result.state);
  const Distance far = distance(all, found, reference);
  TEST_COMPARE(far.displacement, <, 1e-7);
  TEST_COMPARE(far.force, <, 1e-6);
  TEST_EQUALITY(far.otherwise, 0);
  TEST_FLOATING_EQUALITY(found.energy, reference.energy, 1e-9);
}

void allAgree(const Scene& scene, bool& success, Teuchos::FancyOStream& out) {
  const MonolithicResult reference = monolithic(scene);
  TEST_ASSERT(reference.converged);
  int closed = 0;
  for (const PairResult& pair : reference.pairs) closed += pair.state.closed();
  TEST_COMPARE(closed, >, 0);
  TEST_COMPARE(closed, <, int(reference.pairs.size()));  // otherwise it would not be a contact problem

  const OnInterface named(scene, world());
  for (const char* preconditioner : {"BDDC", "Neumann-Neumann"}) {
    out << "named subdomains, " << preconditioner << "\n";
    isTheReferences(named.all, named.problem, solveWith("Active Set", named.problem, 1e-10, preconditioner), reference, success, out);
  }
  for (const int seed : {1, 2, 3}) {
    const OnInterface cut(scene, world(), int(scene.model.bodies.size()) + 2 * seed, seed);
    out << "METIS, " << cut.all.partition.subdomains() << " subdomains, seed " << seed << "\n";
    isTheReferences(cut.all, cut.problem, solveWith("Active Set", cut.problem), reference, success, out);
  }
  const Blocks groups(scene, world());
  const CondensedProblem condensed(world(), groups.partition, groups.subdomains, localSolver(), schurOf());
  if (condensed.space()->size() == 0) return;
  for (const char* preconditioner : {"BDDC", "Neumann-Neumann"}) {
    out << "Condensed Groups, " << preconditioner << "\n";
    isTheReferences(groups, condensed, solveWith("Semismooth Newton", condensed, 1e-10, preconditioner), reference, success, out);
  }
}

TEUCHOS_UNIT_TEST(ContactSolutions, PressedBlocks) { allAgree(pressedBlocks(), success, out); }
TEUCHOS_UNIT_TEST(ContactSolutions, PressedBlocksOfVeryDifferentStiffness) {
  for (const double jump : {1e4, 1e-4}) {
    Scene scene = pressedBlocks();
    scene.model.materialOfBody[1].young = jump * scene.model.materialOfBody[0].young;
    scene.model.loads.clear();
    allAgree(scene, success, out);
  }
}
TEUCHOS_UNIT_TEST(ContactSolutions, SwappedSides) { allAgree(swapped(pressedBlocks()), success, out); }
TEUCHOS_UNIT_TEST(ContactSolutions, InclinedBlocks) { allAgree(turned(pressedBlocks(), 0.5), success, out); }
TEUCHOS_UNIT_TEST(ContactSolutions, NodesHeldOnTheLine) { allAgree(heldOnTheLine(), success, out); }
TEUCHOS_UNIT_TEST(ContactSolutions, StackedBlocks) {
  for (const int middleRows : {2, 3}) allAgree(stackedBlocks(middleRows), success, out);
}
TEUCHOS_UNIT_TEST(ContactSolutions, BlocksThatMeetInAPoint) { allAgree(crossingBlocks(), success, out); }
TEUCHOS_UNIT_TEST(ContactSolutions, InclinedBlocksThatMeetInAPoint) { allAgree(turned(crossingBlocks(), 0.5), success, out); }

}  // namespace
}  // namespace suture
