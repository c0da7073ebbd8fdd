#include <support/CondensedBody.hpp>

#include <suture/condensed/TrescaFixedPoint.hpp>

#include <Teuchos_UnitTestHarness.hpp>

namespace suture {
namespace {

using scenes::dry;

/// A linear solver whose slipping forces cannot follow normal forces.
struct GivenBounds : CondensedBody {
  using CondensedBody::CondensedBody;
  bool follows = false;  // some state had friction in it
  bool couplesToNormal() const override { return false; }
  ContactAnswer solve(const PairStates& states, double tolerance) override {
    for (const ContactState& state : states) follows = follows || state.couplesToNormal();
    return CondensedBody::solve(states, tolerance);
  }
};

// violation() tests Coulomb's law itself, by the laws and the equilibrium of the body.
TEUCHOS_UNIT_TEST(TrescaFixedPoint, EndsAtASolutionOfCoulombsLaw) {
  std::mt19937 random(31);
  const SearchLaw tied = std::make_shared<Tied>(), smooth = std::make_shared<Frictionless>();
  const std::vector<std::vector<SearchLaw>> choices{{dry(0, 0.1)}, {dry(0, 0.3)}, {dry(0.2, 0.0)}, {dry(0, 0.3), tied, smooth}};
  int solved = 0, slips = 0, opens = 0;
  double worst = 0.0, contraction = 0.0;
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<SearchLaw>& laws = choices[trial % choices.size()];
    GivenBounds body(2 + trial % 2, 3 + trial % 8);
    body.random(random, false);
    if (trial % 4 == 2)  // a bound is lost where a pair opens, which leaves problems without solution: pressed together
      for (int i = 0; i < body.nodes; ++i) body.load(body.dimension * i) += 3.0;
    std::vector<int> lines;
    for (int i = 0; i < body.nodes; ++i) lines.push_back(i % int(laws.size()));
    body.begin(laws, lines);
    TrescaFixedPoint search(*body.rigid, body.laws, body.sites, body, 400);
    const StateSearch::Result found = search.run();
    TEST_EQUALITY(found.solves, body.solves);
    TEST_ASSERT(!body.follows);
    TEST_ASSERT(!body.strange);
    solved += found.converged;
    if (!found.converged) continue;
    contraction = std::max(contraction, found.contraction);
    worst = std::max(worst, body.violation());
    for (const ContactState& state : found.states) slips += state.status == PairStatus::Slip, opens += !state.closed();
  }
  out << solved << " solved, worst " << worst << ", " << slips << " slip, " << opens << " open, contraction " << contraction << "\n";
  TEST_EQUALITY(solved, 200);
  TEST_COMPARE(worst, <, 1e-7);
  TEST_COMPARE(std::min(slips, opens), >, 100);
  TEST_COMPARE(contraction, >, 0.0);
  TEST_COMPARE(contraction, <, 1.0);
}

TEUCHOS_UNIT_TEST(TrescaFixedPoint, GoesOnFromItsOwnSolution) {
  std::mt19937 random(32);
  for (int trial = 0; trial < 20; ++trial) {
    GivenBounds body(2 + trial % 2, 5);
    body.random(random, false);
    body.begin({dry(0.0, 0.3)}, std::vector<int>(5, 0));
    const StateSearch::Result first = TrescaFixedPoint(*body.rigid, body.laws, body.sites, body, 400).run();
    TEST_ASSERT(first.converged);
    const Vector before = body.u;
    const StateSearch::Result again = TrescaFixedPoint(*body.rigid, body.laws, body.sites, body, 400).run(first.states);
    TEST_ASSERT(again.converged);
    TEST_COMPARE(again.solves, <=, 3);
    TEST_COMPARE((body.u - before).norm(), <=, 1e-7 * before.norm());
  }
}

// However few solves are allowed: what is called a solution is one.
TEUCHOS_UNIT_TEST(TrescaFixedPoint, ClaimsNothingWhenItRunsOutOfSolves) {
  std::mt19937 random(34);
  int ended = 0, solved = 0;
  for (int trial = 0; trial < 10; ++trial) {
    GivenBounds body(2 + trial % 2, 6);
    body.random(random, false);
    body.begin({dry(0.0, 0.3)}, std::vector<int>(6, 0));
    for (int most = 1; most < 30; ++most) {
      const StateSearch::Result found = TrescaFixedPoint(*body.rigid, body.laws, body.sites, body, most).run();
      (found.converged ? solved : ended) += 1;
      if (found.converged) TEST_COMPARE(body.violation(), <, 1e-7);
    }
  }
  out << solved << " solved, " << ended << " ended before\n";
  TEST_COMPARE(std::min(solved, ended), >, 20);
}

// Both carry .6 per node under a normal force of 2.
TEUCHOS_UNIT_TEST(TrescaFixedPoint, SaysThatABodySlidesAway) {
  std::mt19937 random(33);
  for (const SearchLaw& law : {dry(0.0, 0.3), dry(0.6, 0.0)})
    for (const double push : {0.55, 0.65}) {
      GivenBounds body(2, 4);
      body.random(random, true);
      body.gap.setZero();
      body.load.setZero();
      for (int i = 0; i < body.nodes; ++i) body.load(2 * i) = 2.0, body.load(2 * i + 1) = push;
      body.begin({law}, std::vector<int>(4, 0));
      const StateSearch::Result found = TrescaFixedPoint(*body.rigid, body.laws, body.sites, body, 200).run();
      TEST_EQUALITY(found.converged, push < 0.6);
      TEST_EQUALITY(found.slides.size() > 0, push > 0.6);
    }
}

}  // namespace
}  // namespace suture
