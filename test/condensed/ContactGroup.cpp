#include <Teuchos_UnitTestHarness.hpp>
#include <condensed/GroupScenes.hpp>

namespace suture {
namespace {

using namespace blocks;

int openPairs(const std::vector<ContactState>& status) { return int(std::count(status.begin(), status.end(), kOpen)); }

TEUCHOS_UNIT_TEST(ContactGroup, IsAllThatTouchesThePiece) {
  const GroupOf g(wavyBlocks());
  TEST_EQUALITY(g.members.size(), 4u);
  TEST_EQUALITY(g.group->rows().size(), 7);
  TEST_EQUALITY(g.size(), 2 * 2 * 7);  // two lines of seven nodes
  TEST_EQUALITY(g.group->dofs(), 2 * 2 * 7 * 3);
  TEST_EQUALITY(g.group->idlePairs().size(), 0u);
}

// Each answer against the conditions that define it, in Cartesian displacements.
TEUCHOS_UNIT_TEST(ContactGroup, AnswersWithTheSolutionOfItsContactProblem) {
  const GroupOf g(wavyBlocks());
  int mixed = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    const Vector trace = 0.05 * random(g.size(), 1, seed).col(0);
    const ContactGroup::Response r = g.respond(trace);
    auto u = g.displacements(r);
    for (int p = 0; p < g.group->rows().size(); ++p) {
      const double gap = GroupOf::gapOf(g.group->pairs()[p], u);
      TEST_COMPARE(gap, >, -1e-12);
      TEST_COMPARE(r.force(p), >, -1e-10);
      TEST_COMPARE(std::abs(gap * r.force(p)), <, 1e-12);
    }
    // equilibrium inside: K u - f + N^T force = 0, on the boundary the flux
    Vector residual = g.group->stiffness() * r.displacement + g.group->rows().rows.transpose() * r.force;
    for (std::size_t m = 0; m < g.members.size(); ++m)
      for (int i = 0; i < g.members[m]->dofs(); ++i) residual(g.group->positionsOf(int(m))[i]) -= g.members[m]->load()(i);
    TEST_COMPARE(rowsAt(residual, g.group->interiorPositions()).norm(), <, 1e-11);
    TEST_COMPARE(difference(r.flux, rowsAt(residual, g.group->boundaryPositions())), <, 1e-11);
    mixed += openPairs(r.status) > 0 && openPairs(r.status) < 7;
    // from any initial status
    const ContactGroup::Response other = g.group->respond(trace, g.status(kOpen));
    TEST_ASSERT(other.status == r.status);
    TEST_COMPARE(difference(other.flux, r.flux), <, 1e-11);
  }
  TEST_COMPARE(mixed, >=, 4);
}

TEUCHOS_UNIT_TEST(ContactGroup, RespondsWithAMonotoneFlux) {
  const GroupOf g(wavyBlocks());
  for (unsigned seed = 1; seed <= 10; ++seed)
    for (double distance : {1e-4, 1e-1}) {
      const Vector u = 0.05 * random(g.size(), 1, seed).col(0), d = distance * random(g.size(), 1, seed + 100).col(0);
      const Vector difference = g.respond(u + d).flux - g.respond(u).flux;
      TEST_COMPARE(difference.dot(d), >, 0.0);
    }
}

TEUCHOS_UNIT_TEST(ContactGroup, FluxIsTheGradientOfItsEnergy) {
  const GroupOf g(wavyBlocks());
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Vector u = 0.05 * random(g.size(), 1, seed).col(0), d = random(g.size(), 1, seed + 100).col(0);
    const double h = 1e-6;
    const double slope = (g.respond(u + h * d).energy - g.respond(u - h * d).energy) / (2 * h);
    const double expected = g.respond(u).flux.dot(d);
    TEST_COMPARE(std::abs(slope - expected), <, 1e-6 * g.respond(u).flux.norm() * d.norm());
  }
}

