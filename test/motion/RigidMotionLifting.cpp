// Rigid motions taken out of a scene: the remainders, and no loss of digits.
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Gather.hpp>
#include <suture/constraints/ContactRows.hpp>
#include <suture/motion/RigidMotionLifting.hpp>

#include <cmath>
#include <support/Blocks.hpp>
#include <support/DryLaw.hpp>

namespace suture {
namespace {

using namespace blocks;

/// Two blocks in contact, the lower held at its bottom, the upper at its top; rules are prescribed by `move` at their place.
Scene carried(const std::function<Point(const Point&)>& lower, const std::function<Point(const Point&)>& upper) {
  Scene scene = scenes::fromBoxes(twoBoxes(8, 4, 2, 2), 100.0, 0.3);
  scene.pairUp();
  for (ContactPair& pair : scene.constraints.pairs) pair.gap = 0.01 * pair.position[0] * pair.position[0];
  for (const int node : scene.nodesOf("lower_bottom"))
    for (int k = 0; k < 2; ++k) scene.holdNode(node, k, lower(scene.mesh.point(node))[k]);
  for (const int node : scene.nodesOf("upper_top"))
    for (int k = 0; k < 2; ++k) scene.holdNode(node, k, upper(scene.mesh.point(node))[k]);
  return scene;
}

Point nowhere(const Point&) { return {0, 0, 0}; }

/// Rules and pairs of all ranks before and after.
struct Taken {
  Scene scene;
  Blocks all;
  Constraints left;
  bool any;
  explicit Taken(const Scene& given)
      : scene(given), all(given, world()), left(given.constraints), any(takeOutRigidMotions(*world(), all.meshes)) {
    if (any) adopt(*world(), all.meshes, left);
  }
  /// Component k of the motion at a node of the mesh; zero if no rank has it.
  double motion(int node, int k) const {
    double mine = 0.0, most = 0.0, least = 0.0;
    for (const SubdomainMesh& mesh : all.meshes)
      for (int local = 0; local < mesh.nodes(); ++local)
        if (mesh.globalNodes[local] == node) mine = mesh.lift.motion[2 * local + k];
    Teuchos::reduceAll(*world(), Teuchos::REDUCE_MAX, mine, Teuchos::outArg(most));
    Teuchos::reduceAll(*world(), Teuchos::REDUCE_MIN, mine, Teuchos::outArg(least));
    return std::abs(least) > most ? least : most;
  }
};

TEUCHOS_UNIT_TEST(RigidMotionLifting, LeavesZerosAlone) {
  const Taken taken(carried(nowhere, nowhere));
  TEST_ASSERT(!taken.any);
  for (const SubdomainMesh& mesh : taken.all.meshes) TEST_EQUALITY(mesh.lift.motion.size(), 0);
}

/// Half of the height: no rigid motion describes a body that is squeezed between its ends.
TEUCHOS_UNIT_TEST(RigidMotionLifting, LeavesAStretchAlone) {
  Scene scene = carried(nowhere, nowhere);
  for (const int node : scene.nodesOf("upper_top")) scene.holdNode(node, 1, -0.1);
  for (const int node : scene.nodesOf("upper_bottom")) scene.holdNode(node, 1, 0.1);
  const Taken taken(scene);
  TEST_ASSERT(!taken.any);
  for (const SubdomainMesh& mesh : taken.all.meshes)
    for (const NodeRule& rule : mesh.rules) TEST_ASSERT(rule.value[1] == 0.0 || std::abs(rule.value[1]) == 0.1);
}

/// Numbers without a short binary form: their remainder is the same at all nodes, to the last bit, and nearly zero.
TEUCHOS_UNIT_TEST(RigidMotionLifting, LeavesEqualRemaindersOfATranslation) {
  for (const Point& value : {Point{1e6 / 3, -0.1, 0}, Point{0.3, 0.1, 0}, Point{-1e-7, 1e13 / 7, 0}}) {
    const auto shift = [&](const Point&) { return value; };
    const Taken taken(carried(shift, shift));
    TEST_ASSERT(taken.any);
    if (world()->getRank() > 0) continue;
    const double size = std::hypot(value[0], value[1]);
    const NodeRule& first = taken.left.rules.front();
    for (const NodeRule& rule : taken.left.rules)
      for (int k = 0; k < 2; ++k) {
        TEST_EQUALITY(rule.value[k], first.value[k]);
        TEST_COMPARE(std::abs(rule.value[k]), <, 1e-13 * size);
      }
    // Bodies that move together change no gap.
    for (const ContactPair& pair : taken.left.pairs) TEST_EQUALITY(pair.gap, taken.scene.constraints.pairs[pair.id].gap);
  }
}

TEUCHOS_UNIT_TEST(RigidMotionLifting, MotionAndRemainderMakeUpWhatWasPrescribed) {
  for (const double turn : {0.0, 1e-3, 2e6}) {
    const auto carry = [&](const Point& x) { return Point{5.0 - turn * x[1], 0.7 + turn * x[0] + 1e-4 * x[0] * x[0], 0}; };
    Scene scene = carried(nowhere, carry);
    const Taken taken(scene);
    TEST_ASSERT(taken.any);
    for (const NodeRule& rule : taken.left.rules)
      for (int k = 0; k < 2; ++k) {
        const double before = scene.ruleOf(rule.node).value[k], motion = taken.motion(rule.node, k);
        if (world()->getRank() > 0) continue;
        TEST_COMPARE(std::abs(motion + rule.value[k] - before), <=, 4e-16 * std::abs(before));
        // Only the curve remains, since it is no rigid motion: 1e-4 here, or the round-off of the prescribed values.
        TEST_COMPARE(std::abs(rule.value[k]), <, 1.1e-4 + 1e-15 * turn);
      }
  }
}

/// gap - n.T_A + n.T_B, in closed form; a row's gap is that of the same scene built anew.
TEUCHOS_UNIT_TEST(RigidMotionLifting, GapsChangeByTheMotionOfBothSides) {
  const auto lower = [](const Point&) { return Point{0.25, 0.5, 0}; };
  const auto upper = [](const Point&) { return Point{-1.0, 1024.5, 0}; };
  Scene scene = carried(lower, upper);
  scene.holdNode(scene.constraints.pairs[3].ends[0].node, 1, 0.5);  // on the line: in the row's gap
  const Taken taken(scene);
  TEST_ASSERT(taken.any);
  if (world()->getRank() == 0)
    for (const ContactPair& pair : taken.left.pairs)
      TEST_COMPARE(std::abs(pair.gap - (scene.constraints.pairs[pair.id].gap + 1024.0)), <, 4e-13);
  const std::vector<ContactRow> rows = world()->getRank() == 0 ? contactRows(scene.mesh, taken.left) : std::vector<ContactRow>();
  std::vector<double> gaps(scene.constraints.pairs.size());
  for (const ContactRow& row : rows) gaps[row.pair.id] = row.normal().gap;
  broadcastBytes(*world(), gaps.data(), gaps.size() * sizeof(double));
  for (const SubdomainMesh& mesh : taken.all.meshes)
    for (const ContactRow& row : mesh.contactRows) {
      TEST_COMPARE(std::abs(row.normal().gap - gaps[row.pair.id]), <, 4e-13);
      TEST_EQUALITY(mesh.lift.gaps.at(row.pair.id), scene.constraints.pairs[row.pair.id].gap);
    }
}

/// With friction the slip from which pairs slide changes, too: by 1.25 along the sides.
TEUCHOS_UNIT_TEST(RigidMotionLifting, SlipsChangeByTheMotionOfBothSides) {
  Scene scene = carried([](const Point&) { return Point{0.25, 0.5, 0}; }, [](const Point&) { return Point{-1.0, 0.5, 0}; });
  scene.constraints.laws = ContactLaws({scenes::dry(0.0, 0.3)});
  scene.holdNode(scene.constraints.pairs[3].ends[0].node, 0, 0.25);  // on the line: in the row's slip
  const Taken taken(scene);
  TEST_ASSERT(taken.any);
  if (world()->getRank() == 0)
    for (const ContactPair& pair : taken.left.pairs) TEST_COMPARE(std::abs(std::abs(pair.past.slip[0]) - 1.25), <, 1e-15);
  const std::vector<ContactRow> rows = world()->getRank() == 0 ? contactRows(scene.mesh, taken.left) : std::vector<ContactRow>();
  std::vector<double> slips(scene.constraints.pairs.size());
  for (const ContactRow& row : rows) slips[row.pair.id] = row.equations.at(1).gap;
  broadcastBytes(*world(), slips.data(), slips.size() * sizeof(double));
  for (const SubdomainMesh& mesh : taken.all.meshes)
    for (const ContactRow& row : mesh.contactRows) {
      TEST_COMPARE(std::abs(row.equations.at(1).gap - slips[row.pair.id]), <, 1e-15);
      TEST_EQUALITY(norm(mesh.pastSlip(row.pair)), 0.0);
    }
}

/// The weights of a mortar sum to zero up to round-off, which 1e12 body sizes would turn into a gap of 1e-4.
TEUCHOS_UNIT_TEST(RigidMotionLifting, MortarGapsKeepTheirDigits) {
  const auto shift = [](const Point&) { return Point{0, 1e12, 0}; };
  Scene scene = carried(shift, shift);
  for (ContactPair& pair : scene.constraints.pairs) {
    if (pair.id == 0) continue;
    const int left = scene.constraints.pairs[pair.id - 1].ends[1].node, right = pair.ends[1].node;
    pair.ends = {{pair.ends[0].node, 1.0}, {left, -0.1}, {right, -(0.3 + 0.6)}};
  }
  const Taken taken(scene);
  TEST_ASSERT(taken.any);
  if (world()->getRank() == 0)
    for (const ContactPair& pair : taken.left.pairs) TEST_EQUALITY(pair.gap, scene.constraints.pairs[pair.id].gap);
}

/// A part that nothing holds is moved twice, also rotated: its gaps, its lift and its initial gaps; the other part stays.
TEUCHOS_UNIT_TEST(RigidMotionLifting, FurtherMotionsAddUp) {
  Scene scene = carried(nowhere, nowhere);
  scene.constraints.rules.resize(scene.nodesOf("lower_bottom").size());
  Blocks all(scene, world());
  std::vector<const SubdomainMesh*> meshes;
  for (const SubdomainMesh& mesh : all.meshes) meshes.push_back(&mesh);
  const BodyParts parts(*world(), meshes, 2);
  TEST_EQUALITY(parts.parts.size(), 2);
  std::vector<Vector> motion(2, Vector::Zero(3));
  const int upper = parts.parts[0].body == 1 ? 0 : 1;
  motion[upper] << 0.25, -0.5, 0.125;
  moveFurther(*world(), all.meshes, motion);
  moveFurther(*world(), all.meshes, motion);
  const RigidPart& part = parts.parts[upper];
  const auto moved = [&](const Point& x) {
    const double turn = 0.25 / part.radius;
    return Point{0.5 - turn * (x[1] - part.centre[1]), -1.0 + turn * (x[0] - part.centre[0]), 0};
  };
  for (std::size_t s = 0; s < all.meshes.size(); ++s) {
    const SubdomainMesh& mesh = all.meshes[s];
    for (int node = 0; node < mesh.nodes(); ++node)
      for (int k = 0; k < 2; ++k)
        TEST_COMPARE(std::abs(mesh.lift.motion[2 * node + k] - (parts.partOf[s] == upper ? moved(mesh.point(node))[k] : 0.0)), <, 1e-14);
    for (const NodeRule& rule : mesh.rules) TEST_EQUALITY(rule.value[1], 0.0);
    for (const ContactRow& row : mesh.contactRows) {
      // The upper side is the second end, at the place of the first.
      const ContactPair& before = scene.constraints.pairs[row.pair.id];
      const Point by = moved(before.position);
      const double closed = before.ends[1].weight * (before.normal[0] * by[0] + before.normal[1] * by[1]);
      TEST_COMPARE(std::abs(row.pair.gap - (before.gap - closed)), <, 1e-14);
      TEST_EQUALITY(mesh.lift.gaps.at(row.pair.id), before.gap);
    }
  }
}

TEUCHOS_UNIT_TEST(RigidMotionLifting, IsTakenOutOnce) {
  const auto shift = [](const Point&) { return Point{3, 4, 0}; };
  Taken taken(carried(shift, shift));
  bool ruled = false;
  for (SubdomainMesh& mesh : taken.all.meshes)
    for (NodeRule& rule : mesh.rules) rule.value = {1, 1, 0}, ruled = true;
  if (ruled) TEST_THROW(takeOutRigidMotions(*alone(), taken.all.meshes), InternalError);
}

}  // namespace
}  // namespace suture
