#include <Teuchos_UnitTestHarness.hpp>
#include <suture/search/FrictionCone.hpp>

#include <algorithm>
#include <cmath>
#include <random>

namespace {

using namespace suture;
using Force = FrictionCone::Force;

bool holds(const FrictionCone& cone, const Force& force, double digits) {
  return force(0) >= -digits && std::hypot(force(1), force(2)) <= cone.bound + cone.friction * force(0) + digits;
}

TEUCHOS_UNIT_TEST(FrictionCone, ProjectsOntoTheNearestForce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  double worst = 0.0;
  for (const FrictionCone& cone : {FrictionCone{}, FrictionCone{0.3, 0.0}, FrictionCone{0.0, 0.6}, FrictionCone{0.2, 1.5}})
    for (int trial = 0; trial < 200; ++trial) {
      const Force z(value(random), value(random), value(random)), nearest = cone.project(z);
      TEST_ASSERT(holds(cone, nearest, 1e-14));
      for (int other = 0; other < 50; ++other) {
        Force q(std::abs(value(random)), value(random), value(random));
        const double size = q.tail<2>().norm(), most = cone.bound + cone.friction * q(0);
        if (size > most) q.tail<2>() *= most / size;
        worst = std::max(worst, (z - nearest).dot(q - nearest));
      }
    }
  TEST_COMPARE(worst, <, 1e-14);
}

TEUCHOS_UNIT_TEST(FrictionCone, HasTheDerivativeOfItsProjection) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  const double step = 1e-6;
  int compared = 0;
  for (const FrictionCone& cone : {FrictionCone{}, FrictionCone{0.3, 0.0}, FrictionCone{0.0, 0.6}, FrictionCone{0.2, 1.5}})
    for (int trial = 0; trial < 300; ++trial) {
      const Force z(value(random), value(random), value(random));
      FrictionCone::Derivative exact, right, left;
      cone.project(z, &exact);
      for (int k = 0; k < 3; ++k) {
        right.col(k) = (cone.project(z + step * Force::Unit(k)) - cone.project(z)) / step;
        left.col(k) = (cone.project(z) - cone.project(z - step * Force::Unit(k))) / step;
      }
      if ((right - left).norm() > 1e-3) continue;  // a kink within the step
      ++compared;
      TEST_COMPARE((exact - 0.5 * (right + left)).norm(), <, 1e-4);
    }
  TEST_COMPARE(compared, >, 800);
}

}  // namespace