TEUCHOS_UNIT_TEST(ContactGroup, DoesNotDependOnTheAxesOfContactNodes) {
  const Scene scene = wavyBlocks();
  Scene turned = scene;
  for (const ContactPair& pair : scene.constraints.pairs)
    for (int node : {pair.ends[0].node, pair.ends[1].node}) turned.ruleOf(node).axes = {Point{0, 1, 0}, Point{-1, 0, 0}, Point{0, 0, 1}};
  const GroupOf a(scene), b(turned);
  const Vector trace = 0.05 * random(a.size(), 1).col(0);
  TEST_ASSERT(a.group->boundary() == b.group->boundary());
  TEST_EQUALITY(b.group->rows().rows.nonZeros(), 2 * 7);  // one coefficient per side
  const auto ra = a.respond(trace), rb = b.respond(trace);
  TEST_COMPARE(difference(rb.flux, ra.flux), <, 1e-12);
  TEST_COMPARE(difference(rb.force, ra.force), <, 1e-11);
  TEST_FLOATING_EQUALITY(rb.energy, ra.energy, 1e-12);
}

TEUCHOS_UNIT_TEST(ContactGroup, TakesWhatPrescribedComponentsCloseFromTheGap) {
  Scene scene = wavyBlocks();
  for (ContactPair& pair : scene.constraints.pairs) pair.normal = {0.6, 0.8, 0};
  scene.hold("upper_left", 0, -0.03);  // the first pair: a component of one side
  scene.hold("lower_right", 1, 0.02);  // the last pair
  const int first = scene.constraints.pairs.front().ends[1].node;
  const GroupOf g(scene);
  TEST_EQUALITY((Matrix(g.group->rows().rows).row(0).array() != 0.0).count(), 3);
  int mixed = 0;
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const Vector u = 0.05 * random(g.size(), 1, seed).col(0), d = random(g.size(), 1, seed + 100).col(0);
    const auto r = g.respond(u);
    auto moved = g.displacements(r);
    TEST_FLOATING_EQUALITY(moved[first][0], -0.03, 1e-14);
    for (int p = 0; p < g.group->rows().size(); ++p) {
      const double gap = GroupOf::gapOf(g.group->pairs()[p], moved);
      TEST_COMPARE(gap, >, -1e-12);
      TEST_COMPARE(std::abs(gap * r.force(p)), <, 1e-12);
    }
    mixed += r.status.front() != kOpen || r.status.back() != kOpen;
    const double h = 1e-6, slope = (g.respond(u + h * d).energy - g.respond(u - h * d).energy) / (2 * h);
    TEST_COMPARE(std::abs(slope - r.flux.dot(d)), <, 1e-6 * r.flux.norm() * d.norm());
  }
  TEST_COMPARE(mixed, >, 0);
}

TEUCHOS_UNIT_TEST(ContactGroup, LeavesOutPairsThatNothingCanMove) {
  Scene scene = wavyBlocks();
  scene.hold("upper_left", 1, 0.0);
  scene.hold("lower_left", 1, 0.0);
  const GroupOf g(scene);
  TEST_EQUALITY(g.group->rows().size(), 6);
  TEST_EQUALITY(g.group->idlePairs().size(), 1u);
  TEST_EQUALITY(g.group->idlePairs()[0].id, scene.constraints.pairs.front().id);
}

TEUCHOS_UNIT_TEST(ContactGroup, HoldsABodyByContactAlone) {
  std::vector<Box> all(2);
  all[0].name = "lower";
  all[1].name = "upper";
  all[0].y0 = -1;
  all[0].y1 = 0;
  all[0].nx = all[1].nx = 4;
  all[0].ny = all[1].ny = 4;
  all[0].blocksY = 2;  // the upper body is one subdomain, held by contact only
  Scene scene = scenes::fromBoxes(all, 100.0, 0.3);
  scene.pairUp();
  scene.holdNode(scene.constraints.pairs[2].ends[1].node, 0, 0.0);  // nor may it slide
  scene.pressure("upper_top", 2.0);
  const GroupOf g(scene);
  const auto r = g.respond(Vector::Zero(g.size()));
  TEST_FLOATING_EQUALITY(r.force.sum(), 2.0, 1e-11);  // the pressure on a side of length one
  TEST_EQUALITY(openPairs(r.status), 0);
  Vector lift = Vector::Zero(g.size());
  for (int i = 1; i < g.size(); i += 2) lift(i) = 0.3;  // the lower body is moved up as a whole: so is the upper one, and no force changes
  const auto lifted = g.respond(lift);
  TEST_COMPARE(difference(lifted.force, r.force), <, 1e-10);
  TEST_COMPARE((lifted.flux - r.flux).norm(), <, 1e-10 * r.flux.norm());
  TEST_THROW(LinearisedGroup(1, *g.group, g.status(kOpen)), NumericalError);
}

}  // namespace
}  // namespace suture
