#include <suture/answer/solvability/SharedForces.hpp>

#include <Teuchos_UnitTestHarness.hpp>

namespace {

using namespace suture;

/// A bar on `count` equal supports in a row: only the two sums, of forces and of moments, are determined.
std::vector<ForceColumn> supports(int count) {
  std::vector<ForceColumn> columns;
  for (int i = 0; i < count; ++i) columns.push_back({i, {{0, 1.0}, {1, double(i)}}});
  return columns;
}

const auto allowsAll = [](const Vector&) { return std::vector<ForceCut>(); };

std::vector<ForceCut> noTension(const Vector& forces) {
  std::vector<ForceCut> cuts;
  for (int i = 0; i < forces.size(); ++i)
    if (forces(i) < -1e-12) cuts.push_back({{{i, 1.0}}, 0.0});
  return cuts;
}

TEUCHOS_UNIT_TEST(SharedForces, AreNoneWhereColumnsAreIndependent) {
  TEST_EQUALITY(sharedForces({}).size(), 0u);
  TEST_EQUALITY(sharedForces(supports(2)).size(), 0u);
  TEST_EQUALITY(sharedForces({{0, {{0, 1.0}}}, {1, {{0, 1e-6}, {1, 1e-6}}}}).size(), 0u);  // nearly the same; 1e-6 is left
}

TEUCHOS_UNIT_TEST(SharedForces, AreTheNullSpaceInParts) {
  std::vector<ForceColumn> columns = supports(5);
  for (const ForceColumn& column : supports(3))
    columns.push_back({column.pair + 5, {{column.entries[0].first + 2, 1.0}, {3, column.entries[1].second}}});
  columns.push_back({8, {{4, 2.0}}});
  columns.push_back({9, {}});
  const std::vector<SharedForces> shared = sharedForces(columns);
  TEST_EQUALITY(shared.size(), 3u);
  if (shared.size() != 3u) return;
  TEST_EQUALITY(shared[0].columns.size(), 5u);
  TEST_EQUALITY(shared[0].basis.cols(), 3);
  TEST_COMPARE((shared[0].basis.transpose() * shared[0].basis - Matrix::Identity(3, 3)).norm(), <, 1e-13);
  Matrix sums(2, 5);
  sums << 1, 1, 1, 1, 1, 0, 1, 2, 3, 4;
  TEST_COMPARE((sums * shared[0].basis).norm(), <, 1e-13);
  TEST_EQUALITY(shared[1].columns.size(), 3u);
  TEST_EQUALITY(shared[1].basis.cols(), 1);
  const Vector row = shared[1].basis.col(0) / shared[1].basis(0, 0);
  TEST_COMPARE((row - Vector(Eigen::Vector3d(1, -2, 1))).norm(), <, 1e-13);
  TEST_EQUALITY(shared[2].columns.size(), 1u);  // a pair whose nodes are held
  TEST_EQUALITY(shared[2].columns[0], 9);
}

TEUCHOS_UNIT_TEST(SharedForces, OfOnePairStayTogether) {
  const std::vector<SharedForces> shared = sharedForces({{0, {}}, {0, {}}, {1, {{0, 1.0}}}});
  TEST_EQUALITY(shared.size(), 1u);
  if (shared.size() == 1u) TEST_EQUALITY(shared[0].basis.cols(), 2);
}

TEUCHOS_UNIT_TEST(SharedForces, AreLeastByTheSumOfSquares) {
  const std::vector<SharedForces> shared = sharedForces(supports(4));
  TEST_EQUALITY(shared.size(), 1u);
  if (shared.size() != 1u) return;
  // A load of 4 at 1.5 is shared evenly; of 1 at 1: forces a + b i with 4 a + 6 b = 1 and 6 a + 14 b = 1.
  const Vector even = leastAmplitudes(shared[0], Vector(Eigen::Vector4d(2, 0, 0, 2)), allowsAll);
  TEST_COMPARE((even - Vector::Ones(4)).norm(), <, 1e-13);
  const Vector slanted = leastAmplitudes(shared[0], Vector(Eigen::Vector4d(0, 1, 0, 0)), allowsAll);
  TEST_COMPARE((slanted - Vector(Eigen::Vector4d(0.4, 0.3, 0.2, 0.1))).norm(), <, 1e-13);
}

TEUCHOS_UNIT_TEST(SharedForces, StayWithinTheLaw) {
  const std::vector<SharedForces> shared = sharedForces(supports(4));
  if (shared.size() != 1u) return;
  // A load of 1 at .4: without a law, the support at 3 would have to pull.
  const Vector pulled = leastAmplitudes(shared[0], Vector(Eigen::Vector4d(0.6, 0.4, 0, 0)), allowsAll);
  TEST_COMPARE(pulled.minCoeff(), <, -0.02);
  const Vector pressed = leastAmplitudes(shared[0], Vector(Eigen::Vector4d(0.6, 0.4, 0, 0)), noTension);
  TEST_COMPARE(pressed.minCoeff(), >, -1e-12);
  TEST_COMPARE(std::abs(pressed.sum() - 1.0), <, 1e-13);
  TEST_COMPARE(std::abs(pressed(1) + 2 * pressed(2) + 3 * pressed(3) - 0.4), <, 1e-13);
  // The least force of (1 - m + t, m - 2 t, t, 0) with m = .4 has t = (3 m - 1) / 6: 1/30.
  TEST_COMPARE((pressed - Vector(Eigen::Vector4d(0.6 + 1.0 / 30, 0.4 - 2.0 / 30, 1.0 / 30, 0))).norm(), <, 1e-12);
}

TEUCHOS_UNIT_TEST(SharedForces, StayWithinACone) {
  // One force along each of three axes may be added freely; the law: |(x1, x2)| <= x0, and the given force is (5, 3, 4), at its limit.
  const SharedForces shared{{0, 1, 2}, Matrix(Vector(Eigen::Vector3d(1, 0, 0)))};  // only the first is free: it must not fall below 5
  const auto cone = [](const Vector& x) {
    const double size = std::hypot(x(1), x(2));
    std::vector<ForceCut> cuts;
    if (size > x(0) + 1e-12) cuts.push_back({{{0, 1.0}, {1, -x(1) / size}, {2, -x(2) / size}}, 0.0});
    return cuts;
  };
  TEST_COMPARE((leastAmplitudes(shared, Vector(Eigen::Vector3d(7, 3, 4)), cone) - Vector(Eigen::Vector3d(5, 3, 4))).norm(), <, 1e-11);
  // The second is free as well, from (5, 3, 4): the least has x1 = 0 and x0 = 4.
  Matrix two = Matrix::Zero(3, 2);
  two(0, 0) = two(1, 1) = 1.0;
  TEST_COMPARE((leastAmplitudes({{0, 1, 2}, two}, Vector(Eigen::Vector3d(5, 3, 4)), cone) - Vector(Eigen::Vector3d(4, 0, 4))).norm(), <,
               1e-9);
}

}  // namespace
