// Slides, rolling and moments across gaps, of pairs made by hand.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/answer/verdict/VerifyPlaces.hpp>
#include <suture/base/Point.hpp>

#include <cmath>

namespace suture {
namespace {

/// A row of pairs, side by side, with a unit force each. Body 0 is above, body 1 below, or there is an obstacle.
struct Row {
  std::vector<PairEndShare> ends;
  std::vector<PairResult> pairs;
  std::vector<ContactPiece> pieces{{"joint", {}, {0, 1}, {}, 0.0, {}}};
  std::vector<BodyScale> bodies{2};
  std::vector<Deformation> motions{2};

  Row() {
    for (BodyScale& body : bodies) body.force = 10.0;
    for (Deformation& motion : motions) motion.extent = 2.0;
  }

  void add(const Point& place, const Point& normal, const Point& jump, double gap = 0.0, double force = 1.0, bool onObstacle = false) {
    const int id = static_cast<int>(pairs.size());
    PairResult pair;
    pair.id = id;
    pair.line = pair.piece = 0;
    pair.state = force > 0.0 ? PairStatus::Slip : PairStatus::Open;
    pair.force = force;
    pair.initialGap = gap;
    pair.normal = normal;
    pairs.push_back(pair);
    for (const int side : {0, 1}) {
      if (side == 1 && onObstacle) break;
      PairEndShare end{};
      end.pair = id;
      end.end = end.body = side;
      end.weight = side == 0 ? 1.0 : -1.0;
      end.stiffness = 1.0;
      end.gap = gap;
      end.place = place;
      end.normal = normal;
      end.cell = side == 0 ? 0.5 : 0.25;
      if (side == 0) end.jump = jump;
      end.arm = scaled(end.weight, side == 0 ? place : plus(place, scaled(gap, normal)));
      ends.push_back(end);
    }
    if (id > 0) pieces[0].cells.push_back({id - 1, id});
  }

