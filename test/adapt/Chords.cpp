// Straight sides in place of curves: against areas, lengths and volumes of circles and paraboloids.
#include "AdaptTesting.hpp"

#include <Teuchos_UnitTestHarness.hpp>
#include <suture/adapt/Chords.hpp>

namespace suture {
namespace {

using namespace adapttesting;

constexpr int kCells = 8;

/// Quarter of a ring, 1 <= r <= 2, of second-order triangles whose curved sides lie on circles.
Mesh ring() {
  Mesh mesh = boxes({box("ring", Cell::Triangle6, kCells)});
  move(mesh, [](const Point& p) {
    const double r = 1 + p[1], angle = pi / 2 * (1 - p[0]);
    return Point{r * std::cos(angle), r * std::sin(angle), 0};
  });
  assignBodies(mesh, {"ring"});
  return mesh;
}

double sum(const std::vector<ChordSide>& sides, double ChordSide::*of) {
  double all = 0;
  for (const ChordSide& side : sides) all += side.*of;
  return all;
}

TEUCHOS_UNIT_TEST(Chords, AreasAndLengthsBetweenCirclesAndTheirPolygons) {
  Mesh mesh = ring();
  const std::vector<Chord> chords = straighten(mesh, {});
  const std::vector<ChordSide> sides = chordSides(mesh, chords);
  TEST_EQUALITY(sides.size(), std::size_t(2 * kCells));  // circles inside the body do not count
  const double angle = pi / 2 / kCells;
  double area = 0, length = 0;
  for (const double r : {1.0, 2.0}) {
    area += kCells * r * r / 2 * (angle - std::sin(angle));
    length += kCells * r * (angle - 2 * std::sin(angle / 2));
  }
  TEST_FLOATING_EQUALITY(sum(sides, &ChordSide::volume), area, 0.01);
  TEST_FLOATING_EQUALITY(sum(sides, &ChordSide::excess), length, 0.01);
  TEST_ASSERT(straighten(mesh, {}).empty());
}

TEUCHOS_UNIT_TEST(Chords, GroupsStayCurved) {
  Mesh mesh = ring();
  const Mesh curved = mesh;
  const std::vector<ChordSide> sides = chordSides(mesh, straighten(mesh, {"ring_bottom"}));
  TEST_EQUALITY(sides.size(), std::size_t(kCells));
  for (const Side& side : mesh.sideGroups.at("ring_bottom"))
    for (const int node : mesh.nodesOf(side)) TEST_ASSERT(mesh.point(node) == curved.point(node));
  for (const ChordSide& side : sides)
    for (const int node : side.vertices) TEST_FLOATING_EQUALITY(norm(mesh.point(node)), 2.0, 1e-12);
}

TEUCHOS_UNIT_TEST(Chords, SidesBetweenMaterialsCountOnBothSides) {
  Mesh mesh = ring();
  for (int e = 0; e < mesh.elements(); ++e) mesh.regions.push_back(norm(centreOf(mesh, e)) < 1.5 ? 0 : 1);
  const std::vector<Chord> chords = straighten(mesh, {});
  TEST_EQUALITY(chordSides(mesh, chords).size(), std::size_t(4 * kCells));
}

TEUCHOS_UNIT_TEST(Chords, VolumesUnderAParaboloid) {
  Mesh mesh = boxes({box("cap", Cell::Tetrahedron10, 4)});
  move(mesh, [](const Point& p) { return Point{p[0], p[1], p[2] * (1 + 0.05 * (p[0] * (1 - p[0]) + p[1] * (1 - p[1])))}; });
  assignBodies(mesh, {"cap"});
  std::vector<ChordSide> top;
  for (ChordSide& side : chordSides(mesh, straighten(mesh, {}))) {
    const bool onTop = std::all_of(side.vertices.begin(), side.vertices.end(), [&](int node) { return mesh.point(node)[2] > 0.999; });
    if (onTop) top.push_back(std::move(side));
  }
  double polyhedron = 0;
  for (int e = 0; e < mesh.elements(); ++e) polyhedron += signedSize(mesh, e);
  TEST_EQUALITY(top.size(), std::size_t(32));
  TEST_FLOATING_EQUALITY(sum(top, &ChordSide::volume), 1 + 0.05 * 2 / 6 - polyhedron, 0.05);
}

// Sides of half the length have an eighth of the area, and there are twice as many.
TEUCHOS_UNIT_TEST(Chords, SizesForAWantedEffect) {
  Mesh mesh = ring();
  const std::vector<ChordSide> sides = chordSides(mesh, straighten(mesh, {}));
  std::vector<double> effects;
  double all = 0;
  for (const ChordSide& side : sides) effects.push_back(side.volume), all += side.volume;
  const std::vector<double> sizes = sizesAlongCurves(mesh, sides, effects, all / 4);
  const auto scaledSize = [&](std::size_t s) {
    const int node = sides[s].vertices[0];
    return sizes[static_cast<std::size_t>(node)] / std::cbrt(norm(mesh.point(node)));
  };
  double predicted = 0;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    const double ratio = sizes[static_cast<std::size_t>(sides[s].vertices[0])] / sides[s].length;
    predicted += effects[s] * ratio * ratio;
    // Areas are proportional to r^2, ratios to r^(-2/3), sizes to r^(1/3).
    TEST_FLOATING_EQUALITY(scaledSize(s), scaledSize(0), 1e-6);
  }
  TEST_FLOATING_EQUALITY(predicted, all / 4, 1e-10);
}

}  // namespace
}  // namespace suture
