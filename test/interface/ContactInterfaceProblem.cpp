#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <interface/DenseSpace.hpp>
#include <interface/RecoveredPairs.hpp>
#include <pairs/RoughLaw.hpp>
#include <suture/pairs/FrictionLaws.hpp>

namespace suture {
namespace {

using namespace blocks;

// The same scene by dense algebra: all bodies apart, condensed to the interface's unknowns; contact rows from the pairs and rules.
struct Reference {
  const Scene& scene;
  Matrix s, rows, tangents;  // rows of the pairs along their normals and along (-n_y, n_x)
  Vector load, gaps, slips;  // and their right-hand sides
  double constant = 0.0;

  Reference(const Scene& given, const DenseSpace& space) : scene(given) {
    const Blocks all(scene, alone());
    const Dense whole(all);
    const std::vector<int> boundary = whole.places(space.ids), interior = complement(int(whole.load.size()), boundary);
    s = denseSchur(whole.stiffness, boundary, whole.load, &load);
    const Matrix ii = rowsAt(rowsAt(whole.stiffness, interior).transpose(), interior);
    const Vector f = rowsAt(whole.load, interior);
    constant = whole.constantEnergy - 0.5 * f.dot(solveSymmetric(ii, f).col(0));

    const int pairs = int(scene.constraints.pairs.size());
    rows = tangents = Matrix::Zero(pairs, space.size());
    gaps = slips = Vector::Zero(pairs);
    for (const ContactPair& pair : scene.constraints.pairs) {
      gaps(pair.id) = pair.gap;
      for (const auto& [node, side] : {std::make_pair(pair.ends[0].node, 1), std::make_pair(pair.ends[1].node, -1)}) {
        NodeRule rule;
        for (const NodeRule& own : scene.constraints.rules)
          if (own.node == node) rule = own;
        for (int k = 0; k < 2; ++k) {
          const double along = side * (rule.axes[k][0] * pair.normal[0] + rule.axes[k][1] * pair.normal[1]);
          const double across = side * (rule.axes[k][1] * pair.normal[0] - rule.axes[k][0] * pair.normal[1]);
          if (rule.fixed[k]) {
            gaps(pair.id) -= along * rule.value[k];
            slips(pair.id) -= across * rule.value[k];
            continue;
          }
          if (std::abs(along) > 1e-12) rows(pair.id, space.place(2 * node + k)) += along;
          if (std::abs(across) > 1e-12 && sticks()) tangents(pair.id, space.place(2 * node + k)) += across;
        }
      }
    }
  }
  bool sticks() const { return scene.constraints.laws.size() > 0; }
  bool able(int pair) const { return rows.row(pair).norm() > 0.0; }
  double energy(const Vector& u) const { return constant + 0.5 * u.dot(s * u) - u.dot(load); }
};

std::map<int, ContactState> statusOf(int pairs, int pattern, PairStatus closed = PairStatus::Slip) {
  std::map<int, ContactState> status;
  for (int p = 0; p < pairs; ++p) {
    const bool open = pattern == 1 ? p % 3 == 1 : pattern == 2 ? (p * 7 + 3) % 5 < 3 : pattern == 3;
    status[p] = open ? PairStatus::Open : closed;
  }
  return status;
}

std::vector<Vector> someValues(const Blocks& all) {
  std::vector<Vector> values;
  for (const auto& subdomain : all.subdomains) {
    values.emplace_back(subdomain->dofs());
    for (int i = 0; i < subdomain->dofs(); ++i) values.back()(i) = 0.01 * std::sin(3.7 * double(subdomain->globalDof(i)));
  }
  return values;
}

/// A set of closed pairs has no friction: sticking is a property of their states.
InterfaceState allStuck(const ContactInterfaceProblem& problem, int pairs) {
  InterfaceState state = problem.contact()->stateWith(PairStates(static_cast<std::size_t>(pairs), PairStatus::Stick));
  problem.conform(state);
  return state;
}

void agreesWithTheReference(const Scene& scene, bool& success, Teuchos::FancyOStream& out) {
  const OnInterface one(scene, world());
  const DenseSpace space(*one.problem.space());
  const Reference reference(scene, space);
  const int pairs = int(scene.constraints.pairs.size());
  int able = 0;
  for (int p = 0; p < pairs; ++p) able += reference.able(p);
  TEST_EQUALITY(one.problem.pairs(), able);
  TEST_EQUALITY(one.problem.pieces(), int(scene.constraints.pieces.size()));
  const double size = reference.s.norm();

  for (int pattern = 0; pattern < 4; ++pattern) {
    const std::map<int, ContactState> status = statusOf(pairs, pattern, reference.sticks() ? PairStatus::Stick : PairStatus::Slip);
    InterfaceState state = one.problem.stateOf(someValues(one.all), status);
    Matrix closed(0, space.size());
    Vector closedGaps(0);
    int count = 0;
    for (int p = 0; p < pairs; ++p) {
      if (!status.at(p).closed() || !reference.able(p)) continue;
      const auto add = [&](const Matrix& rows, const Vector& gaps) {
        closed.conservativeResize(count + 1, space.size());
        closedGaps.conservativeResize(count + 1);
        closed.row(count) = rows.row(p);
        closedGaps(count++) = gaps(p);
      };
      add(reference.rows, reference.gaps);
      if (reference.sticks() && reference.tangents.row(p).norm() > 0.0) add(reference.tangents, reference.slips);
    }
    Vector u = space.dense(*state.trace);
    if (count > 0) TEST_COMPARE((closed * u - closedGaps).norm(), <, 1e-14 * count);  // the trace was moved onto the rows

    const InterfaceProblem::Linearisation linear = one.problem.linearise(state);
    const DenseSpace derived(*linear.matrix->space());
    double spread = 1.0;
    const Matrix t = derived.gathered(&spread);
    TEST_COMPARE(spread, <, 1e-14);
    if (count > 0) TEST_COMPARE((closed * t).norm(), <, 1e-12);
    int idle = 0;
    for (int j = 0; j < t.cols(); ++j) idle += t.col(j).norm() == 0.0;
    TEST_EQUALITY(idle, count == 0 ? 0 : rank(closed));
    const Matrix a = derived.dense(static_cast<const Operator&>(*linear.matrix)), expected = t.transpose() * reference.s * t;
    TEST_COMPARE((a - expected).norm(), <, 1e-12 * size);
    TEST_COMPARE((a - a.transpose()).norm(), <, 1e-13 * size);

    const Vector imbalance = reference.load - reference.s * u;
    const double scale = reference.load.norm() + size * u.norm();
    TEST_COMPARE((derived.dense(*linear.load) - t.transpose() * imbalance).norm(), <, 1e-12 * scale);
    const InterfaceProblem::Evaluation value = one.problem.evaluate(state);
    TEST_COMPARE((derived.dense(*value.residual) - t.transpose() * imbalance).norm(), <, 1e-12 * scale);
    TEST_EQUALITY(value.applications, 1);
    TEST_FLOATING_EQUALITY(value.energy, reference.energy(u), 1e-11);
    TEST_EQUALITY(value.settled, value.changed == 0);
    if (!reference.sticks()) TEST_EQUALITY(int(one.problem.differing(state.status, value.next).size()), value.changed);

    const InterfaceProblem::Recovered found = one.problem.recover(state);
    TEST_FLOATING_EQUALITY(found.energy, value.energy, 1e-11);
    for (const PairResult& pair : pairsOf(one.all, found)) {  // throws unless each of them is on one rank
      const int p = pair.id;
      TEST_COMPARE(std::abs(pair.gap - (reference.gaps(p) - reference.rows.row(p).dot(u))), <, 1e-14);
      TEST_ASSERT(pair.state == (reference.able(p) ? status.at(p) : ContactState()));
      if (!pair.state.closed()) TEST_EQUALITY(pair.force, 0.0);
    }

    // A step, and what the operator recorded of it: the state then stores the result of a fresh application.
    const Matrix w = 0.01 * random(derived.size(), 1, 30 + pattern);
    const MultiVectorPtr step = derived.vector(w), product = derived.space.vector();
    linear.matrix->record();
    linear.matrix->apply(*step, *product);
    const Matrix image = linear.matrix->recorded({1.0});
    state.memory.reset();
    InterfaceState start = reference.sticks() ? allStuck(one.problem, pairs) : one.problem.initialState();
    TEST_ASSERT(start.memory != nullptr);
    for (const double length : {1.0, -0.3}) {
      one.problem.update(state, *step, length, &image);
      TEST_ASSERT(state.memory == nullptr);  // nothing was known before
      u += length * (t * w).col(0);
      TEST_COMPARE((space.dense(*state.trace) - u).norm(), <, 1e-13 * u.norm());
    }
    if (pattern == 0) {  // the state with all pairs closed or sticking, with stored products
      one.problem.update(start, *step, 0.7, &image);
      TEST_ASSERT(start.memory != nullptr);
      const InterfaceProblem::Evaluation known = one.problem.evaluate(start);
      TEST_EQUALITY(known.applications, 0);
      start.memory.reset();
      const InterfaceProblem::Evaluation fresh = one.problem.evaluate(start);
      TEST_EQUALITY(fresh.applications, 1);
      TEST_COMPARE((derived.dense(*known.residual) - derived.dense(*fresh.residual)).norm(), <, 1e-12 * scale);
      TEST_FLOATING_EQUALITY(known.energy, fresh.energy, 1e-11);
      TEST_EQUALITY(known.changed, fresh.changed);
    }
  }
}

TEUCHOS_UNIT_TEST(ContactInterfaceProblem, PressedBlocks) { agreesWithTheReference(pressedBlocks(), success, out); }
TEUCHOS_UNIT_TEST(ContactInterfaceProblem, SwappedSides) { agreesWithTheReference(swapped(pressedBlocks()), success, out); }
TEUCHOS_UNIT_TEST(ContactInterfaceProblem, InclinedBlocks) { agreesWithTheReference(turned(pressedBlocks(), 0.5), success, out); }
TEUCHOS_UNIT_TEST(ContactInterfaceProblem, NodesHeldOnTheLine) { agreesWithTheReference(heldOnTheLine(), success, out); }
TEUCHOS_UNIT_TEST(ContactInterfaceProblem, StackedBlocks) { agreesWithTheReference(stackedBlocks(2), success, out); }
TEUCHOS_UNIT_TEST(ContactInterfaceProblem, BlocksThatMeetInAPoint) { agreesWithTheReference(crossingBlocks(), success, out); }
TEUCHOS_UNIT_TEST(ContactInterfaceProblem, InclinedBlocksThatMeetInAPoint) {
  agreesWithTheReference(turned(crossingBlocks(), 0.5), success, out);
}

// A law that restricts sliding: closed pairs stick, both components of their nodes are identified.
Scene rough(Scene scene) {
  scene.constraints.laws = ContactLaws(std::vector<std::shared_ptr<const ContactLaw>>(3, std::make_shared<RoughLaw>()));
  return scene;
}

TEUCHOS_UNIT_TEST(ContactInterfaceProblem, RoughBlocks) { agreesWithTheReference(rough(pressedBlocks()), success, out); }
TEUCHOS_UNIT_TEST(ContactInterfaceProblem, RoughInclinedBlocks) {
  agreesWithTheReference(rough(turned(pressedBlocks(), 0.5)), success, out);
}
TEUCHOS_UNIT_TEST(ContactInterfaceProblem, RoughNodesHeldOnTheLine) { agreesWithTheReference(rough(heldOnTheLine()), success, out); }
TEUCHOS_UNIT_TEST(ContactInterfaceProblem, RoughBlocksThatMeetInAPoint) { agreesWithTheReference(rough(crossingBlocks()), success, out); }

TEUCHOS_UNIT_TEST(ContactInterfaceProblem, ASetOfClosedPairsHasNoFriction) {
  const Scene scene = rough(pressedBlocks());
  const OnInterface one(scene, world());
  TEST_ASSERT(one.problem.contact() != nullptr);
  const ClosedSet closed(scene.constraints.pairs.size(), 1);
  for (const ContactStates& status : {one.problem.contact()->statusOf(statesOf(closed)), one.problem.initialState().status})
    for (const ContactState& state : status.front()) TEST_ASSERT(state == ContactState(PairStatus::Slip));
  Scene tied = pressedBlocks();
  tied.constraints.laws = ContactLaws({std::make_shared<Tied>()});
  const OnInterface glued(tied, world());
  const InterfaceState start = glued.problem.initialState();
  for (const ContactState& state : start.status.front()) TEST_ASSERT(state == ContactState(PairStatus::Stick));
}

// Semismooth Newton's choice of the next set, pair by pair: pulling pairs open, penetrating pairs close.
TEUCHOS_UNIT_TEST(ContactInterfaceProblem, OpensWhatPullsAndClosesWhatPenetrates) {
  const OnInterface one(pressedBlocks(), world());
  InterfaceState state = one.problem.stateOf(someValues(one.all), statusOf(7, 1));
  const InterfaceProblem::Evaluation value = one.problem.evaluate(state);
  const std::vector<int> changed = one.problem.differing(state.status, value.next);
  int mine = 0, all = 0;
  for (const PairResult& pair : pairsOf(one.all, one.problem.recover(state))) {
    const bool expected = !pair.state.closed() ? pair.gap < 0.0 : pair.force < 0.0;
    TEST_EQUALITY(std::count(changed.begin(), changed.end(), pair.id) == 1, expected);
    mine += expected;
  }
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  TEST_EQUALITY(all, value.changed);
  TEST_COMPARE(all, >, 0);
  // a resolution coarser than any violation changes nothing
  TEST_EQUALITY(one.problem.evaluate(state, 10.0).changed, 0);
}

}  // namespace
}  // namespace suture
