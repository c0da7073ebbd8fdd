#include <suture/search/DelassusProblem.hpp>
#include <suture/search/HalfPlaneModel.hpp>
#include <suture/search/StateSearch.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {
constexpr int kReach = 24;  // pairs on each side of a changing pair
constexpr int kMostPadSolves = 60;
constexpr double kSelf = 1.5;     // -ln of the distance, in mesh sizes, averaged over a hat function of pressure around its centre
constexpr double kShare = 0.8;    // 2 / (pi E*) times the stiffness of one node, measured: .5 to 1.2 work equally well
constexpr double kLeast = 1e-11;  // relative to the largest force
// Maximum number of pairs of a window. If signs change along a longer stretch, the ends of contact zones are not yet known, and the dense
// matrices of the model take longer than linear solves (2,000 pairs: 2 s).
constexpr int kMostPairs = 400;

/// Solves for the pairs first..last-1 of one line, without the others of the scene.
ClosedSet solveWindow(const RigidBodyModel& rigid, int first, int last, const Vector& force, const Vector& penetration) {
  const int n = last - first;
  const Vector local = kShare * rigid.data().stiffness.segment(first, n).cwiseInverse();
  const double far = std::log(4.0 * n);
  Matrix compliance(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) compliance(i, j) = std::sqrt(local(i) * local(j)) * (far + (i == j ? kSelf : -std::log(std::abs(i - j))));
  const Vector open = penetration.segment(first, n) + compliance * force.segment(first, n);
  RigidBodyModel::Pairs pairs{SparseRows(n, 0), Vector(0), open, rigid.data().stiffness.segment(first, n), std::vector<int>(n, 0), {}, {}};
  pairs.canChange.assign(rigid.data().canChange.begin() + first, rigid.data().canChange.begin() + last);
  RigidBodyModel pads(std::move(pairs));
  DelassusProblem problem(pads, compliance, open, {});
  PairStates start(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i)
    if (pads.data().canChange[i] && (force(first + i) > 0.0 || penetration(first + i) > 0.0)) start[i] = PairStatus::Slip;
  StateSearch search(pads, problem, kMostPadSolves);
  search.withoutPrediction();
  const StateSearch::Result result = search.run(start);
  if (!result.converged) return {};
  const double least = kLeast * result.normal.maxCoeff();
  ClosedSet closed(n, 0);
  for (int i = 0; i < n; ++i) closed[i] = result.normal(i) > least;
  return closed;
}

}  // namespace

ClosedSet HalfPlaneModel::closedSet(const ClosedSet& closed, const ClosedSet& flipped, const Vector& force,
                                    const Vector& penetration) const {
  if (rigid_.data().surfaces) return flipped;  // the half-plane solution is 2D
  const std::vector<int>& line = rigid_.data().line;
  const int pairs = rigid_.pairs();
  ClosedSet set = flipped;
  int last = 0;
  for (int i = 0; i < pairs; ++i) {
    if (flipped[i] == closed[i] || i < last) continue;
    int first = i;
    while (first > last && i - first < kReach && line[first - 1] == line[i]) --first;
    int most = i;
    for (last = i + 1; last < pairs && last - most <= kReach && line[last] == line[i]; ++last)
      if (flipped[last] != closed[last]) most = last;
    if (last - first > kMostPairs) continue;
    const ClosedSet window = solveWindow(rigid_, first, last, force, penetration);
    if (!window.empty()) std::copy(window.begin(), window.end(), set.begin() + first);
  }
  return set;
}

}  // namespace suture
