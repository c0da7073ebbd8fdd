#include <Teuchos_UnitTestHarness.hpp>
#include <random>
#include <set>
#include <suture/base/Point.hpp>
#include <suture/constraints/ContactRows.hpp>
#include <suture/pairs/FrictionLaws.hpp>

#include <pairs/RoughLaw.hpp>
#include "ConstraintsTesting.hpp"

using namespace constraintstesting;

namespace {

/// Random displacements that satisfy the rules: Cartesian ones of each node, and the same in the axes of the nodes.
struct Motion {
  std::vector<Point> cartesian;
  std::map<GlobalId, double> local;

  Motion(const Mesh& mesh, const Constraints& constraints, unsigned seed) : cartesian(mesh.nodes()) {
    std::mt19937 generator(seed);
    for (int node = 0; node < mesh.nodes(); ++node) {
      NodeRule rule;
      if (const NodeRule* own = ruleAt(constraints, node)) rule = *own;
      Point u{0, 0, 0};
      for (int k = 0; k < 2; ++k) {
        const double value = rule.fixed[k] ? rule.value[k] : generator() / 2147483647.5 - 1.0;
        if (!rule.fixed[k]) local[2 * node + k] = value;
        for (int c = 0; c < 2; ++c) u[c] += rule.axes[k][c] * value;
      }
      cartesian[node] = u;
    }
  }
  double gap(const ContactPair& pair) const {
    double left = pair.gap;
    for (int c = 0; c < 2; ++c) left -= (cartesian[pair.ends[0].node][c] - cartesian[pair.ends[1].node][c]) * pair.normal[c];
    return left;
  }
  double gap(const ContactRow::Equation& row) const {
    double left = row.gap;
    for (std::size_t i = 0; i < row.dofs.size(); ++i) left -= row.coefficients[i] * local.at(row.dofs[i]);  // throws if it is not free
    return left;
  }
  double gap(const ContactRow& row) const { return gap(row.normal()); }
};

NodeRule& ruleFor(Constraints& constraints, int node) {
  const auto at = std::lower_bound(constraints.rules.begin(), constraints.rules.end(), node,
                                   [](const NodeRule& rule, int number) { return rule.node < number; });
  if (at != constraints.rules.end() && at->node == node) return *at;
  NodeRule rule;
  rule.node = node;
  return *constraints.rules.insert(at, rule);
}

ContactPair pairOf(int id, int a, int b, double angle) {
  ContactPair pair;
  pair.id = id;
  pair.ends = matchingEnds(a, b);
  pair.normal = {std::cos(angle), std::sin(angle), 0};
  pair.gap = 0.1 * id;
  return pair;
}

}  // namespace

TEUCHOS_UNIT_TEST(ContactRow, GivesTheGapOfEveryMotionThatTheRulesAllow) {
  // A leaning stack: rollers meet the contact line, one end is pulled, the rest has the axes of its pair or Cartesian ones.
  Mesh mesh = stack(2);
  moveAll(mesh, [](Point p) -> Point { return {p[0] * 0.8 - p[1] * 0.6, p[0] * 0.6 + p[1] * 0.8, 0}; });
  Constraints constraints =
      build(mesh, bilateral("roller", "b0_left") + displacement("pull", "b1_right", "{0.25, -1}"), contact("line", "b0_top", "b1_bottom"));
  ruleFor(constraints, constraints.pairs[4].ends[0].node).axes = {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}};
  constraints.pairs[3].gap = -0.2;
  const std::vector<ContactRow> rows = contactRows(mesh, constraints);
  TEST_EQUALITY(rows.size(), std::size_t(9));
  std::set<std::size_t> lengths;
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Motion motion(mesh, constraints, seed);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      TEST_EQUALITY(rows[i].pair.id, static_cast<int>(i));
      TEST_COMPARE(std::abs(motion.gap(rows[i]) - motion.gap(constraints.pairs[i])), <, 1e-14);
      TEST_ASSERT(std::is_sorted(rows[i].normal().dofs.begin(), rows[i].normal().dofs.end()));
      lengths.insert(rows[i].normal().dofs.size());
      for (std::size_t k = 0; k < rows[i].normal().dofs.size(); ++k)
        TEST_ASSERT(rows[i].normal().points[k] == mesh.point(int(rows[i].normal().dofs[k] / 2)));
    }
  }
  TEST_EQUALITY(rows[5].normal().dofs.size(), 2u);  // both nodes in the axes of the pair
  TEST_EQUALITY(rows[5].normal().coefficients[0], 1.0);
  TEST_EQUALITY(rows[5].normal().coefficients[1], -1.0);
  TEST_EQUALITY(rows[4].normal().dofs.size(), 3u);  // one of them Cartesian
  TEST_ASSERT(lengths.count(1) == 1);               // one end is pulled: only the other can move
}

