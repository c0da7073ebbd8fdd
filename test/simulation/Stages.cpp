// Each wrong order of the stages of a simulation is an InternalError: none crashes, and none returns an answer.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

#include <set>

namespace suture {
namespace {

using Function = std::function<void(Simulation&)>;

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

struct Named {
  const char* name;
  Function call;
  std::set<int> allowed;  // numbers of completed stages after which it may be called
};

const std::vector<Function> stages{[](Simulation& s) { s.read(); },    [](Simulation& s) { s.cut(); },
                                   [](Simulation& s) { s.check(); },   [](Simulation& s) { s.prepare(); },
                                   [](Simulation& s) { s.iterate(); }, [](Simulation& s) { s.judge(); }};

const std::vector<Named> functions{{"read", stages[0], {0}},
                                   {"cut", stages[1], {1}},
                                   {"check", stages[2], {2}},
                                   {"prepare", stages[3], {3}},
                                   {"iterate", stages[4], {4}},
                                   {"judge", stages[5], {5}},
                                   {"remark", [](Simulation& s) { s.remark(); }, {2, 3, 4, 5, 6}},
                                   {"start", [](Simulation& s) { s.start(); }, {4}},
                                   {"solution", [](Simulation& s) { s.solution(); }, {5, 6}},
                                   {"summary", [](Simulation& s) { s.summary(); }, {6}},
                                   {"report", [](Simulation& s) { s.report(); }, {}},
                                   {"coupling", [](Simulation& s) { s.coupling("lower_left"); }, {0, 1, 2, 3}},
                                   {"solveAgain", [](Simulation& s) { s.solveAgain(); }, {}},
                                   {"verify", [](Simulation& s) { s.verify(); }, {5}},
                                   {"advance", [](Simulation& s) { s.advance(); }, {}},
                                   {"setForces", [](Simulation& s) { s.setForces(CouplingSurface(), {}); }, {}},
                                   {"setDisplacements", [](Simulation& s) { s.setDisplacements(CouplingSurface(), {}); }, {}},
                                   {"solve", [](Simulation& s) { s.solve(); }, {0, 6}}};

TEUCHOS_UNIT_TEST(Stages, AWrongOrderIsAnInternalErrorAndARightOneIsNot) {
  for (int done = 0; done <= static_cast<int>(stages.size()); ++done)
    for (const Named& function : functions) {
      Simulation simulation(blocks::world(), blockOnBlock());
      for (int stage = 0; stage < done; ++stage) stages[static_cast<std::size_t>(stage)](simulation);
      std::string thrown;
      try {
        function.call(simulation);
      } catch (const InternalError& error) {
        thrown = error.what();
      }
      const bool allowed = function.allowed.count(done) > 0;
      if (thrown.empty() != allowed) out << function.name << "() after " << done << " stages: '" << thrown << "'\n";
      TEST_EQUALITY(thrown.empty(), allowed);
      // After a refusal the right order continues.
      if (allowed || done == 6) continue;
      for (int stage = done; stage < 6; ++stage) stages[static_cast<std::size_t>(stage)](simulation);
      TEST_FLOATING_EQUALITY(simulation.solution().energy, kEnergy, 1e-9);
      TEST_ASSERT(simulation.ending() == ExitCode::Done);
    }
}

TEUCHOS_UNIT_TEST(Stages, NamesTheStageThatIsMissing) {
  Simulation simulation(blocks::world(), blockOnBlock());
  const auto said = [&](const Function& function) {
    try {
      function(simulation);
    } catch (const InternalError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  TEST_EQUALITY(said(stages[5]).find("judge() before iterate(); expected order"), 0u);
  simulation.read();
  TEST_EQUALITY(said(stages[0]).find("read() after read(); expected order"), 0u);
}

// A verdict without a solution does not hold.
TEUCHOS_UNIT_TEST(Stages, AVerdictWithoutChecksDoesNotHold) {
  TEST_ASSERT(!Verification().holds());
  Simulation simulation(blocks::world(), blockOnBlock());
  TEST_ASSERT(simulation.ending() != ExitCode::Done);
  for (int stage = 0; stage < 5; ++stage) stages[static_cast<std::size_t>(stage)](simulation);
  TEST_ASSERT(simulation.solution().converged);
  TEST_ASSERT(simulation.ending() != ExitCode::Done);
}

TEUCHOS_UNIT_TEST(Stages, SolveAgainAfterSolveIsTheSameSolution) {
  Simulation simulation(blocks::world(), blockOnBlock());
  const Solution* first = &simulation.solve();
  TEST_FLOATING_EQUALITY(first->energy, kEnergy, 1e-9);
  TEST_EQUALITY(&simulation.solve(), first);
}

// A failed stage leaves nothing that a later one could use.
TEUCHOS_UNIT_TEST(Stages, NoneFollowsOneThatFailed) {
  Simulation simulation(blocks::world(), blockOnBlock({"Output/Probes/far/Type=Point", "Output/Probes/far/Place={9, 9}"}));
  TEST_THROW(simulation.solve(), InputError);
  for (const Named& function : functions) TEST_THROW(function.call(simulation), InternalError);
}

TEUCHOS_UNIT_TEST(Stages, ACoupledSceneIsSolvedBySolveAgainOnly) {
  Simulation simulation(blocks::world(), blockOnBlock()), other(blocks::world(), blockOnBlock());
  const CouplingSurface surface = simulation.coupling("upper_right");
  TEST_THROW(simulation.solve(), InternalError);
  TEST_THROW(simulation.verify(), InternalError);
  TEST_THROW(simulation.advance(), InternalError);
  TEST_THROW(other.setForces(surface, std::vector<double>(surface.coordinates.size(), 0.0)), InternalError);
  TEST_FLOATING_EQUALITY(simulation.solveAgain().energy, kEnergy, 1e-9);
  TEST_THROW(simulation.iterate(), InternalError);
  TEST_THROW(simulation.coupling("upper_left"), InternalError);
  TEST_FLOATING_EQUALITY(simulation.solveAgain(false).energy, kEnergy, 1e-9);
  simulation.judge();
  TEST_ASSERT(simulation.ending() == ExitCode::Done);
  TEST_THROW(simulation.solveAgain(), InternalError);
  TEST_THROW(simulation.advance(), InternalError);
  TEST_FLOATING_EQUALITY(simulation.solve().energy, kEnergy, 1e-9);
}

}  // namespace
}  // namespace suture
