// Load steps reuse what does not depend on loads: subdomain factors and preconditioner are counted.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/precond/Bddc.hpp>
#include <suture/simulation/CoupledScene.hpp>
#include <suture/simulation/Simulation.hpp>
#include <suture/subdomain/ExplicitSchurComplement.hpp>

#include <Teuchos_CommHelpers.hpp>

namespace suture {
namespace {

int factored = 0, reloaded = 0, preconditioned = 0;

class CountingSchur : public ExplicitSchurComplement {
 protected:
  void doCompute(const SchurData& data) override {
    ++factored;
    ExplicitSchurComplement::doCompute(data);
  }
  void doReload(const SchurData& data) override {
    ++reloaded;
    ExplicitSchurComplement::doReload(data);
  }
};

class CountingBddc : public Bddc {
 public:
  using Bddc::Bddc;

 protected:
  void doCompute() override {
    ++preconditioned;
    Bddc::doCompute();
  }
};

const Registration<SchurComplement> schur("Counting", Schema("Explicit, counted"),
                                          [](const Parameters&) { return std::make_unique<CountingSchur>(); });
const Registration<Preconditioner> preconditioner("Counting", Bddc::schema(),
                                                  [](const Parameters& own) { return std::make_unique<CountingBddc>(own); });

Scene beam(const std::vector<std::string>& settings) {
  ElasticModel model;
  model.addBody("beam", std::make_shared<IsotropicLaw>(IsotropicModuli{2e6, 0.3}));
  model.loads = {Load::traction("beam_right", {0, -10, 0}), Load::pressure("beam_top", 5)};
  model.loads[0].name = "pull";
  model.loads[1].name = "press";
  std::vector<std::string> all{"Partition/METIS/Subdomains=6", "Subdomain/Schur Complement=Counting", "Preconditioner/Type=Counting",
                               "Outer Solver/Tolerance=1e-12"};
  all.insert(all.end(), settings.begin(), settings.end());
  return makeScene(
      model,
      [] {
        return boxes({{"beam", 0, 4, 0, 1, 32, 8}});
      },
      {Condition::displacement("beam_left", {0, 0})}, {}, all);
}

int over(int mine) {
  int all = 0;
  Teuchos::reduceAll(*blocks::world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

TEUCHOS_UNIT_TEST(ReusedFactors, ALinearPathFactorsOnce) {
  factored = reloaded = preconditioned = 0;
  Simulation path(blocks::world(),
                  beam({"Load Steps/Times={1, 2, 3, 4}", "Load Steps/Factors/pull={1, 0, -1, 2}", "Load Steps/Factors/press=t"}));
  const Solution last = path.solve();
  TEST_ASSERT(path.ending() == ExitCode::Done);
  TEST_EQUALITY(over(factored), 6);
  TEST_EQUALITY(over(reloaded), 3 * 6);
  TEST_EQUALITY(preconditioned, 1);  // on every rank
  Simulation alone(blocks::world(), beam({}));
  const Solution one = alone.solve();
  // u(2 pull + 4 press) against one solution of a scene with these loads
  Scene both = beam({});
  both.model.loads[0].value[1] *= 2;
  both.model.loads[1].value[0] *= 4;
  Simulation direct(blocks::world(), both);
  const Solution& expected = direct.solve();
  for (std::size_t i = 0; i < last.displacement.size(); ++i) {
    TEST_COMPARE((last.displacement[i] - expected.displacement[i]).norm(), <, 1e-10 * expected.displacement[i].norm());
    TEST_COMPARE((one.displacement[i] - expected.displacement[i]).norm(), >, 0.1 * expected.displacement[i].norm());
  }
}

/// Blocks in contact, of 6 subdomains.
Scene pressedBlocks() {
  ElasticModel model;
  for (const char* body : {"upper", "lower"}) model.addBody(body, std::make_shared<IsotropicLaw>(IsotropicModuli{2e6, 0.3}));
  model.loads = {Load::bodyForce({0, -1e4, 0}, "upper")};
  return makeScene(model,
                   [] {
                     return boxes({{"upper", 0, 2, 0, 1, 24, 12}, {"lower", 0, 2, -1, 0, 24, 12}});
                   },
                   {Condition::displacement("lower_bottom", {0, 0}), Condition::displacement("upper_left", {0}, {0})},
                   {Contact::between("upper_bottom", "lower_top")},
                   {"Partition/METIS/Subdomains=6", "Subdomain/Schur Complement=Counting", "Preconditioner/Type=Counting"});
}

TEUCHOS_UNIT_TEST(ReusedFactors, ACoupledSceneFactorsOnce) {
  for (const bool contact : {false, true}) {
    factored = reloaded = preconditioned = 0;
    CoupledScene coupled(blocks::world(), contact ? pressedBlocks() : beam({}));
    const CouplingSurface surface = coupled.surface(contact ? "upper_top" : "beam_right");
    const int solves = 4;
    int first = 0;
    for (int solve = 0; solve < solves; ++solve) {
      std::vector<double> forces;
      for (const double area : surface.areas) forces.insert(forces.end(), {10.0 * solve * area, -300.0 * area});
      coupled.setForces(surface, forces);
      coupled.solve();
      TEST_ASSERT(coupled.ending() == ExitCode::Done);
      if (solve == 0) first = preconditioned;
    }
    TEST_EQUALITY(over(factored), 6);
    TEST_COMPARE(over(reloaded), >=, solves - 1);  // subdomains whose loads changed
    TEST_COMPARE(over(reloaded), <, (solves - 1) * 6);
    TEST_COMPARE(first, >=, 1);
    TEST_EQUALITY(preconditioned, first);  // as many as the sets of the first solve needed: the other solves did not change them
  }
}

}  // namespace
}  // namespace suture
