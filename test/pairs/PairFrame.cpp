#include <Teuchos_UnitTestHarness.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <cmath>
#include <random>

using namespace suture;

TEUCHOS_UNIT_TEST(PairFrame, IsOrthonormalAndRightHanded) {
  std::mt19937 generator(5);
  std::vector<Point> normals{{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
  for (int k = 0; k < 50; ++k) {
    Point n{generator() / 2147483647.5 - 1, generator() / 2147483647.5 - 1, generator() / 2147483647.5 - 1};
    const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    normals.push_back({n[0] / length, n[1] / length, n[2] / length});
  }
  for (const Point& n : normals) {
    const std::vector<Point> frame = pairFrame(n, 3);
    TEST_EQUALITY(frame.size(), 3u);
    TEST_ASSERT(frame[0] == n);
    double worst = 0.0, triple = 0.0;
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        double product = 0.0;
        for (int k = 0; k < 3; ++k) product += frame[a][k] * frame[b][k];
        worst = std::max(worst, std::abs(product - (a == b)));
      }
      triple += frame[0][a] * (frame[1][(a + 1) % 3] * frame[2][(a + 2) % 3] - frame[1][(a + 2) % 3] * frame[2][(a + 1) % 3]);
    }
    TEST_COMPARE(worst, <, 1e-15);
    TEST_FLOATING_EQUALITY(triple, 1.0, 1e-14);
  }
  const std::vector<Point> plane = pairFrame(Point{0.6, 0.8, 0}, 2);
  TEST_EQUALITY(plane.size(), 2u);
  TEST_ASSERT((plane[1] == Point{-0.8, 0.6, 0}));
}
