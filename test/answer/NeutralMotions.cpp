#include <support/Matrices.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/answer/solvability/NeutralMotions.hpp>

#include <Teuchos_UnitTestHarness.hpp>

namespace {

using namespace suture;
using matrices::rows;

TEUCHOS_UNIT_TEST(NeutralMotions, FindTheLeastVectorInAPolyhedron) {
  const auto least = [](const Matrix& a, std::initializer_list<double> b) {
    return leastDistance(a, Eigen::Map<const Vector>(b.begin(), static_cast<Eigen::Index>(b.size())));
  };
  TEST_COMPARE((least(rows({{1, 1}}), {1}) - Vector::Constant(2, 0.5)).norm(), <, 1e-14);                  // foot of the perpendicular
  TEST_COMPARE((least(rows({{1, 1}, {1, 0}}), {1, 2}) - 2 * Vector::Unit(2, 0)).norm(), <, 1e-14);         // only the second counts
  TEST_COMPARE((least(rows({{1, 1}, {1, 0}}), {3, 2}) - Vector(Eigen::Vector2d(2, 1))).norm(), <, 1e-13);  // a corner
  TEST_COMPARE((least(rows({{1, 1}}), {-1})).norm(), <, 1e-300);                                           // zero is in it
  TEST_COMPARE((least(rows({{1, 1}, {1, 0}}), {3e9, 2e9}) - 1e9 * Vector(Eigen::Vector2d(2, 1))).norm(), <, 1e-3);
}

TEUCHOS_UNIT_TEST(NeutralMotions, RefuseLoadedBodiesThatAreFreeInBothSensesOnly) {
  NeutralMotion motion{"wheel", "turn about (0, 0), counterclockwise", true, true};
  TEST_ASSERT(undetermined({motion}).find("body 'wheel' can turn about (0, 0), counterclockwise") == 0);
  TEST_ASSERT(undetermined({motion}).find("Outer Solver/Neutral Motions = Least") != std::string::npos);
  motion.loaded = false;
  TEST_ASSERT(undetermined({motion}).empty());
  TEST_ASSERT(inWords(motion).find("no force acts on it") != std::string::npos);
  motion.loaded = true;
  motion.bothSenses = false;
  TEST_ASSERT(undetermined({motion}).empty());
}

}  // namespace