TEUCHOS_UNIT_TEST(ContactRow, TakesWhatPrescribedComponentsCloseFromTheGap) {
  const Mesh mesh = stack(2);
  Constraints constraints;
  constraints.pairs = {pairOf(0, 3, 30, std::atan2(0.8, 0.6))};
  constraints.pairs[0].gap = 0.5;
  NodeRule& a = ruleFor(constraints, 3);
  a.fixed[1] = true;
  a.value[1] = 0.25;
  ruleFor(constraints, 30).fixed = {true, true, false};
  ruleFor(constraints, 30).value = {-0.5, 1.0, 0};
  const ContactRow::Equation row = contactRows(mesh, constraints).at(0).normal();
  TEST_ASSERT(row.dofs == std::vector<GlobalId>{6});
  TEST_FLOATING_EQUALITY(row.coefficients[0], 0.6, 1e-15);
  // 0.6 u <= 0.5 - 0.8 * 0.25 + (0.6 * -0.5 + 0.8 * 1.0)
  TEST_FLOATING_EQUALITY(row.gap, 0.8, 1e-14);
}

TEUCHOS_UNIT_TEST(ContactRow, IsEmptyWhereNothingCanMove) {
  const Mesh mesh = stack(2);
  const Constraints constraints = build(
      mesh, bilateral("left", "b0_left") + displacement("hold", "b0_right", "0.125", "y") + displacement("above", "b1_right", "0.5", "y"),
      contact("line", "b0_top", "b1_bottom"));
  const std::vector<ContactRow> rows = contactRows(mesh, constraints);
  int empty = 0;
  for (const ContactRow& row : rows) {
    if (row.canChange()) continue;
    ++empty;
    TEST_EQUALITY(mesh.point(row.pair.ends[0].node)[0], 4.0);
    TEST_FLOATING_EQUALITY(row.normal().gap, 0.375, 1e-14);  // B moved away by 0.5 - 0.125
    TEST_EQUALITY(row.cluster, row.pair.id);
  }
  TEST_EQUALITY(empty, 1);
}

TEUCHOS_UNIT_TEST(ContactRow, BelongsToTheClusterOfRowsThatShareAnUnknown) {
  const Mesh mesh = stack(2);
  Constraints constraints;
  const double half = std::acos(0.0);
  constraints.pairs = {
      pairOf(0, 1, 2, 0.3),   pairOf(1, 8, 9, 0.3),    pairOf(2, 3, 4, 0.3),  // three apart,
      pairOf(3, 4, 2, 0.4),                                                   // the first and the third joined by this one
      pairOf(4, 9, 10, -0.7),                                                 // and the second longer
      pairOf(5, 11, 12, 0.0), pairOf(6, 12, 13, half),                        // a common node but no common unknown: along x and along y
      pairOf(7, 20, 21, 0.0), pairOf(8, 21, 22, 0.0),                         // a common node whose x is held
      pairOf(9, 23, 24, 0.0),
  };
  ruleFor(constraints, 21).fixed[0] = true;
  std::vector<int> clusters;
  for (const ContactRow& row : contactRows(mesh, constraints)) clusters.push_back(row.cluster);
  TEST_COMPARE_ARRAYS(clusters, (std::vector<int>{0, 1, 0, 0, 1, 5, 6, 7, 8, 9}));
}

// If the law restricts sliding, there is a row along the tangent: u_A - u_B along (-n_y, n_x), prescribed parts eliminated.
TEUCHOS_UNIT_TEST(ContactRow, HasTangentsWhereTheLawRestrictsSliding) {
  Mesh mesh = stack(2);
  moveAll(mesh, [](Point p) -> Point { return {p[0] * 0.8 - p[1] * 0.6, p[0] * 0.6 + p[1] * 0.8, 0}; });
  Constraints constraints =
      build(mesh, bilateral("roller", "b0_left") + displacement("pull", "b1_right", "{0.25, -1}"), contact("line", "b0_top", "b1_bottom"));
  for (const ContactRow& row : contactRows(mesh, constraints)) TEST_EQUALITY(row.equations.size(), 1u);
  constraints.laws = ContactLaws({std::make_shared<RoughLaw>()});
  const std::vector<ContactRow> rows = contactRows(mesh, constraints);
  TEST_EQUALITY(rows.size(), constraints.pairs.size());
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Motion motion(mesh, constraints, seed);
    for (const ContactRow& row : rows) {
      TEST_EQUALITY(row.equations.size(), 2u);
      ContactPair along = row.pair;
      along.gap = 0.0;
      along.normal = {-row.pair.normal[1], row.pair.normal[0], 0};
      TEST_COMPARE(std::abs(motion.gap(row.equations[0]) - motion.gap(row.pair)), <, 1e-14);
      TEST_COMPARE(std::abs(motion.gap(row.equations[1]) - motion.gap(along)), <, 1e-14);
    }
  }
}

