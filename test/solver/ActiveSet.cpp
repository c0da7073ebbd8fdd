#include <Teuchos_UnitTestHarness.hpp>
#include <solver/ContactMethods.hpp>
#include <suture/condensed/CondensedProblem.hpp>
#include <suture/solver/ActiveSet.hpp>

namespace suture {
namespace {

using namespace blocks;

/// A problem that forwards everything to another one; tests override the functions that they change or watch.
struct Passing : InterfaceProblem {
  const InterfaceProblem& real;
  explicit Passing(const InterfaceProblem& given) : real(given) {}
  const std::shared_ptr<const InterfaceSpace>& space() const override { return real.space(); }
  InterfaceState initialState() const override { return real.initialState(); }
  InterfaceState stateOf(const std::vector<Vector>& values, const std::map<int, ContactState>& status) const override {
    return real.stateOf(values, status);
  }
  Evaluation evaluate(const InterfaceState& state, double resolution) const override { return real.evaluate(state, resolution); }
  Linearisation linearise(const InterfaceState& state) const override { return real.linearise(state); }
  int conform(InterfaceState& state) const override { return real.conform(state); }
  void update(InterfaceState& state, const MultiVector& step, double length, const Matrix* image) const override {
    real.update(state, step, length, image);
  }
  std::vector<int> differing(const ContactStates& a, const ContactStates& b) const override { return real.differing(a, b); }
  Recovered recover(const InterfaceState& state) const override { return real.recover(state); }
  int pieces() const override { return real.pieces(); }
  int pairs() const override { return real.pairs(); }
  const ContactProblem* contact() const override { return real.contact(); }
};

// Every application of the operator uses every subdomain's Schur complement once, and nothing else does: BDDC uses the dense matrices.
TEUCHOS_UNIT_TEST(ActiveSet, CountsEveryApplicationOfTheOperator) {
  Scene touching = pressedBlocks();
  for (ContactPair& pair : touching.constraints.pairs) pair.gap = 0.0;
  for (const Scene& scene : {touching, pressedBlocks(), crossingBlocks(), turned(crossingBlocks(), 0.5)})
    for (const double tolerance : {1e-4, 1e-10}) {
      const Blocks all(scene, world(), std::vector<double>(), false);
      std::vector<SchurComplement*> made;
      const auto schur = [&made] {
        auto one = schurComplement("Explicit");
        made.push_back(one.get());
        return one;
      };
      const ContactInterfaceProblem problem(world(), all.partition, all.subdomains, localSolver(), schur);
      for (const SchurComplement* one : made) TEST_EQUALITY(one->applications(), 0);
      const OuterResult result = solveWith("Active Set", problem, tolerance);
      TEST_ASSERT(result.converged);
      for (const SchurComplement* one : made) TEST_EQUALITY(one->applications(), result.auxiliary.pcg + result.pcgTotal);
    }
}

TEUCHOS_UNIT_TEST(ActiveSet, GoesOnFromASolution) {
  const OnInterface one(crossingBlocks(), world());
  const OuterResult first = solveWith("Active Set", one.problem);
  TEST_ASSERT(first.converged);
  OuterSettings settings;
  settings.tolerance = 1e-8;
  settings.preconditioner = preconditioner("BDDC");
  Monitor silent;
  Parameters own;
  own.set("Inner Tolerance", 1e-3);
  // every rank must know the status of the pairs it sees, not of those that it reports
  const ClosedSet closed = closedSet(one.problem.contact()->statesOf(first.state.status));
  std::map<int, ContactState> status;
  for (std::size_t i = 0; i < closed.size(); ++i) status[static_cast<int>(i)] = closed[i] ? PairStatus::Slip : PairStatus::Open;
  const InterfaceState start = one.problem.stateOf(one.problem.interiors(first.state), status);
  const OuterResult again = Registry<OuterSolver>::instance().make("Active Set", own)->solve(one.problem, settings, silent, &start);
  TEST_ASSERT(again.converged);
  TEST_EQUALITY(again.iterations, 0);
  TEST_COMPARE(again.pcgTotal, <=, 2);  // applications of the operator, to verify the solution
  TEST_ASSERT(one.problem.differing(again.state.status, first.state.status).empty());
}

/// Counts the linear solves that start anew: continued ones report no iteration 0.
class Starts : public Monitor {
 public:
  void inner(int iteration, double) override { count += iteration == 0; }
  bool wantsInner() const override { return true; }
  int count = 0;
};

/// Counts the steps of conjugate gradients.
class Steps : public Monitor {
 public:
  void inner(int iteration, double) override { count += iteration > 0; }
  bool wantsInner() const override { return true; }
  int count = 0;
};

TEUCHOS_UNIT_TEST(ActiveSet, ReportsApplicationsThatAreNoSteps) {
  for (const Scene& scene : {pressedBlocks(), crossingBlocks()}) {
    const OnInterface one(scene, world());
    OuterSettings settings;
    settings.tolerance = 1e-9;
    settings.preconditioner = preconditioner("BDDC");
    Parameters own;
    own.set("Inner Tolerance", 1e-2);
    Steps steps;
    const OuterResult result = Registry<OuterSolver>::instance().make("Active Set", own)->solve(one.problem, settings, steps);
    TEST_ASSERT(result.converged);
    TEST_COMPARE(result.otherApplications, >, 0);
    TEST_EQUALITY(result.auxiliary.pcg + result.pcgTotal - result.otherApplications, steps.count);
  }
}

// All pairs stay closed: one linear problem from the auxiliary solution to the end, in both formulations.
TEUCHOS_UNIT_TEST(ActiveSet, AndNewtonGoOnWithOneLinearSolveWhileNoPairChanges) {
  Scene touching = pressedBlocks();
  for (ContactPair& pair : touching.constraints.pairs) pair.gap = 0.0;
  const OnInterface one(touching, world());
  const Blocks whole(touching, world());
  const CondensedProblem condensed(world(), whole.partition, whole.subdomains, localSolver(), schurOf());
  for (const char* method : {"Active Set", "Semismooth Newton"}) {
    const bool onInterface = std::string(method) == "Active Set";
    const InterfaceProblem& problem = onInterface ? static_cast<const InterfaceProblem&>(one.problem) : condensed;
    OuterSettings settings;
    settings.tolerance = 1e-9;
    settings.preconditioner = preconditioner(onInterface ? "BDDC" : "Neumann-Neumann");
    Parameters own;
    own.set("Inner Tolerance", 1e-2);
    Starts starts;
    const OuterResult result = Registry<OuterSolver>::instance().make(method, own)->solve(problem, settings, starts);
    TEST_ASSERT(result.converged);
    TEST_COMPARE(result.iterations, >=, 2);
    TEST_ASSERT(problem.differing(result.state.status, problem.initialState().status).empty());
    out << method << ": " << result.iterations << " steps, " << result.auxiliary.pcg << " + " << result.pcgTotal << " PCG\n";
    TEST_EQUALITY(starts.count, 1);
  }
}

}  // namespace
}  // namespace suture
