// Shape functions of every cell against their definition: values at the nodes, polynomials, finite differences.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

#include <cmath>

#include <mesh/ReferenceCells.hpp>

using namespace suture;

TEUCHOS_UNIT_TEST(ShapeFunctions, AreOneAtTheirNodeAndZeroAtTheOthers) {
  for (const Cell cell : referencecells::all()) {
    const std::vector<Point> places = referencecells::places(cell);
    TEST_EQUALITY(static_cast<int>(places.size()), cellInfo(cell).nodes);
    for (int k = 0; k < cellInfo(cell).nodes; ++k) {
      TEST_ASSERT(referencePoint(cell, k) == places[k]);
      const std::vector<ShapeJet> jets = referencecells::jets(cell, places[k]);
      for (int i = 0; i < cellInfo(cell).nodes; ++i) TEST_COMPARE(std::abs(jets[i].value - (i == k ? 1 : 0)), <, 1e-15);
    }
  }
}

// A cell of order p contains all polynomials of that degree: 1 (the functions sum to one), x, y, z, and the products of two of them.
TEUCHOS_UNIT_TEST(ShapeFunctions, ReproducePolynomialsOfTheirOrder) {
  std::mt19937 random(3);
  for (const Cell cell : referencecells::all()) {
    const CellInfo& info = cellInfo(cell);
    const std::vector<Point> places = referencecells::places(cell);
    const auto factor = [](int k, const Point& x) { return k < 0 ? 1.0 : x[k]; };
    for (int a = -1; a < info.dimension; ++a)
      for (int b = -1; b < (info.order == 2 ? info.dimension : 0); ++b)
        for (int repeat = 0; repeat < 5; ++repeat) {
          const Point at = referencecells::inside(cell, random);
          const std::vector<ShapeJet> jets = referencecells::jets(cell, at);
          double sum = 0;
          for (int i = 0; i < info.nodes; ++i) sum += jets[i].value * factor(a, places[i]) * factor(b, places[i]);
          TEST_COMPARE(std::abs(sum - factor(a, at) * factor(b, at)), <, 1e-14);
        }
  }
}

TEUCHOS_UNIT_TEST(ShapeFunctions, HaveGradientsThatAgreeWithFiniteDifferences) {
  std::mt19937 random(5);
  const double h = 1e-5;
  for (const Cell cell : referencecells::all())
    for (int repeat = 0; repeat < 5; ++repeat) {
      const Point at = referencecells::inside(cell, random);
      const std::vector<ShapeJet> jets = referencecells::jets(cell, at);
      for (int k = 0; k < cellInfo(cell).dimension; ++k) {
        Point before = at, behind = at;
        before[k] -= h, behind[k] += h;
        const std::vector<ShapeJet> low = referencecells::jets(cell, before), high = referencecells::jets(cell, behind);
        for (int i = 0; i < cellInfo(cell).nodes; ++i)
          TEST_COMPARE(std::abs(jets[i].gradient[k] - (high[i].value - low[i].value) / (2 * h)), <, 1e-8);
      }
      if (cellInfo(cell).dimension == 2)
        for (const ShapeJet& jet : jets) TEST_EQUALITY(jet.gradient[2], 0.0);
    }
}

// Along the axis of a pyramid the functions are linear: those of the base (1 - z) / 4.
TEUCHOS_UNIT_TEST(ShapeFunctions, HaveALimitAtTheApexOfThePyramid) {
  for (const double z : {0.0, 0.5, 1 - 1e-9, 1.0}) {
    const std::vector<ShapeJet> jets = referencecells::jets(Cell::Pyramid5, {0, 0, z});
    for (int i = 0; i < 4; ++i) {
      const Point corner = referencecells::places(Cell::Pyramid5)[i];
      TEST_FLOATING_EQUALITY(1 + jets[i].value, 1 + (1 - z) / 4, 1e-15);
      TEST_COMPARE(norm(minus(jets[i].gradient, {corner[0] / 4, corner[1] / 4, -0.25})), <, 1e-15);
    }
  }
}

TEUCHOS_UNIT_TEST(ShapeFunctions, KnowTheMeanOfTheVertices) {
  for (const Cell cell : referencecells::all()) {
    Point mean{0, 0, 0};
    const int vertices = cellInfo(cell).vertices;
    for (int i = 0; i < vertices; ++i) mean = plus(mean, scaled(1.0 / vertices, referencecells::places(cell)[i]));
    TEST_COMPARE(norm(minus(referenceCentre(cell), mean)), <, 1e-15);
  }
}