  Findings judged() const {
    Findings findings;
    verifyPlaces({ends, pairs, pieces, bodies, motions, 1e-6}, findings);
    return findings;
  }
  double slide() const { return judged().all[std::size_t(Quantity::Slide)].value; }
};

const Point kDown{0, -1, 0};

TEUCHOS_UNIT_TEST(ContactPlaces, SlidesAreInCellsOfTheFinerSide) {
  Row row;
  row.add({0, 0, 0}, kDown, {0.1, 0.3, 0});
  row.add({1, 0, 0}, kDown, {-0.2, 0, 0});
  const Finding found = row.judged().all[std::size_t(Quantity::Slide)];
  TEST_FLOATING_EQUALITY(found.value, 0.8, 1e-12);
  TEST_EQUALITY(found.pair, 1);
  TEST_EQUALITY(std::min(found.body, found.other), 0);
  TEST_EQUALITY(std::max(found.body, found.other), 1);
  row.pairs[1].force = 1e-7;  // negligible
  TEST_FLOATING_EQUALITY(row.slide(), 0.4, 1e-12);
}

/// A long row of a large body: slides of pairs in the middle move forces by a small fraction of it.
TEUCHOS_UNIT_TEST(ContactPlaces, AreScaledByTheBodyFarFromTheEnds) {
  for (const bool isBent : {false, true}) {
    Row row;
    for (Deformation& motion : row.motions) motion.extent = 20.0;
    for (int i = 0; i < 41; ++i)
      row.add({0.25 * i, 0, 0}, isBent ? unit(Point{0.08 * i, -1, 0}) : kDown, {0, 0, 0}, 0.0, i > 10 && i < 30 ? 1.0 : 0.0);
    for (PairEndShare& end : row.ends)
      if (end.body == 0) end.jump = {0.5, 0, 0};
    for (PairResult& pair : row.pairs) pair.kind.separates = false;  // open ones do not count here
    const double value = row.slide();
    if (isBent) TEST_COMPARE(value, >, 1.0);
    if (!isBent) TEST_FLOATING_EQUALITY(value, 0.5 / (0.05 * 20.0), 1e-12);
    if (isBent) continue;
    row.pairs[1].state = PairStatus::Slip;  // near the end
    row.pairs[1].force = 1.0;
    TEST_FLOATING_EQUALITY(row.slide(), 0.5 / 0.25, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(ContactPlaces, OpenPairsOnlyWhereTheSidesCurveIntoTheWay) {
  for (const bool isRound : {false, true}) {
    Row row;
    for (const double angle : {-0.1, 0.0, 0.1})
      row.add({std::sin(angle), 1 - std::cos(angle), 0}, isRound ? Point{std::sin(angle), -std::cos(angle), 0} : kDown, {0.3, 0, 0}, 0.04,
              0.0);
    // A circle of radius one rises by .3^2 / 2 = .045 on the way.
    TEST_FLOATING_EQUALITY(row.slide(), isRound ? 1.2 : 0.0, 0.01);
    for (PairEndShare& end : row.ends) end.gap = 0.05;
    TEST_EQUALITY(row.slide(), 0.0);
  }
}

TEUCHOS_UNIT_TEST(ContactPlaces, ADiscThatRolls) {
  for (const bool isRound : {false, true}) {
    Row row;
    row.motions[0].centre = {0, 1, 0};
    row.motions[0].rotation = {0, 0, 0.2};
    row.motions[1].centre = {0, -5, 0};
    for (const double angle : {-0.1, 0.0, 0.1})
      row.add({std::sin(angle), 1 - std::cos(angle), 0}, isRound ? Point{std::sin(angle), -std::cos(angle), 0} : kDown, {0, 0, 0});
    TEST_FLOATING_EQUALITY(row.slide(), isRound ? 0.2 / 0.25 : 0.0, 1e-12);
    row.motions[0].largest = 0.05;  // extent of two: explains twice .025
    TEST_FLOATING_EQUALITY(row.slide(), isRound ? 0.15 / 0.25 : 0.0, 1e-12);
    row.motions[0].largest = 0.0;
    row.motions[1].rotation = {0, 0, 0.2};  // with it
    TEST_EQUALITY(row.slide(), 0.0);
    row.motions[0].rotation = {0, 0.2, 0};
    row.motions[1].rotation = {0, 0, 0};  // about the normal of the pair in the middle: sin(.1) of it for the others
    TEST_FLOATING_EQUALITY(row.slide(), isRound ? 0.2 * std::sin(0.1) / 0.25 : 0.0, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(ContactPlaces, ObstaclesAreEndlessWhereTheyGoOn) {
  Row plane;
  for (const double x : {0.0, 0.5, 1.0}) plane.add({x, x * x, 0}, kDown, {7, 0, 5}, x * x, 1.0, true);
  TEST_EQUALITY(plane.slide(), 0.0);
  plane.pairs[1].initialGap = 0.2;  // a profile
  TEST_FLOATING_EQUALITY(plane.slide(), std::hypot(7.0, 5.0) / 0.5, 1e-12);
  Row cylinder;
  for (const double angle : {-0.3, 0.0, 0.3})
    cylinder.add({std::sin(angle), std::cos(angle), angle}, {-std::sin(angle), -std::cos(angle), 0}, {0, 0, 9}, 0.0, 1.0, true);
  TEST_EQUALITY(cylinder.slide(), 0.0);
  for (PairEndShare& end : cylinder.ends) end.jump = {0.2, 0, 9};
  TEST_FLOATING_EQUALITY(cylinder.slide(), 0.2 / 0.5, 1e-12);
}

TEUCHOS_UNIT_TEST(ContactPlaces, MomentsAcrossAGapThatStays) {
  Row row;
  for (const double x : {0.0, 1.0}) row.add({x, 0, 0}, kDown, {0, 0, 0}, 0.3);
  for (PairEndShare& end : row.ends) end.kind.restrictsSliding = true;
  row.pairs[0].tangential = {0.5, 0, 0};
  row.pairs[1].tangential = {1.5, 0, 0};
  const auto offset = [&] { return row.judged().all[std::size_t(Quantity::Offset)]; };
  TEST_FLOATING_EQUALITY(offset().value, 2.0 * 0.3 / (10.0 * 2.0), 1e-12);
  TEST_EQUALITY(offset().pair, 1);
  row.pairs[1].tangential = {-0.5, 0, 0};
  TEST_EQUALITY(offset().value, 0.0);
  row.pairs[1].tangential = {1.5, 0, 0};
  for (PairEndShare& end : row.ends) end.jump = scaled(end.body == 0 ? 0.3 : 0.0, kDown);  // closed
  TEST_COMPARE(offset().value, <, 1e-15);
}

}  // namespace
}  // namespace suture
