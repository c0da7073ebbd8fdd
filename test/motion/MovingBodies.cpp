// Frames of bodies that move far, and couples on them.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/motion/MovingBodies.hpp>

#include <cmath>
#include <support/Blocks.hpp>

namespace suture {
namespace {

using namespace blocks;

double edgeOf(const Mesh& mesh, int a, int b) { return norm(minus(mesh.point(a), mesh.point(b))); }

TEUCHOS_UNIT_TEST(MovingBodies, LinearRotationsBecomeFiniteOnes) {
  const Scene scene = scenes::fromBoxes(twoBoxes(4, 2, 1, 1), 100.0, 0.3);
  MovingBodies bodies(scene.mesh, scene.constraints);
  TEST_EQUALITY(bodies.frames().size(), 2u);
  const double angle = 0.7;
  Vector moved(Eigen::Index(scene.mesh.coordinates.size()));
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    const Point x = scene.mesh.point(node);
    moved[2 * node] = 0.3 - angle * x[1];
    moved[2 * node + 1] = -0.2 + angle * x[0];
  }
  bodies.absorb(moved);
  TEST_COMPARE(bodies.beside().cwiseAbs().maxCoeff(), <, 1e-14);
  const Mesh present = bodies.present();
  for (int e = 0; e < present.elements(); ++e) {
    const auto nodes = present.nodesOf(e);
    TEST_FLOATING_EQUALITY(edgeOf(present, nodes[0], nodes[2]), edgeOf(scene.mesh, nodes[0], nodes[2]), 1e-13);
  }
  for (const BodyFrame& frame : bodies.frames()) TEST_FLOATING_EQUALITY(frame.rotation()[2], angle, 1e-13);
  TEST_ASSERT(present.drawn == scene.mesh.coordinates);
}

TEUCHOS_UNIT_TEST(MovingBodies, WhatIsLeftTurnsWithTheBody) {
  const Scene scene = scenes::fromBoxes(twoBoxes(4, 2, 1, 1), 100.0, 0.3);
  MovingBodies bodies(scene.mesh, scene.constraints);
  Vector stretched(Eigen::Index(scene.mesh.coordinates.size()));  // along x, about the centre of each body, whose x is the same
  double centre = 0.0;
  for (int node = 0; node < scene.mesh.nodes(); ++node) centre += scene.mesh.point(node)[0] / scene.mesh.nodes();
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    stretched[2 * node] = 1e-3 * (scene.mesh.point(node)[0] - centre);
    stretched[2 * node + 1] = 0.0;
  }
  bodies.absorb(stretched);
  bodies.move(0, {{0, 0, 0}, {0, 0, std::acos(-1.0) / 2}, {5, 5, 0}});
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    if (bodies.partOf(node) != 0) continue;
    TEST_COMPARE(std::abs(bodies.beside()[2 * node]), <, 1e-16);
    TEST_COMPARE(std::abs(bodies.beside()[2 * node + 1] - stretched[2 * node]), <, 1e-15);
  }
}

// Half of a rotation is half of its angle; strains are halved in the axes of the body.
TEUCHOS_UNIT_TEST(MovingBodies, HalfOfTheWayIsAFiniteMotionToo) {
  const Scene scene = scenes::fromBoxes(twoBoxes(4, 2, 1, 1), 100.0, 0.3);
  const MovingBodies before(scene.mesh, scene.constraints);
  MovingBodies strained = before, half = before;
  Vector stretched = Vector::Zero(Eigen::Index(scene.mesh.coordinates.size()));
  for (int node = 0; node < scene.mesh.nodes(); ++node)
    stretched[2 * node] = 1e-3 * (scene.mesh.point(node)[0] - before.frameOf(node).centre()[0]);
  strained.absorb(stretched);
  const MovingBodies::Motion motion{{2, 1, 0}, {0, 0, 1.2}, before.frames()[0].place()},
      part{{1, 0.5, 0}, {0, 0, 0.6}, before.frames()[0].place()};
  strained.move(0, motion);
  half.absorb(0.5 * stretched);
  half.move(0, part);
  MovingBodies between = strained;
  between.goPartOfTheWay(before, 0.5);
  TEST_COMPARE((between.placement() + between.beside() - half.placement() - half.beside()).cwiseAbs().maxCoeff(), <, 1e-13);
  TEST_FLOATING_EQUALITY(between.frames()[0].rotation()[2], 0.6, 1e-13);
  between = strained;
  between.goPartOfTheWay(before, 1.0);
  TEST_COMPARE((between.placement() + between.beside() - strained.placement() - strained.beside()).cwiseAbs().maxCoeff(), <, 1e-13);
}

