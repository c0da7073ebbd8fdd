// A user's preconditioner may apply the operator: the solver records only its own applications.
#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_MultiVector.hpp>
#include <support/Blocks.hpp>
#include <support/DryLaw.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/precond/Preconditioner.hpp>
#include <suture/simulation/Simulation.hpp>

namespace suture {
namespace {

/// Terms of the Neumann series of the operator, scaled by its diagonal.
class NeumannSeries : public Preconditioner {
 protected:
  void doCompute() override {
    Matrix diagonal = Matrix::Zero(space()->overlapSize(), 1);
    for (int i = 0; i < space()->locals(); ++i)
      if (const auto& local = matrix()->locals()[static_cast<std::size_t>(i)])
        space()->coupling(i).addTransposed(local->stiffnessDiagonal(), diagonal);
    space()->sumDensities(diagonal);
    inverse_ = space()->vector();
    auto inverse = localView(*inverse_);
    for (int place = 0; place < space()->overlapSize(); ++place)
      if (const int row = space()->ownedRow(place); row >= 0 && diagonal(place, 0) > 0.0) inverse(row, 0) = 1.0 / diagonal(place, 0);
  }
  void doApply(const MultiVector& r, MultiVector& z) const override {
    constexpr int kTerms = 2;  // even: positive definite for any largest eigenvalue
    MultiVector rest(r, Teuchos::Copy);
    localView(z) = localView(*inverse_).col(0).asDiagonal() * localView(r);
    for (int k = 0; k < kTerms; ++k) {
      matrix()->apply(z, rest);
      rest.update(1.0, r, -1.0);
      localView(z) += localView(*inverse_).col(0).asDiagonal() * localView(rest);
    }
  }

 private:
  MultiVectorPtr inverse_;
};

const Registration<Preconditioner> registration("Neumann Series", Schema("for the test"),
                                                [](const Parameters&) { return std::make_unique<NeumannSeries>(); });

/// A block on a longer one, half of it pressed down: pairs open, and with friction some slip.
Scene twoPressedBlocks(const std::vector<std::string>& settings) {
  ElasticModel model;
  const auto rubber = std::make_shared<IsotropicLaw>(IsotropicModuli{2e6, 0.3});
  model.addBody("upper", rubber);
  model.addBody("lower", rubber);
  model.loads = {Load::pressure("upper_left", 4e4)};
  const auto mesh = [] { return boxes({{"upper", 0, 1, 0, 1, 8, 8}, {"lower", -1, 2, -1, 0, 24, 8}}); };
  return makeScene(model, mesh, {Condition::displacement("lower_bottom", {0, 0}), Condition::displacement("upper_top", {0.0, -0.02})},
                   {Contact::between("upper_bottom", "lower_top")}, settings);
}

TEUCHOS_UNIT_TEST(OwnPreconditioner, MayApplyTheOperator) {
  for (const bool frictional : {false, true}) {
    const auto solved = [&](const std::vector<std::string>& more) {
      std::vector<std::string> settings{"Partition/METIS/Subdomains=6", "Outer Solver/Tolerance=1e-10"};
      settings.insert(settings.end(), more.begin(), more.end());
      Scene scene = twoPressedBlocks(settings);
      if (frictional) scene.laws = ContactLaws({scenes::dry(0.0, 0.2)});
      Simulation simulation(blocks::world(), scene);
      const Solution& found = simulation.solve();
      TEST_ASSERT(simulation.ending() == ExitCode::Done);
      return std::make_pair(found.energy, found.pcgTotal);
    };
    const auto [energy, applications] = solved({});
    const auto [ownEnergy, ownApplications] = solved({"Preconditioner/Type=Neumann Series"});
    TEST_FLOATING_EQUALITY(ownEnergy, energy, 1e-8);
    TEST_COMPARE(ownApplications, >, applications);  // it is different, and weaker
  }
}

TEUCHOS_UNIT_TEST(OwnPreconditioner, IsNotAppliedBeforeItIsComputed) {
  NeumannSeries series;
  TEST_THROW(series.compute(Teuchos::null), InternalError);
}

}  // namespace
}  // namespace suture
