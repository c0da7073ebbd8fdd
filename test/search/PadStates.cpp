#include <support/CondensedBody.hpp>

#include <suture/search/PadStates.hpp>

#include <Teuchos_UnitTestHarness.hpp>

namespace suture {
namespace {

using scenes::dry;

// Statics gives the sum of the normal forces.
TEUCHOS_UNIT_TEST(PadStates, StartFromTheForcesOfStatics) {
  for (const int dimension : {2, 3})
    for (const double mu : {0.0, 0.3}) {
      std::mt19937 random(31);
      CondensedBody body(dimension, 5);
      body.random(random, true);
      body.gap << 0.1, 0.1, 0.1, 0.1, 1e3;
      body.load.setZero();
      for (int i = 0; i < 5; ++i) {
        body.load(dimension * i) = 2.0;
        body.load(dimension * i + 1) = mu > 0.0 ? 0.4 : 0.0;
      }
      body.begin({dry(0.0, mu)}, std::vector<int>(5, 0));
      const LawProjection projection(*body.rigid, body.laws, body.sites);
      TEST_ASSERT(!projection.isFrictionless());  // dry() frictional sliding, even with a coefficient of zero
      const PadStates pads(*body.rigid, body.laws, projection);
      Vector normal;
      const PairStates states = pads.start(normal);
      for (int i = 0; i < 4; ++i) {
        TEST_COMPARE(normal(i), >, 0.0);
        TEST_ASSERT(states[static_cast<std::size_t>(i)].closed());
        if (mu > 0.0) TEST_ASSERT(states[static_cast<std::size_t>(i)].status == PairStatus::Stick);  // 2 < .3 x 10
      }
      TEST_FLOATING_EQUALITY(normal.sum(), 10.0, 1e-8);
      TEST_EQUALITY(normal(4), 0.0);
      TEST_ASSERT(!states[4].closed());
    }
}

// Forces of the pads near any solution balance the loads, which those of the solution's own states need not.
TEUCHOS_UNIT_TEST(PadStates, BalanceTheLoadsNearASolution) {
  std::mt19937 random(32);
  for (const bool frictional : {false, true})
    for (int trial = 0; trial < 50; ++trial) {
      CondensedBody body(2, 4);
      body.random(random, true);
      for (int i = 0; i < 4; ++i) body.load(2 * i) += 3.0, body.load(2 * i + 1) = i % 2 == 0 ? 1.0 : -1.0;
      const SearchLaw law = frictional ? SearchLaw(dry(0.0, 0.3)) : SearchLaw(std::make_shared<Frictionless>());
      body.begin({law}, std::vector<int>(4, 0));
      const LawProjection projection(*body.rigid, body.laws, body.sites);
      TEST_EQUALITY(projection.isFrictionless(), !frictional);
      const PadStates pads(*body.rigid, body.laws, projection);
      ContactBalance at{Matrix::Zero(4, 3), Matrix::Random(4, 3), 0.0};
      at.jump.col(2).setZero();
      PairStates found(4);
      TEST_ASSERT(pads.near(at, 1.0, PairStates(4), found));
      const PadModel::Equilibrium pad = pads.equilibrium(at, 1.0);
      TEST_FLOATING_EQUALITY(pad.force.col(0).sum(), body.rigid->data().work(0), 1e-8);
      for (std::size_t i = 0; i < 4; ++i) TEST_EQUALITY(found[i].closed(), pad.force(static_cast<Eigen::Index>(i), 0) > 0.0);
      PairStates none;
      TEST_ASSERT(!pads.near(ContactBalance(), 1.0, PairStates(4), none));
    }
}

}  // namespace
}  // namespace suture
