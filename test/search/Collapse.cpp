#include <support/CondensedBody.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <suture/search/Collapse.hpp>
#include <suture/search/StateSearch.hpp>

namespace suture {
namespace {

using scenes::dry;

/// A body pressed against the ground by interference alone that may slide along the first tangent.
CondensedBody pressedBody(std::mt19937& random, int dimension, int nodes) {
  CondensedBody body(dimension, nodes);
  body.random(random, false);
  const int size = dimension * nodes;
  body.kernel = Matrix::Zero(size, 1);
  for (int i = 0; i < nodes; ++i) body.kernel(dimension * i + 1, 0) = 1.0;
  const Matrix away = Matrix::Identity(size, size) - body.kernel * body.kernel.transpose() / nodes;
  body.stiffness = (away * body.stiffness * away).eval();
  body.gap.setConstant(-1.0);
  body.load.setZero();
  for (int i = 0; i < nodes; ++i) body.load(dimension * i) = 4.0;
  return body;
}

/// Load along the kernel, in addition to what friction holds, if all pairs slip under a multiple of it: by equations in which a force along
/// the kernel, spread over the nodes, makes up the difference.
double beyondFriction(const CondensedBody& body, double friction) {
  const int d = body.dimension, n = d * body.nodes;
  Matrix a = Matrix::Zero(2 * n + 1, 2 * n + 1);
  Vector b = Vector::Zero(2 * n + 1);
  a.topLeftCorner(n, n) = body.stiffness;
  a.block(0, n, n, n).setIdentity();
  a.block(0, 2 * n, n, 1) = body.kernel;
  a.block(2 * n, 0, 1, n) = body.kernel.transpose();
  b.head(n) = body.load;
  for (int i = 0; i < body.nodes; ++i) {
    a(n + d * i, d * i) = 1.0;
    b(n + d * i) = body.gap(i);
    for (int k = 1; k < d; ++k) a(n + d * i + k, n + d * i + k) = 1.0;
    a(n + d * i + 1, n + d * i) = -friction;
  }
  return dense::solve(a, b)(2 * n) * body.nodes;
}

/// The friction at which the loads are just held, by bisection.
double leastFriction(const CondensedBody& body) {
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (beyondFriction(body, middle) > 0.0 ? low : high) = middle;
  }
  return high;
}

TEUCHOS_UNIT_TEST(Collapse, FindsTheMultipleOfFrictionThatHoldsAPressFit) {
  std::mt19937 random(21);
  int found = 0, held = 0;
  for (const int dimension : {2, 3})
    for (int trial = 0; trial < 20; ++trial) {
      CondensedBody body = pressedBody(random, dimension, 5 + trial % 4);
      for (int i = 0; i < body.nodes; ++i) body.load(dimension * i + 1) = 0.8;
      const double needed = leastFriction(body), mu = needed / (trial % 2 == 0 ? 1.15 : 0.85);
      body.begin({dry(0.0, mu)}, std::vector<int>(body.nodes, 0));
      const PairStates states = body.all(PairStatus::Stick);
      const ContactAnswer answer = body.solve(states, 0.0);
      TEST_ASSERT(answer.solved);
      const Collapse::Result result =
          Collapse(*body.rigid, body.laws, body.sites, body).find(states, answer.force.col(0).cwiseMax(0.0), 12);
      if (trial % 2 == 1) {
        TEST_EQUALITY(result.motion.size(), 0);
        ++held;
        continue;
      }
      if (result.motion.size() == 0) continue;  // pairs that open change the mechanism
      ++found;
      TEST_EQUALITY(result.motion.size(), 1);
      TEST_COMPARE(result.motion(0), >, 0.0);
      TEST_FLOATING_EQUALITY(result.multiple, 1.15, 5e-3);  // it ends when a step changes it by 1e-3; steps fall by .8 at least
    }
  TEST_EQUALITY(held, 20);
  TEST_COMPARE(found, >=, 18);
}

TEUCHOS_UNIT_TEST(Collapse, IsNamedByTheSearch) {
  std::mt19937 random(22);
  for (int trial = 0; trial < 10; ++trial) {
    CondensedBody body = pressedBody(random, 2, 6);
    for (int i = 0; i < body.nodes; ++i) body.load(2 * i + 1) = 0.8;
    const double mu = leastFriction(body) / (trial % 2 == 0 ? 1.1 : 0.9);
    body.begin({dry(0.0, mu)}, std::vector<int>(body.nodes, 0));
    StateSearch search(*body.rigid, body.laws, body.sites, body, 200);
    const StateSearch::Result found = search.run(body.all(PairStatus::Stick));
    TEST_EQUALITY(found.converged, trial % 2 == 1);
    TEST_EQUALITY(found.slides.size() > 0, trial % 2 == 0);
    TEST_COMPARE(found.solves, <, 100);
  }
}

// These normal forces follow from statics: an obstacle on the way may hold the body, and if the motion closes pairs nothing is reported.
TEUCHOS_UNIT_TEST(Collapse, ReportsNothingWhereBodiesMeetOthers) {
  std::mt19937 random(23);
  CondensedBody body = pressedBody(random, 2, 6);
  for (int i = 0; i < body.nodes; ++i) body.load(2 * i + 1) = 0.8;
  body.kernel(0, 0) = 0.5;  // the first pair closes as the body slides
  body.gap(0) = 5.0;
  body.begin({dry(0.0, leastFriction(body) / 1.5)}, std::vector<int>(body.nodes, 0));
  PairStates states = body.all(PairStatus::Stick);
  states[0] = PairStatus::Open;
  const ContactAnswer answer = body.solve(states, 0.0);
  const Collapse::Result result = Collapse(*body.rigid, body.laws, body.sites, body).find(states, answer.force.col(0).cwiseMax(0.0), 12);
  TEST_EQUALITY(result.motion.size(), 0);
}

}  // namespace
}  // namespace suture
