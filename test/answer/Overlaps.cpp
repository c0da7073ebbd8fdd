// Boxes and rings that overlap by a known depth, on any number of ranks.
#include <Teuchos_UnitTestHarness.hpp>
#include <answer/SolidScenes.hpp>
#include <suture/answer/Overlaps.hpp>
#include <suture/base/Point.hpp>

#include <cmath>

namespace suture {
namespace overlaps {

using solids::distributed;
using solids::world;

/// Corners of a box; the third coordinates only in 3D.
Box block(const std::string& name, Cell cell, const Point& low, const Point& high, const std::array<int, 3>& cells) {
  Box box;
  box.name = name;
  box.cell = cell;
  box.x0 = low[0], box.x1 = high[0], box.y0 = low[1], box.y1 = high[1], box.z0 = low[2], box.z1 = high[2];
  box.nx = cells[0], box.ny = cells[1], box.nz = cells[2];
  return box;
}

std::vector<Overlap> found(const std::vector<Box>& boxes) {
  const scenes::Scene scene = scenes::fromBoxes(boxes);
  const std::vector<SubdomainMesh> meshes = distributed(scene);
  return OverlapSearch(meshes, static_cast<int>(boxes.size())).find(*world());
}

const std::vector<Cell> kPlane{Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral9},
    kSpace{Cell::Tetrahedron4, Cell::Tetrahedron10, Cell::Hexahedron8, Cell::Hexahedron20, Cell::Wedge6, Cell::Pyramid5};

TEUCHOS_UNIT_TEST(Overlaps, OfABlockPressedIntoAnother) {
  for (const Cell cell : kPlane) {
    // cells of 1/4; 'up' goes .19 deep into 'low'
    const auto all =
        found({block("low", cell, {0, 0, 0}, {2, 1, 0}, {8, 4, 1}), block("up", cell, {0.5, 0.81, 0}, {1.5, 1.5, 0}, {4, 3, 1})});
    TEST_EQUALITY(all.size(), 1);
    if (all.empty()) continue;
    TEST_FLOATING_EQUALITY(all[0].depth, 0.19, 1e-12);
    TEST_EQUALITY(all[0].contact, -1);
    TEST_EQUALITY(all[0].body, 1);
    TEST_EQUALITY(all[0].group, "up_bottom");
    TEST_EQUALITY(all[0].nearest, "low_top");
    TEST_FLOATING_EQUALITY(all[0].place[1], 0.81, 1e-12);
    const std::string text = inWords(all[0], {"low", "up"}, {}, false, "m");
    TEST_ASSERT(text.find("warning: body 'up' is inside body 'low', 0.19 m deep at (") == 0);
    TEST_ASSERT(text.find("'up_bottom' behind 'low_top'") != std::string::npos);
  }
  for (const Cell cell : kSpace) {
    const auto all =
        found({block("low", cell, {0, 0, 0}, {2, 2, 1}, {4, 4, 2}), block("up", cell, {0.5, 0.5, 0.9}, {1.5, 1.5, 1.5}, {2, 2, 2})});
    TEST_EQUALITY(all.size(), 1);
    if (!all.empty()) TEST_FLOATING_EQUALITY(all[0].depth, 0.1, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(Overlaps, NoneOfBlocksThatTouch) {
  for (const Cell cell : kPlane)
    TEST_EQUALITY(found({block("a", cell, {0, 0, 0}, {2, 1, 0}, {8, 4, 1}), block("b", cell, {0.4, 1, 0}, {1.5, 1.5, 0}, {5, 3, 1}),
                         block("c", cell, {2, 0, 0}, {3, 2, 0}, {4, 8, 1})})
                      .size(),
                  0);
  for (const Cell cell : kSpace)
    TEST_EQUALITY(found({block("a", cell, {0, 0, 0}, {1, 1, 1}, {2, 2, 2}), block("b", cell, {0.3, 0.1, 1}, {1.5, 1.5, 2}, {2, 3, 2}),
                         block("c", cell, {1, 0, 0}, {2, 1, 1}, {2, 3, 3})})
                      .size(),
                  0);
}

TEUCHOS_UNIT_TEST(Overlaps, OfBarsThatCrossWithoutANodeInside) {
  // A cross: nodes of one bar at +-.1 across and 0, 1, 2 along, of the other likewise.
  const auto plane = found({block("flat", Cell::Quadrilateral4, {0, 0.4, 0}, {1, 0.6, 0}, {1, 1, 1}),
                            block("upright", Cell::Quadrilateral4, {0.4, 0, 0}, {0.6, 1, 0}, {1, 1, 1})});
  TEST_EQUALITY(plane.size(), 1);
  if (!plane.empty()) TEST_FLOATING_EQUALITY(plane[0].depth, 0.1, 1e-12);
  // A needle through a plate.
  const auto space = found({block("plate", Cell::Hexahedron8, {0, 0, 0.45}, {1, 1, 0.55}, {1, 1, 1}),
                            block("needle", Cell::Hexahedron8, {0.4, 0.42, 0}, {0.6, 0.62, 1}, {1, 1, 1})});
  TEST_EQUALITY(space.size(), 1);
  if (!space.empty()) TEST_FLOATING_EQUALITY(space[0].depth, 0.05, 1e-12);
}

TEUCHOS_UNIT_TEST(Overlaps, OfABodyInsideAnother) {
  const auto all = found({block("outer", Cell::Quadrilateral4, {0, 0, 0}, {8, 8, 0}, {16, 16, 1}),
                          block("inner", Cell::Quadrilateral4, {3, 3.5, 0}, {4, 4.5, 0}, {2, 2, 1})});
  TEST_EQUALITY(all.size(), 1);
  if (!all.empty()) TEST_FLOATING_EQUALITY(all[0].depth, 4.0, 1e-12);
}

TEUCHOS_UNIT_TEST(Overlaps, OfDisplacedBodies) {
  const std::vector<Box> both{block("low", Cell::Hexahedron8, {0, 0, 0}, {1, 1, 1}, {4, 4, 4}),
                              block("up", Cell::Hexahedron8, {0, 0, 1.1}, {1, 1, 2}, {3, 3, 3})};
  const scenes::Scene scene = scenes::fromBoxes(both);
  std::vector<SubdomainMesh> meshes = distributed(scene);
  const OverlapSearch search(meshes, 2);
  TEST_EQUALITY(search.find(*world()).size(), 0);
  const auto moved = [&](double down) {
    std::vector<Vector> displacement;
    for (const SubdomainMesh& mesh : meshes) {
      Vector& u = displacement.emplace_back(Vector::Zero(3 * mesh.nodes()));
      for (int node = 0; mesh.body == 1 && node < mesh.nodes(); ++node) u[3 * node + 2] = -down;
    }
    return displacement;
  };
  TEST_EQUALITY(search.find(*world(), moved(0.1)).size(), 0);
  const auto all = search.find(*world(), moved(0.13));
  TEST_EQUALITY(all.size(), 1);
  if (!all.empty()) TEST_FLOATING_EQUALITY(all[0].depth, 0.03, 1e-10);
  std::vector<Vector> broken = moved(0.13);
  for (Vector& u : broken) u.setConstant(std::nan(""));
  TEST_EQUALITY(search.find(*world(), broken).size(), 0);
}

/// A ring of quadrilaterals between two radii, a bent box: x round the circle, y along the radius.
void bend(Mesh& mesh, const std::string& group, double inner, double outer) {
  for (int node = 0; node < mesh.nodes(); ++node) {
    if (mesh.bodies[mesh.bodyOfNode[node]] != group) continue;
    const double angle = -mesh.coordinates[2 * node], radius = inner + (outer - inner) * mesh.coordinates[2 * node + 1];
    mesh.coordinates[2 * node] = radius * std::cos(angle);
    mesh.coordinates[2 * node + 1] = radius * std::sin(angle);
  }
}

TEUCHOS_UNIT_TEST(Overlaps, NoneOfStraightSidesAlongOneArc) {
  for (const double clearance : {0.0, -0.2}) {
    scenes::Scene scene = scenes::fromBoxes({block("pin", Cell::Quadrilateral4, {0, 0, 0}, {3, 1, 0}, {12, 3, 1}),
                                             block("lug", Cell::Quadrilateral4, {0, 0, 0}, {3, 1, 0}, {17, 3, 1})});
    bend(scene.mesh, "pin", 1, 2);
    bend(scene.mesh, "lug", 2 + clearance, 3);
    const std::vector<SubdomainMesh> meshes = distributed(scene);
    const auto all = OverlapSearch(meshes, 2).find(*world());
    TEST_EQUALITY(all.size(), clearance < 0 ? 1 : 0);
    // less what straight sides cut off: 2 (1 - cos(3/24)), and as much from the others
    if (!all.empty()) TEST_COMPARE(std::abs(all[0].depth - 0.2), <, 0.03);
  }
}

TEUCHOS_UNIT_TEST(Overlaps, WithinAContactFromHalfASideOn) {
  scenes::Scene scene = scenes::twoBlocks(8, 4, 4);  // cells of 1/4
  scene.pairUp();
  const std::vector<SubdomainMesh> meshes = distributed(scene);
  const OverlapSearch search(meshes, 2);
  for (const double down : {0.1, 0.2}) {
    std::vector<Vector> displacement;
    for (const SubdomainMesh& mesh : meshes) {
      Vector& u = displacement.emplace_back(Vector::Zero(2 * mesh.nodes()));
      for (int node = 0; mesh.body == 1 && node < mesh.nodes(); ++node) u[2 * node + 1] = -down;
    }
    const auto all = search.find(*world(), displacement);
    TEST_EQUALITY(all.size(), down < 0.125 ? 0 : 1);
    if (all.empty()) continue;
    TEST_EQUALITY(all[0].contact, 0);
    TEST_FLOATING_EQUALITY(all[0].depth, 0.2, 1e-12);
    TEST_EQUALITY(OverlapSearch(meshes, 2, {0}).find(*world(), displacement).size(), 0);  // the scene gives the gap
  }
}

}  // namespace overlaps
}  // namespace suture
