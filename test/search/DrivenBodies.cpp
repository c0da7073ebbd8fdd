#include <support/CondensedBody.hpp>

#include <suture/search/DrivenBodies.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>

namespace suture {
namespace {

using scenes::dry;

/// A block pressed by a force of 8 towards a ground at different distances; the pair that is farthest is glued.
struct Pressed {
  CondensedBody body{2, 4};
  PairStates now{4};
  ContactBalance at;
  std::unique_ptr<LawProjection> projection;
  std::unique_ptr<StabilisingPairs> stabilising;
  std::unique_ptr<DrivenBodies> driven;

  explicit Pressed(double load) {
    std::mt19937 random(41);
    body.random(random, true);
    body.gap << 0.1, 0.2, 0.3, 0.4;
    body.load.setZero();
    for (int i = 0; i < 4; ++i) body.load(2 * i) = load;
    body.begin({dry(0.0, 0.3)}, std::vector<int>(4, 0));
    now[3] = PairStatus::Stick;
    const ContactAnswer answer = body.solve(now, 0.0);
    at = {answer.force, answer.jump, 0.0};
    projection = std::make_unique<LawProjection>(*body.rigid, body.laws, body.sites);
    stabilising = std::make_unique<StabilisingPairs>(*body.rigid, *projection);
    driven = std::make_unique<DrivenBodies>(*body.rigid, *projection, *stabilising);
  }
  bool advance(const PairStates& next, PairStates& found) { return driven->advance(now, at, next, 8.0, {}, found); }
};

TEUCHOS_UNIT_TEST(DrivenBodies, MoveAlongTheLoadsUntilPairsHold) {
  Pressed pressed(2.0);
  const PairStates next(4);  // nothing would hold the block
  std::vector<PairStates> all;
  PairStates found;
  while (all.size() < 30 && pressed.advance(next, found)) {
    TEST_EQUALITY(pressed.body.rigid->loose(found).cols(), 0);
    TEST_ASSERT(std::any_of(found.begin(), found.end(), [](const ContactState& state) { return state.closed(); }));
    TEST_ASSERT(std::find(all.begin(), all.end(), found) == all.end());
    all.push_back(found);
  }
  TEST_COMPARE(all.size(), >=, 1);
  TEST_COMPARE(all.size(), <=, 20);
}

TEUCHOS_UNIT_TEST(DrivenBodies, StayWhereNothingDrivesThem) {
  Pressed pressed(0.0);
  pressed.at.force.setZero();  // without round-off
  PairStates found;
  TEST_ASSERT(!pressed.advance(PairStates(4), found));                     // no force
  TEST_ASSERT(!pressed.advance(PairStates(4, PairStatus::Stick), found));  // no motion
}

}  // namespace
}  // namespace suture
