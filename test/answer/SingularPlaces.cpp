// Places where the exact stress or pressure is unbounded: corners and ends of contacts known by hand.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/answer/values/SingularPlaces.hpp>
#include <suture/base/Point.hpp>

#include <algorithm>
#include <cmath>

namespace suture {
namespace {

/// Sides of a polygon with counter-clockwise corners, numbered consecutively from `first`.
std::vector<BoundarySide> polygon(int body, GlobalId first, const std::vector<Point>& corners) {
  std::vector<BoundarySide> sides;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    const Point way = minus(corners[next], corners[i]);
    sides.push_back({body, {first + GlobalId(i), first + GlobalId(next)}, {corners[i], corners[next]}, unit(Point{way[1], -way[0], 0})});
  }
  return sides;
}

/// A hole: clockwise.
std::vector<BoundarySide> ring(int corners) {
  std::vector<Point> around;
  for (int i = 0; i < corners; ++i) around.push_back({std::cos(-2 * M_PI * i / corners), std::sin(-2 * M_PI * i / corners), 0});
  return polygon(0, 0, around);
}

/// The sides of the prism of height one over a polygon, without its ends.
std::vector<BoundarySide> raised(const std::vector<BoundarySide>& flat, GlobalId more) {
  std::vector<BoundarySide> sides;
  for (const BoundarySide& side : flat) {
    const auto up = [](const Point& p) { return plus(p, Point{0, 0, 1}); };
    sides.push_back({side.body,
                     {side.nodes[0], side.nodes[1], side.nodes[1] + more, side.nodes[0] + more},
                     {side.vertices[0], side.vertices[1], up(side.vertices[1]), up(side.vertices[0])},
                     side.normal});
  }
  return sides;
}

const std::vector<Point> kSquare{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
const std::vector<Point> kAngle{{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};

TEUCHOS_UNIT_TEST(SingularPlaces, AreReentrantCornersAndEdges) {
  TEST_ASSERT(!haveReentrantEdge(polygon(0, 0, kSquare), 2));
  TEST_ASSERT(haveReentrantEdge(polygon(0, 0, kAngle), 2));
  TEST_ASSERT(!haveReentrantEdge(raised(polygon(0, 0, kSquare), 10), 3));
  TEST_ASSERT(haveReentrantEdge(raised(polygon(0, 0, kAngle), 10), 3));
  TEST_ASSERT(!haveReentrantEdge(ring(8), 2));  // a round hole, coarsely
  TEST_ASSERT(haveReentrantEdge(ring(6), 2));
  // Two adjacent bodies form no corner together.
  std::vector<BoundarySide> both = polygon(0, 0, {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}});
  const std::vector<BoundarySide> on = polygon(1, 10, {{0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}});
  both.insert(both.end(), on.begin(), on.end());
  TEST_ASSERT(!haveReentrantEdge(both, 2));
}

/// A block of this width, its right end at x = 1, on a base that ends at `end`: the pair at (1, 0), carried by either.
bool endsThere(double end, bool inSpace, bool carriedByBase) {
  std::vector<BoundarySide> sides = polygon(0, 0, {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  std::vector<BoundarySide> base = polygon(1, 20, {{0, -1, 0}, {end, -1, 0}, {end, 0, 0}, {0.5, 0, 0}, {0, 0, 0}});
  sides.insert(sides.end(), base.begin(), base.end());
  if (inSpace) sides = raised(sides, 40);
  ContactPair pair;
  const int own = 1, its[] = {22, 23};
  if (carriedByBase) {
    pair.ends = {{its[0], -1.0}, {own, 1.0}, {its[1], 0.0}};
  } else {
    pair.ends = {{own, 1.0}, {its[0], -0.5}, {its[1], -0.5}};
  }
  if (inSpace)
    for (const int node : {own, its[0], its[1]}) pair.ends.push_back({node + 40, 0.0});
  pair.normal = {0, -1, 0};  // from the block, A, to the base
  return endsOnPartner(pair, sides, inSpace ? 3 : 2);
}

TEUCHOS_UNIT_TEST(SingularPlaces, AreEndsOfSidesOnPartnersThatGoOn) {
  for (const bool inSpace : {false, true})
    for (const bool carriedByBase : {false, true}) {
      TEST_ASSERT(endsThere(2.0, inSpace, carriedByBase));
      TEST_ASSERT(endsThere(1.2, inSpace, carriedByBase));
      TEST_ASSERT(!endsThere(1.0, inSpace, carriedByBase));  // both end: two right angles form a straight edge
    }
}

// A coarse disc of 12 sides on a base: its sides turn away from the base by 30 degrees at the corners of the lowest one, by 60 at the next.
TEUCHOS_UNIT_TEST(SingularPlaces, AreNoCornersOfARoundBody) {
  std::vector<Point> around;
  for (int i = 0; i < 12; ++i) around.push_back({std::cos(2 * M_PI * (i - 3.5) / 12), std::sin(2 * M_PI * (i - 3.5) / 12) + 1, 0});
  std::vector<BoundarySide> sides = polygon(0, 0, around);
  const std::vector<BoundarySide> base = polygon(1, 20, {{-3, -1, 0}, {3, -1, 0}, {3, 0, 0}, {-3, 0, 0}});
  sides.insert(sides.end(), base.begin(), base.end());
  ContactPair pair;
  pair.ends = {{0, 0.5}, {1, 0.5}, {11, 0.0}, {2, 0.0}, {22, -0.5}, {23, -0.5}};
  pair.normal = {0, -1, 0};
  TEST_ASSERT(!endsOnPartner(pair, sides, 2));
}

// The lower block ends at x = 0, the upper one continues.
TEUCHOS_UNIT_TEST(SingularPlaces, AreFoundAroundNodesOnAnyNumberOfRanks) {
  scenes::Scene scene = scenes::overhang();
  for (std::size_t i = 0; i < scene.constraints.pairs.size(); ++i) scene.constraints.pairs[i].id = int(i);
  const blocks::Blocks all(scene, blocks::world(), 4);
  std::vector<int> closed;
  int inner = -1, outer = -1, middle = -1;
  for (const ContactPair& pair : scene.constraints.pairs) {
    closed.push_back(pair.id);
    const double x = scene.mesh.point(pair.node())[0];
    if (std::abs(x) < 1e-12) inner = pair.id;
    if (std::abs(x + 1) < 1e-12) outer = pair.id;
    if (std::abs(x + 0.5) < 1e-12) middle = pair.id;
  }
  TEST_ASSERT(inner >= 0 && outer >= 0 && middle >= 0);
  const auto node = [&](int pair) { return PlaceInQuestion{{scene.constraints.pairs[std::size_t(pair)].node()}, -1}; };
  const std::vector<std::string> found =
      singularities(*blocks::world(), all.meshes, {{{}, inner}, {{}, outer}, {{}, middle}, node(inner), node(middle)}, closed);
  const std::string end = "the end of a contact side on a partner that continues";
  for (const std::string& one : found) out << "found '" << one << "'\n";
  TEST_ASSERT(found == std::vector<std::string>({end, "", "", end, ""}));
  // An open pair is not considered.
  TEST_ASSERT(singularities(*blocks::world(), all.meshes, {{{}, inner}}, {}) == std::vector<std::string>({""}));
}

}  // namespace
}  // namespace suture
