// The order of the stages of a run is checked by the compiler; what it cannot check is an InternalError.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

#include <type_traits>

namespace suture {
namespace {

// Each stage takes the result of the previous one only, and uses it up.
template <typename Stage, typename Given>
constexpr bool takes = std::is_invocable_v<Stage, Given>;
static_assert(takes<decltype(cut), MeshedScene> && !takes<decltype(cut), MeshedScene&>);
static_assert(takes<decltype(check), PartitionedScene> && !takes<decltype(check), MeshedScene>);
static_assert(takes<decltype(prepare), CheckedScene> && !takes<decltype(prepare), PartitionedScene>);
using Solve = SolvedScene(PreparedScene);
static_assert(takes<Solve, PreparedScene> && !takes<Solve, CheckedScene> && !takes<Solve, PreparedScene&>);
static_assert(takes<decltype(judge), SolvedScene> && !takes<decltype(judge), PreparedScene> && !takes<decltype(judge), SolvedScene&>);
static_assert(!std::is_copy_constructible_v<PreparedScene> && !std::is_default_constructible_v<JudgedScene>);

/// A block pressed on another one; a stiffness of 2e6 / 2 per area gives the energy.
Scene blockOnBlock(const std::vector<std::string>& settings = {}) {
  ElasticModel model;
  const auto rubber = std::make_shared<IsotropicLaw>(IsotropicModuli{2e6, 0.0});
  model.addBody("upper", rubber);
  model.addBody("lower", rubber);
  const auto mesh = [] { return boxes({{"upper", 0, 1, 0, 1, 2, 2}, {"lower", 0, 1, -1, 0, 2, 2}}); };
  return makeScene(model, mesh,
                   {Condition::displacement("upper_left", {0}, {0}), Condition::displacement("lower_bottom", {0, 0}),
                    Condition::displacement("upper_top", {-0.1}, {1})},
                   {Contact::between("upper_bottom", "lower_top")}, settings);
}

constexpr double kEnergy = 0.5 * 2e6 * 0.05 * 0.05 * 2.0;  // strain .05 in an area of 2

// A verdict without a solution does not hold.
TEUCHOS_UNIT_TEST(Stages, GiveASolutionAndThenItsVerdict) {
  TEST_ASSERT(!Verification().holds());
  for (const std::string method : {"Active Set", "Monolithic"}) {
    MeshedScene meshed = read(RunContext(blocks::world()), blockOnBlock({"Outer Solver/Type=" + method}));
    if (blocks::world()->getRank() == 0) TEST_EQUALITY(meshed.mesh().elements(), 16);
    PreparedScene prepared = prepare(check(cut(std::move(meshed))));
    TEST_EQUALITY(prepared.size().elements, 16);
    SolvedScene solved = solve(std::move(prepared));
    TEST_ASSERT(solved.solution().converged);
    TEST_ASSERT(endingOf(solved.solution()) != ExitCode::Done);
    const JudgedScene judged = judge(std::move(solved));
    TEST_FLOATING_EQUALITY(judged.solution().energy, kEnergy, 1e-9);
    TEST_ASSERT(judged.ending() == ExitCode::Done);
    TEST_EQUALITY(judged.summary().empty(), blocks::world()->getRank() != 0);
    TEST_THROW(judged.report(), InternalError);  // without an output folder
  }
}

TEUCHOS_UNIT_TEST(Stages, SolveAgainAfterSolveIsTheSameSolution) {
  Simulation simulation(blocks::world(), blockOnBlock());
  TEST_THROW(simulation.solution(), InternalError);
  TEST_THROW(simulation.report(), InternalError);
  TEST_THROW(simulation.ending(), InternalError);
  const Solution* first = &simulation.solve();
  TEST_FLOATING_EQUALITY(first->energy, kEnergy, 1e-9);
  TEST_EQUALITY(&simulation.solve(), first);
}

// A failed stage leaves nothing that a later one could use.
TEUCHOS_UNIT_TEST(Stages, AScenesErrorsAreTheSameInEachCall) {
  Simulation simulation(blocks::world(), blockOnBlock({"Output/Probes/far/Type=Point", "Output/Probes/far/Place={9, 9}"}));
  TEST_THROW(simulation.solve(), InputError);
  TEST_THROW(simulation.solution(), InternalError);
  TEST_THROW(simulation.solve(), InputError);
}

}  // namespace
}  // namespace suture
