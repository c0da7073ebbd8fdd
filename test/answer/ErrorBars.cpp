// Bars of forces: hand-made supports and pairs, on several ranks.
#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/answer/values/ErrorBars.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include <cmath>

namespace suture {
namespace {

Support support(int node, int condition, const Point& direction) {
  Support one;
  one.node = node, one.condition = condition;
  one.direction = one.along = direction;
  return one;
}

ContactRow rowAt(int node, int line, const Point& normal) {
  ContactRow row;
  row.pair.line = line;
  row.pair.ends = {{node, 1.0}};
  row.pair.normal = normal;
  return row;
}

/// A bar of `largest` 100 without other errors than 10 % in the energy norm.
double barOf(const ErrorBars& bars, int condition) { return bars.ofCondition(condition, 100); }

// At node 40 conditions 0 and 1 hold x, at node 41 conditions 2 and 3 hold directions that are perpendicular to each other; condition 4
// holds a node of contact 1 along its normal, condition 2 one of contact 0 along its tangent.
TEUCHOS_UNIT_TEST(ErrorBars, AreOfFirstOrderWhereForcesShareNodes) {
  const auto comm = Teuchos::DefaultComm<int>::getComm();
  std::vector<SubdomainMesh> meshes;
  if (comm->getRank() == comm->getSize() - 1) {
    SubdomainMesh mesh;
    mesh.globalNodes = {40, 41, 42};
    mesh.supports = {support(0, 0, {1, 0, 0}), support(0, 1, {0.6, 0.8, 0}), support(1, 2, {1, 0, 0}), support(1, 3, {0, 1, 0}),
                     support(2, 4, {0, 1, 0})};
    mesh.contactRows = {rowAt(42, 1, {0, 1, 0}), rowAt(41, 0, {0, 0, 1})};
    meshes.push_back(mesh);
  }
  ErrorBars bars;
  bars.discretisation = 0.1;
  findSharedNodes(*comm, meshes, bars);
  TEST_ASSERT(bars.sharedConditions == (std::vector<int>{0, 1, 4}));
  TEST_ASSERT(bars.sharedContacts == std::vector<int>{1});
  for (const int condition : {0, 1, 4}) TEST_FLOATING_EQUALITY(barOf(bars, condition), ErrorBars::kLinear * 10, 1e-14);
  for (const int condition : {2, 3, -1}) TEST_FLOATING_EQUALITY(barOf(bars, condition), ErrorBars::kSquare * 1, 1e-14);
  TEST_FLOATING_EQUALITY(bars.ofContact(0, 100), ErrorBars::kSquare * 1, 1e-14);
  TEST_FLOATING_EQUALITY(bars.ofContact(1, 100), ErrorBars::kLinear * 10, 1e-14);
  bars.algebraic = 0.01;
  TEST_FLOATING_EQUALITY(bars.ofContact(0, 100), ErrorBars::kSquare * 1 + 1, 1e-14);
}

PairResult pairWith(int id, double angle, bool isClosed) {
  PairResult pair;
  pair.id = id;
  pair.normal = {std::sin(angle), std::cos(angle), 0};
  pair.state.status = isClosed ? PairStatus::Slip : PairStatus::Open;
  return pair;
}

TEUCHOS_UNIT_TEST(ErrorBars, KnowTheTurningOfClosedSides) {
  ContactPiece piece;
  piece.pairs = {4, 5, 6, 7};
  piece.cells = {{4, 5}, {5, 6}, {6, 7}};
  const auto turning = [&](bool isLastClosed) {
    return largestTurning({piece},
                          {pairWith(4, 0, true), pairWith(5, 0.01, true), pairWith(6, 0.03, false), pairWith(7, 0.33, isLastClosed)});
  };
  TEST_FLOATING_EQUALITY(turning(false), 0.02, 1e-12);
  TEST_FLOATING_EQUALITY(turning(true), 0.3, 1e-12);
  TEST_EQUALITY(largestTurning({}, {}), 0);
}

}  // namespace
}  // namespace suture
