#include "CondensedBody.hpp"

#include <Teuchos_UnitTestHarness.hpp>
#include <suture/contact/PairResponse.hpp>

namespace suture {
namespace {

using scenes::dry;

// For nodes condensed to themselves the response is their stiffness, for any gaps and loads.
TEUCHOS_UNIT_TEST(PairResponse, IsTheStiffnessOfTheNodes) {
  std::mt19937 random(18);
  for (int trial = 0; trial < 24; ++trial) {
    CondensedBody body(2 + trial % 2, 3 + trial % 5);
    body.random(random, trial % 4 > 1);
    const int rough = trial % 3;  // a law without friction, on some nodes: it has a normal row only
    if (trial % 5 == 0) body.load.tail(body.dimension).setZero(), body.gap.setZero();  // a node without load and gap
    std::vector<int> lines(body.nodes, 0);
    if (rough == 0) lines[1] = 1;
    body.begin({dry(0.0, 0.3), std::make_shared<Frictionless>()}, lines);
    PairStates stuck = body.all(PairStatus::Stick);
    PairResponse response;
    TEST_ASSERT(response.measure(*body.rigid, body, stuck, 100));
    TEST_EQUALITY(response.solves(), static_cast<int>(response.rows().size()) + 1);
    // Rows that are always free are eliminated.
    std::vector<int> kept, freed;
    for (int i = 0; i < body.nodes; ++i)
      for (int k = 0; k < body.dimension; ++k) (k > 0 && lines[i] == 1 ? freed : kept).push_back(body.dimension * i + k);
    const Matrix expected = freed.empty() ? body.stiffness : dense::denseSchur(body.stiffness, kept);
    TEST_EQUALITY(response.stiffness().rows(), expected.rows());
    TEST_COMPARE(dense::difference(response.stiffness(), expected), <, 1e-9);
    TEST_COMPARE(dense::difference(response.spread(response.stuck(), body.nodes), body.solve(stuck, 0.0).force), <, 1e-14);
    TEST_ASSERT(!PairResponse().measure(*body.rigid, body, stuck, 2));
  }
}

// A direction in which both sides are held has no compliance, whether it is one of the tangents or lies between two.
TEUCHOS_UNIT_TEST(PairResponse, KnowsDirectionsThatAreHeld) {
  std::mt19937 random(21);
  for (const double angle : {0.0, 0.7}) {
    CondensedBody body(3, 4);
    body.random(random, false);
    Vector held = Vector::Zero(12);
    held.segment(4, 2) << std::cos(angle), std::sin(angle);
    body.stiffness += 1e7 * held * held.transpose();
    body.begin({dry(0.0, 0.3)}, std::vector<int>(4, 0));
    PairResponse response;
    TEST_ASSERT(response.measure(*body.rigid, body, body.all(PairStatus::Stick), 100));
    TEST_COMPARE(dense::difference(dense::inverse(response.stiffness()), dense::inverse(body.stiffness)), <, 1e-5);
  }
}

// A body on one pair rotates about it when it opens: there is no response, and no wrong one.
TEUCHOS_UNIT_TEST(PairResponse, IsNotMeasuredWhereAPairHoldsABodyAlone) {
  std::mt19937 random(19);
  CondensedBody body(2, 1);
  body.random(random, true);
  body.load << 1.0, 0.1;
  body.begin({dry(0.0, 0.3)}, {0});
  TEST_ASSERT(!PairResponse().measure(*body.rigid, body, body.all(PairStatus::Stick), 100));
}

}  // namespace
}  // namespace suture
