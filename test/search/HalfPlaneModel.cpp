#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/search/DelassusProblem.hpp>
#include <suture/search/HalfPlaneModel.hpp>
#include <suture/search/StateSearch.hpp>

namespace suture {
namespace {

constexpr double kModulus = 2.0, kRadius = 50.0, kSpacing = 0.05, kNormalOfNode = 0.8;

/// A parabola pressed into a half-plane by an approach, pairs at equal distances; displacements are Flamant's solution for hat functions of
/// pressure, relative to a far point.
struct Parabola {
  int pairs;
  double approach;
  Matrix compliance;
  RigidBodyModel rigid;

  Parabola(int n, double depth) : pairs(n), approach(depth), compliance(n, n), rigid(data(n)) {
    const double unit = 2.0 / (M_PI * kModulus);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) compliance(i, j) = unit * (std::log(4.0 * n) + (i == j ? 1.5 : -std::log(std::abs(i - j))));
  }
  static RigidBodyModel::Pairs data(int n) {
    const double stiffness = kNormalOfNode * M_PI * kModulus / 2.0;
    return {SparseRows(n, 0),       Vector(0),
            Vector::Zero(n),        Vector::Constant(n, stiffness),
            std::vector<int>(n, 0), std::vector<std::vector<int>>(),
            std::vector<char>(n, 1)};
  }
  double overlap(int i) const {
    const double x = kSpacing * (i - 0.5 * (pairs - 1));
    return approach - x * x / (2.0 * kRadius);
  }
  /// Forces of a closed set, and penetrations of the other pairs.
  std::pair<Vector, Vector> solve(const ClosedSet& closed) const {
    std::vector<int> at;
    Vector overlaps(pairs), force = Vector::Zero(pairs);
    for (int i = 0; i < pairs; ++i) {
      overlaps(i) = overlap(i);
      if (closed[i]) at.push_back(i);
    }
    force(at) = solvePositive(compliance(at, at), Vector(overlaps(at)));
    Vector penetration = overlaps - compliance * force;
    for (const int i : at) penetration(i) = 0.0;
    return {force, penetration};
  }
};

ClosedSet middle(int pairs, int closed) {
  ClosedSet set(pairs, 0);
  for (int i = (pairs - closed) / 2; i < (pairs + closed) / 2; ++i) set[i] = 1;
  return set;
}

// From a zone that is far too wide or too narrow the model converges to Hertz: a^2 = 4 P R / (pi E*).
TEUCHOS_UNIT_TEST(HalfPlaneModel, FindsTheHalfWidthOfHertz) {
  const int n = 40;
  const Parabola scene(n, 0.02);
  for (const int start : {n, 30, 4}) {
    const ClosedSet closed = middle(n, start);
    const auto [force, penetration] = scene.solve(closed);
    ClosedSet flipped = closed;
    for (int i = 0; i < n; ++i) flipped[i] = closed[i] ? force(i) > 0.0 : penetration(i) > 0.0;
    const ClosedSet found = HalfPlaneModel(scene.rigid).closedSet(closed, flipped, force, penetration);
    const auto [pressing, open] = scene.solve(found);
    TEST_COMPARE(pressing.minCoeff(), >=, 0.0);
    TEST_COMPARE(open.maxCoeff(), <=, 1e-12);
    const double width = std::sqrt(4.0 * pressing.sum() * kRadius / (M_PI * kModulus));
    const int closedPairs = static_cast<int>(std::count(found.begin(), found.end(), 1));
    TEST_COMPARE(std::abs(0.5 * closedPairs * kSpacing - width), <=, kSpacing);
    TEST_COMPARE(closedPairs, >, 8);
    TEST_COMPARE(closedPairs, <, n - 4);
  }
}

// Pairs far from the ends, and those of other lines, do not change.
TEUCHOS_UNIT_TEST(HalfPlaneModel, ChangesNothingFarFromTheEnds) {
  RigidBodyModel::Pairs data = Parabola::data(200);
  for (int i = 100; i < 200; ++i) data.line[i] = 1;
  const RigidBodyModel rigid(data);
  ClosedSet closed(200, 1);
  Vector force = Vector::Constant(200, 1.0), penetration = Vector::Zero(200);
  force(99) = -0.5;
  ClosedSet flipped = closed;
  flipped[99] = 0;
  const ClosedSet found = HalfPlaneModel(rigid).closedSet(closed, flipped, force, penetration);
  TEST_EQUALITY(static_cast<int>(found[99]), 0);
  for (int i = 0; i < 70; ++i) TEST_EQUALITY(static_cast<int>(found[i]), 1);
  for (int i = 100; i < 200; ++i) TEST_EQUALITY(static_cast<int>(found[i]), 1);
}

// Where signs change along a whole line, no end of a zone is known: the signs are used unchanged.
TEUCHOS_UNIT_TEST(HalfPlaneModel, LeavesLongStretchesToTheSigns) {
  for (const int n : {300, 1000}) {
    const RigidBodyModel rigid(Parabola::data(n));
    const ClosedSet closed(n, 1);
    ClosedSet flipped = closed;
    Vector force = Vector::Constant(n, 1.0);
    for (int i = 0; i < n; i += 10) flipped[i] = 0, force(i) = -20.0;  // their neighbours would open with them
    TEST_EQUALITY(HalfPlaneModel(rigid).closedSet(closed, flipped, force, Vector::Zero(n)) == flipped, n == 1000);
  }
}

// 3D bodies are no half-planes: the signs decide.
TEUCHOS_UNIT_TEST(HalfPlaneModel, LeavesSurfacesToTheSigns) {
  const Parabola scene(40, 0.02);
  RigidBodyModel::Pairs data = Parabola::data(40);
  data.surfaces = true;
  const ClosedSet closed(40, 1);
  const auto [force, penetration] = scene.solve(closed);
  ClosedSet flipped = closed;
  for (int i = 0; i < 40; ++i) flipped[i] = force(i) > 0.0;
  TEST_ASSERT(HalfPlaneModel(RigidBodyModel(data)).closedSet(closed, flipped, force, penetration) == flipped);
  TEST_ASSERT(HalfPlaneModel(scene.rigid).closedSet(closed, flipped, force, penetration) != flipped);
}

// From all pairs closed, the search needs fewer solves with the model than without.
TEUCHOS_UNIT_TEST(HalfPlaneModel, SavesSolvesOfTheSearch) {
  const int n = 200;
  Parabola scene(n, 0.05);
  Vector overlaps(n);
  for (int i = 0; i < n; ++i) overlaps(i) = scene.overlap(i);
  DelassusProblem problem(scene.rigid, scene.compliance, overlaps, {});
  const PairStates all(n, PairStatus::Slip);
  StateSearch plain(scene.rigid, problem, 100), predicting(scene.rigid, problem, 100);
  plain.withoutPrediction();
  const StateSearch::Result without = plain.run(all), with = predicting.run(all);
  out << "solves " << with.solves << " with the model, " << without.solves << " without\n";
  TEST_ASSERT(with.converged && without.converged);
  TEST_ASSERT(with.states == without.states);
  TEST_COMPARE(with.solves, <, without.solves);
}

}  // namespace
}  // namespace suture
