#include <Teuchos_UnitTestHarness.hpp>
#include <suture/search/UnilateralFoundation.hpp>

#include <random>

#include "PadsInARow.hpp"

namespace {

using namespace suture;
using padsinarow::padsInARow;

TEUCHOS_UNIT_TEST(UnilateralFoundation, DistributesTheForceOfWalls) {
  // The distance between the walls is 0.3 less than the total length of the bodies; pads in series carry equal forces.
  const int bodies = 5;
  const Matrix rows = padsInARow(bodies);
  const Vector stiffness = Vector::LinSpaced(bodies + 1, 1.0, 6.0), work = Vector::Zero(bodies);
  Vector x = work, y = Vector::Constant(bodies + 1, 0.05);
  TEST_ASSERT(UnilateralFoundation(rows, stiffness, work, 0.0).solve(x, y));
  const double force = 0.3 / stiffness.cwiseInverse().sum();
  TEST_COMPARE((y.cwiseProduct(stiffness).array() - force).abs().maxCoeff(), <, 1e-12);
}

TEUCHOS_UNIT_TEST(UnilateralFoundation, MovesUnloadedBodiesApart) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (const int motions : {3, 12, 60}) {
    const Matrix rows = Matrix::NullaryExpr(4 * motions, motions, [&] { return uniform(random); });
    const Vector room = Vector::NullaryExpr(4 * motions, [&] { return std::max(uniform(random), 0.0); });  // half of the pads just touch
    const Vector there = Vector::NullaryExpr(motions, [&] { return uniform(random); });
    const Vector stiffness = Vector::Ones(4 * motions), work = Vector::Zero(motions), start = -rows * there - room;
    Vector x = work, y = start;
    TEST_ASSERT(UnilateralFoundation(rows, stiffness, work, 0.0).solve(x, y));
    TEST_COMPARE(y.maxCoeff(), <, 1e-10 * start.maxCoeff());
    TEST_COMPARE((start + rows * x - y).cwiseAbs().maxCoeff(), <, 1e-12);
  }
}

TEUCHOS_UNIT_TEST(UnilateralFoundation, ReportsALoadThatNoPadStops) {
  const Matrix rows = Matrix::Constant(1, 1, 1.0);
  const Vector stiffness = Vector::Ones(1), away = Vector::Constant(1, -1.0), against = Vector::Constant(1, 1.0);
  Vector x = Vector::Zero(1), y = Vector::Constant(1, 0.5);
  TEST_ASSERT(!UnilateralFoundation(rows, stiffness, away, 1.0).solve(x, y));
  x.setZero(), y.setConstant(-0.5);
  TEST_ASSERT(UnilateralFoundation(rows, stiffness, against, 1.0).solve(x, y));
  TEST_FLOATING_EQUALITY(x(0), 1.5, 1e-12);
}

}  // namespace
