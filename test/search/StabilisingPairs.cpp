#include <support/CondensedBody.hpp>

#include <suture/search/StabilisingPairs.hpp>

#include <Teuchos_UnitTestHarness.hpp>

namespace suture {
namespace {

using scenes::dry;

PairStates randomStates(int pairs, std::mt19937& random) {
  PairStates states(static_cast<std::size_t>(pairs));
  for (ContactState& state : states) {
    const unsigned kind = random() % 4;
    if (kind == 0) state = PairStatus::Stick;
    if (kind == 1) state = PairStatus::Slip;
  }
  return states;
}

TEUCHOS_UNIT_TEST(StabilisingPairs, MakeEveryLinearProblemRegular) {
  std::mt19937 random(21);
  int loose = 0;
  for (int trial = 0; trial < 200; ++trial) {
    CondensedBody body(2 + trial % 2, 3 + trial % 4);
    body.random(random, true);
    body.begin({dry(0.0, 0.3)}, std::vector<int>(body.nodes, 0));
    const LawProjection projection(*body.rigid, body.laws, body.sites);
    const PairStates states = randomStates(body.nodes, random);
    loose += !body.solve(states, 0.0).solved;
    const PairStates held = StabilisingPairs(*body.rigid, projection).addedTo(states, 1.0, {});
    TEST_ASSERT(body.solve(held, 0.0).solved);
    // Pairs are only added: what sticks or is closed stays so.
    for (std::size_t i = 0; i < states.size(); ++i) {
      TEST_ASSERT(held[i].closed() || !states[i].closed());
      TEST_ASSERT(held[i].status == PairStatus::Stick || states[i].status != PairStatus::Stick);
    }
  }
  TEST_COMPARE(loose, >, 50);
}

TEUCHOS_UNIT_TEST(StabilisingPairs, HoldNeutralMotionsBySpringsAndDrivenOnesByPairs) {
  for (const bool isDriven : {false, true}) {
    std::mt19937 random(22);
    CondensedBody body(2, 4);
    body.random(random, true);
    body.gap.setConstant(0.1);
    body.load.setZero();
    for (int i = 0; i < body.nodes; ++i) body.load(2 * i + 1) = isDriven ? 1.0 : i % 2 == 0 ? 1.0 : -1.0;
    body.begin({dry(0.0, 0.3), std::make_shared<Frictionless>()}, {0, 0, 0, 1});
    const LawProjection projection(*body.rigid, body.laws, body.sites);
    PairStates states(4);
    states[3] = PairStatus::Slip;  // holds the normal; the motion along the tangent stays free
    const PairStates held = StabilisingPairs(*body.rigid, projection).addedTo(states, 1.0, {});
    int springs = 0, sticks = 0;
    for (const ContactState& state : held) springs += state.transverseStiffness > 0.0, sticks += state.status == PairStatus::Stick;
    TEST_EQUALITY(springs, isDriven ? 0 : 1);
    TEST_EQUALITY(sticks, isDriven ? 1 : 0);
    TEST_ASSERT(body.solve(held, 0.0).solved);
  }
}

TEUCHOS_UNIT_TEST(StabilisingPairs, PreferPairsThatWereNotContradicted) {
  std::mt19937 random(23);
  CondensedBody body(2, 4);
  body.random(random, true);
  body.load.setConstant(1.0);
  body.begin({dry(0.0, 0.3)}, std::vector<int>(4, 0));
  const LawProjection projection(*body.rigid, body.laws, body.sites);
  for (int spared = 0; spared < 4; ++spared) {
    std::vector<int> inVain;
    for (int i = 0; i < 4; ++i)
      if (i != spared) inVain.push_back(i);
    const PairStates held = StabilisingPairs(*body.rigid, projection).addedTo(PairStates(4), 1.0, inVain);
    for (int i = 0; i < 4; ++i) TEST_EQUALITY(held[static_cast<std::size_t>(i)].closed(), i == spared);
  }
}

}  // namespace
}  // namespace suture