TEUCHOS_UNIT_TEST(MovingBodies, CouplesHaveTheGivenMomentAndNoForce) {
  const Scene scene = scenes::fromBoxes(twoBoxes(4, 2, 1, 1), 100.0, 0.3);
  MovingBodies bodies(scene.mesh, scene.constraints);
  bodies.move(1, {{2, 1, 0}, {0, 0, 0.4}, {0, 0, 0}});
  const Mesh placed = bodies.placed();
  Point force{0, 0, 0}, moment{0, 0, 0};
  for (const auto& [node, own] : bodies.couple(1, {0, 0, 3})) {
    TEST_EQUALITY(bodies.partOf(node), 1);
    force = plus(force, own);
    moment = plus(moment, cross(placed.point(node), own));
  }
  TEST_COMPARE(norm(force), <, 1e-13);
  TEST_FLOATING_EQUALITY(moment[2], 3.0, 1e-12);
}

// The frame of a body follows its held nodes only.
TEUCHOS_UNIT_TEST(MovingBodies, HeldNodesMoveTheirBody) {
  const Scene scene = scenes::fromBoxes(twoBoxes(4, 2, 1, 1), 100.0, 0.3);
  Constraints constraints = scene.constraints;
  constraints.rules.clear();
  MovingBodies free(scene.mesh, constraints);
  TEST_ASSERT(!free.isHeld(0) && !free.isHeld(1));
  Vector moved = Vector::Zero(Eigen::Index(scene.mesh.coordinates.size()));
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    if (free.partOf(node) != 1) continue;
    const Point x = scene.mesh.point(node);
    if (constraints.rules.size() >= 2) {
      moved[2 * node] = 77.0;  // deformation, which is no motion of the frame
      continue;
    }
    NodeRule rule;
    rule.node = node;
    rule.fixed = {true, true, false};
    constraints.rules.push_back(rule);
    moved[2 * node] = 0.3 - 1e-3 * x[1];
    moved[2 * node + 1] = -0.2 + 1e-3 * x[0];
  }
  MovingBodies bodies(scene.mesh, constraints);
  TEST_ASSERT(!bodies.isHeld(0) && bodies.isHeld(1));
  const MovingBodies::Motion motion = bodies.motionOf(1, moved);
  TEST_FLOATING_EQUALITY(motion.rotation[2], 1e-3, 1e-10);
  TEST_FLOATING_EQUALITY(motion.shift[0], 0.3 - 1e-3 * motion.about[1], 1e-12);
  TEST_FLOATING_EQUALITY(motion.shift[1], -0.2 + 1e-3 * motion.about[0], 1e-12);
}

TEUCHOS_UNIT_TEST(MovingBodies, BodiesThatRestKeepTheirFrames) {
  const Scene scene = scenes::fromBoxes(twoBoxes(4, 2, 1, 1), 100.0, 0.3);
  MovingBodies bodies(scene.mesh, scene.constraints, {false, true});
  const int resting = bodies.bodies()[0] == 1 ? 0 : 1;
  TEST_ASSERT(bodies.rests(resting) && !bodies.rests(1 - resting));
  Vector moved = Vector::Constant(Eigen::Index(scene.mesh.coordinates.size()), 0.25);
  bodies.absorb(moved);
  for (const int part : {0, 1}) bodies.move(part, {{0, 1, 0}, {0, 0, 0.5}, {0, 0, 0}});
  const BodyFrame &rests = bodies.frames()[static_cast<std::size_t>(resting)],
                  &moves = bodies.frames()[static_cast<std::size_t>(1 - resting)];
  TEST_ASSERT(rests.place() == rests.centre() && rests.rotation()[2] == 0.0);
  TEST_FLOATING_EQUALITY(moves.rotation()[2], 0.5, 1e-14);
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    const double expected = bodies.partOf(node) == resting ? 0.25 : 0.0;
    TEST_COMPARE(std::abs(bodies.beside()[2 * node] - expected), <, 1e-14);
  }
}

}  // namespace
}  // namespace suture