// Both sides on one plane of symmetry: nothing slides across it. If only one side is held, the other slides along it.
TEUCHOS_UNIT_TEST(ContactRow, SlidesNowhereAcrossAPlaneOfSymmetry) {
  const Mesh mesh = stack(2);
  for (const bool both : {true, false}) {
    Constraints constraints =
        build(mesh, bilateral("low", "b0_left") + (both ? bilateral("high", "b1_left") : ""), contact("line", "b0_top", "b1_bottom"));
    applyLaws(ContactLaws({std::make_shared<RoughLaw>()}), mesh, constraints);
    int still = 0;
    for (const ContactPair& pair : constraints.pairs) {
      const Point tangent = rowDirections(pair, 2).at(1);
      if (pair.still.empty()) {
        TEST_FLOATING_EQUALITY(norm(tangent), 1.0, 1e-14);
        continue;
      }
      ++still;
      for (const ContactPair& other : constraints.pairs) TEST_COMPARE(pair.position[0], <=, other.position[0]);
      TEST_COMPARE(norm(tangent), <, 1e-15);
      TEST_COMPARE(norm(slidingPart(pair, {3.0, 4.0, 0.0})), <, 1e-14);
    }
    TEST_EQUALITY(still, both ? 1 : 0);
  }
}

// Only ends of the other side count: on second-order sides, ends of the own side may have weights of its sign.
TEUCHOS_UNIT_TEST(ContactRow, SlidesIfOnlyNodesOfItsOwnSideAreHeldAlike) {
  const Mesh mesh = stack(2);
  for (const double other : {-1.0, 0.0, 0.5}) {  // value at the other side; negative: none
    Constraints constraints;
    ContactPair pair = pairOf(0, 1, 9, std::acos(0.0));
    pair.line = 0;
    pair.ends = {{1, 1.2}, {2, -0.2}, {9, -1.0}};
    pair.own = 2;
    constraints.pairs = {pair};
    for (const int node : {1, 2, 9}) {
      if (node == 9 && other < 0.0) continue;
      ruleFor(constraints, node).fixed[0] = true;
      ruleFor(constraints, node).value[0] = node == 9 ? other : 0.0;
    }
    applyLaws(ContactLaws({std::make_shared<RoughLaw>()}), mesh, constraints);
    TEST_EQUALITY(constraints.pairs[0].still.size(), other == 0.0 ? 1u : 0u);
  }
}

// A node of a rigid group that can move follows its masters, whatever its own value is: here the last one of a side that can move and turn.
TEUCHOS_UNIT_TEST(ContactRow, SlidesWithARigidGroupThatCanMove) {
  const Mesh mesh = stack(2);
  for (const bool moves : {true, false}) {
    std::vector<std::pair<std::string, std::string>> group{{"Group", "b1_bottom"}, {"Type", "Rigid Group"}, {"Point", "{1.0, 3.0}"}};
    if (!moves) group.insert(group.end(), {{"Motion x", "0"}, {"Rotation z", "0"}});
    Constraints constraints =
        build(mesh, displacement("wall", "b0_right", "{0, 0}") + entry("platen", group), contact("line", "b0_top", "b1_bottom"));
    applyLaws(ContactLaws({std::make_shared<RoughLaw>()}), mesh, constraints);
    int still = 0;
    for (const ContactPair& pair : constraints.pairs) {
      const NodeRule* rule = ruleAt(constraints, pair.ends[1].node);
      const bool isHeld = ruleAt(constraints, pair.ends[0].node) && ruleAt(constraints, pair.ends[0].node)->fixed[0];
      if (isHeld) TEST_ASSERT(rule && rule->fixed[0] && rule->value[0] == 0.0);
      still += !pair.still.empty();
    }
    TEST_EQUALITY(still, moves ? 0 : 1);
  }
}

// Glued sides stay as meshed; guided or frictional sides close the gap of the mesh. Rows know which pairs can separate.
TEUCHOS_UNIT_TEST(ContactRow, HasNoGapWhereTheLawKeepsTheMeshedGap) {
  const Mesh mesh = stack(2);
  Constraints before = build(mesh, bilateral("roller", "b0_left"), contact("line", "b0_top", "b1_bottom"));
  for (ContactPair& pair : before.pairs) pair.gap = 0.25 - 0.5 * (pair.id % 2);
  struct Case {
    std::shared_ptr<const ContactLaw> law;
    bool separates, ignoresGap;
  };
  for (const Case& of : {Case{std::make_shared<Tied>(), false, true}, Case{std::make_shared<NoSeparation>(), false, false},
                         Case{std::make_shared<Frictionless>(), true, false}, Case{std::make_shared<RoughLaw>(), true, false}}) {
    Constraints constraints = before;
    applyLaws(ContactLaws({of.law}), mesh, constraints);
    const std::vector<ContactRow> rows = contactRows(mesh, constraints);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      TEST_EQUALITY(rows[i].pair.gap, of.ignoresGap ? 0.0 : before.pairs[i].gap);
      TEST_EQUALITY(rows[i].normal().gap, rows[i].pair.gap);
      TEST_EQUALITY(rows[i].separates, of.separates);
      TEST_EQUALITY(rows[i].restrictsSliding(), of.law->rows(2) > 1);
    }
  }
}

TEUCHOS_UNIT_TEST(ContactRow, IsNoneWithoutContact) {
  const Mesh mesh = stack(1);
  TEST_EQUALITY(contactRows(mesh, build(mesh, bilateral("roller", "b0_left"))).size(), 0u);
}
