// Overlaps of two lines of sides that are known by hand.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/pairs/mortar/Segmentation.hpp>

#include "PairsTesting.hpp"

namespace {

using namespace pairstesting;

/// Below [0, 4] x [0, 1] and above [x0, x1] x [1 + gap, 2].
Mesh twoBoxes(double x0, double x1, int lower, int upper, double gap = 0, Cell cell = Cell::Quadrilateral4) {
  Box a, b;
  a.name = "lower", a.x1 = 4, a.nx = lower, a.ny = 1, a.cell = cell;
  b.name = "upper", b.x0 = x0, b.x1 = x1, b.y0 = 1 + gap, b.y1 = 2, b.nx = upper, b.ny = 1, b.cell = cell;
  Mesh mesh = boxes({a, b});
  assignBodies(mesh, {"lower", "upper"});
  return mesh;
}

std::vector<MortarSegment> segmentsOf(const Mesh& mesh, const std::string& group) {
  const Surface surface(mesh, mesh.sideGroups.at(group));
  std::vector<MortarSegment> all;
  for (int side = 0; side < surface.sides(); ++side)
    all.emplace_back(surface, side, BoundaryCurve::Bend{}, mesh.bodyOfNode[surface.nodesOf(side)[0]]);
  return all;
}

/// Sides of a group from left to right.
std::vector<MortarSegment> fromLeft(const Mesh& mesh, const std::string& group) {
  std::vector<MortarSegment> all = segmentsOf(mesh, group);
  std::sort(all.begin(), all.end(), [](const MortarSegment& a, const MortarSegment& b) { return a.at(0)[0] < b.at(0)[0]; });
  return all;
}

TEUCHOS_UNIT_TEST(Segmentation, DividesSidesWhereThoseOppositeBegin) {
  // Lower sides of length 1, upper ones of length 1.5 from 0.25 to 3.25.
  const Mesh mesh = twoBoxes(0.25, 3.25, 4, 2);
  const std::vector<MortarSegment> lower = fromLeft(mesh, "lower_top"), upper = fromLeft(mesh, "upper_bottom");
  const Segmentation segmentation(upper);
  // x of the begin and end of each overlap, and the upper side; the lower line runs to the left.
  const std::vector<std::vector<std::array<double, 3>>> expected{{{1, 0.25, 0}}, {{2, 1.75, 1}, {1.75, 1, 0}}, {{3, 2, 1}}, {{3.25, 3, 1}}};
  for (int s = 0; s < 4; ++s) {
    const auto found = segmentation.overlaps(lower[s], {0, 1, 0});
    TEST_EQUALITY_CONST(found.size(), expected[s].size());
    for (std::size_t k = 0; k < std::min(found.size(), expected[s].size()); ++k) {
      TEST_FLOATING_EQUALITY(lower[s].at(found[k].begin)[0], expected[s][k][0], 1e-14);
      TEST_FLOATING_EQUALITY(lower[s].at(found[k].end)[0], expected[s][k][1], 1e-14);
      TEST_EQUALITY(found[k].other - upper.data(), std::ptrdiff_t(expected[s][k][2]));
    }
  }
}

TEUCHOS_UNIT_TEST(Segmentation, FollowsTheDirection) {
  // Along (1, 1) over a gap of 0.5 the upper sides are seen 0.5 to the left.
  const Mesh mesh = twoBoxes(0, 4, 4, 4, 0.5);
  const std::vector<MortarSegment> lower = fromLeft(mesh, "lower_top"), upper = fromLeft(mesh, "upper_bottom");
  const Segmentation segmentation(upper);
  const double s = std::sqrt(0.5);
  const auto found = segmentation.overlaps(lower[1], {s, s, 0});
  TEST_EQUALITY_CONST(found.size(), 2u);
  TEST_FLOATING_EQUALITY(lower[1].at(found[0].end)[0], 1.5, 1e-14);
  TEST_EQUALITY(found[0].other, &upper[2]);
  TEST_EQUALITY(found[1].other, &upper[1]);
  TEST_EQUALITY(segmentation.overlaps(lower[3], {s, s, 0}).size(), 1u);  // the right half of the last one sees nothing
}

TEUCHOS_UNIT_TEST(Segmentation, MeetsTheNearestSideFaceToFaceOnly) {
  const Mesh mesh = twoBoxes(0, 4, 4, 2, 0.25, Cell::Quadrilateral8);
  std::vector<MortarSegment> upper = fromLeft(mesh, "upper_bottom");
  for (const MortarSegment& side : fromLeft(mesh, "upper_top")) upper.push_back(side);
  const Segmentation segmentation(upper);
  const auto met = segmentation.nearest({0.5, 1, 0}, {0, 1, 0}, 0);
  TEST_ASSERT(met && met->other == &upper[0]);
  TEST_FLOATING_EQUALITY(met->gap, 0.25, 1e-14);
  TEST_FLOATING_EQUALITY(met->other->at(met->eta)[0], 0.5, 1e-14);
  TEST_ASSERT(!segmentation.nearest({5, 1, 0}, {0, 1, 0}, 0));
  // Beyond the right end of the last side: the end itself, up to a distance.
  const auto beyond = segmentation.nearest({4.05, 1, 0}, {0, 1, 0}, 0, 0.1);
  TEST_ASSERT(beyond && beyond->other == &upper[1]);
  TEST_FLOATING_EQUALITY(beyond->other->at(beyond->eta)[0], 4.0, 1e-14);
  TEST_FLOATING_EQUALITY(beyond->gap, 0.25, 1e-14);
  TEST_ASSERT(!segmentation.nearest({4.05, 1, 0}, {0, 1, 0}, 0, 0.04));
  // The upper side faces the other way: it meets a point inside its body, but none below it, behind the body's own lower side.
  const auto behind = segmentation.nearest({0.5, 1.5, 0}, {0, -1, 0}, 0);
  TEST_ASSERT(behind && behind->other == &upper[2]);
  TEST_FLOATING_EQUALITY(behind->gap, -0.5, 1e-14);
  TEST_ASSERT(!segmentation.nearest({0.5, 1, 0}, {0, -1, 0}, 0));
  TEST_ASSERT(!segmentation.nearest({0.5, 1, 0}, {0, 1, 0}, 1));  // a body does not meet itself
}

}  // namespace
