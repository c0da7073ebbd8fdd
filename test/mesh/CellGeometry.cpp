#include <suture/mesh/CellGeometry.hpp>

#include <Eigen/LU>
#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <random>

#include <mesh/ReferenceCells.hpp>

using namespace suture;

namespace {

const std::vector<Point> sound{{2, 0.5, 0.1}, {1, 3, -0.4}, {0.3, -0.2, 1.5}};
const std::vector<Point> identity{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

CellBlock drawn(Cell cell) { return referencecells::image(cell, identity); }

double determinant(int dimension, const std::vector<Point>& columns) {
  if (dimension == 2) return columns[0][0] * columns[1][1] - columns[0][1] * columns[1][0];
  return dot(columns[0], cross(columns[1], columns[2]));
}

void bend(CellBlock& block, double most, std::mt19937& random) {
  for (double& x : block.coordinates) x += (random() / 4294967296.0 - 0.5) * 2 * most;
}

/// The map of one element as a combination of monomials through its nodes, and the least determinant on a fine grid: independent of the
/// code.
class Sampled {
 public:
  explicit Sampled(Cell cell) : cell_(cell), dimension_(dimensionOf(cell)) {
    const std::vector<Point> nodes = referencecells::places(cell);
    for (const Point& p : nodes) add(p);
    nodes_ = static_cast<int>(nodes.size());
    const int n = dimension_ == 2 ? 50 : 12;
    const auto place = [&](int i) { return 2.0 * i / n - 1; };
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        for (int k = 0; k <= (dimension_ == 2 ? 0 : n); ++k) {
          if (isSimplex(cell) && i + j + k > n) continue;
          if (cell == Cell::Wedge6 && i + j > n) continue;
          const double c = double(k) / n;
          if (isSimplex(cell))
            add({double(i) / n, double(j) / n, c});
          else if (cell == Cell::Wedge6)
            add({double(i) / n, double(j) / n, place(k)});
          else if (cell == Cell::Pyramid5)
            add({place(i) * (1 - c) * (1 - 1e-9), place(j) * (1 - c) * (1 - 1e-9), c * (1 - 1e-9)});  // off the apex
          else
            add({place(i), place(j), dimension_ == 2 ? 0 : place(k)});
        }
    const int count = static_cast<int>(places_.size());
    for (Matrix& m : functions_) m.resize(count, nodes_);
    for (int q = 0; q < count; ++q)
      for (int i = 0; i < nodes_; ++i) {
        const Jet jet = function(i, places_[q]);
        for (int k = 0; k < 4; ++k) functions_[k](q, i) = jet[k];
      }
    toPowers_ = functions_[0].topRows(nodes_).fullPivLu().inverse();
  }

  double least = 0, leastAtNodes = 0, largest = 0;
  Point place{0, 0, 0};

  void sample(const CellBlock& block) {
    Matrix x(nodes_, 3);
    for (int i = 0; i < nodes_; ++i) x.row(i) << block.point(i)[0], block.point(i)[1], block.point(i)[2];
    const Matrix c = toPowers_ * x, at = functions_[0] * c, by[] = {functions_[1] * c, functions_[2] * c, functions_[3] * c};
    least = leastAtNodes = 1e300, largest = 0;
    for (int q = 0; q < at.rows(); ++q) {
      std::vector<Point> columns;
      for (const Matrix& slope : by) columns.push_back({slope(q, 0), slope(q, 1), slope(q, 2)});
      const double d = determinant(dimension_, columns);
      if (q < nodes_) leastAtNodes = std::min(leastAtNodes, d);
      if (d < least) least = d, place = {at(q, 0), at(q, 1), at(q, 2)};
      largest = std::max(largest, std::abs(d));
    }
  }

 private:
  using Jet = std::array<double, 4>;  // value, derivatives

  void add(const Point& place) { places_.push_back(place); }

  /// A product of powers of the coordinates; for a pyramid also x y / (1 - z).
  Jet function(int i, const Point& p) const {
    if (cell_ == Cell::Pyramid5 && i == 4) {
      const double below = std::max(1 - p[2], 1e-12);
      return {p[0] * p[1] / below, p[1] / below, p[0] / below, p[0] * p[1] / (below * below)};
    }
    const std::array<int, 3> power = powers()[i];
    Jet jet{1, 1, 1, 1};
    for (int k = 0; k < 3; ++k)
      for (int d = 0; d < 4; ++d)
        jet[d] *= d == k + 1 ? (power[k] == 0 ? 0 : power[k] * std::pow(p[k], power[k] - 1)) : std::pow(p[k], power[k]);
    return jet;
  }
  /// Powers in each coordinate: of total degree p in simplices, at most p in each coordinate otherwise; in cells without nodes inside their
  /// sides only one of them is squared (serendipity).
  std::vector<std::array<int, 3>> powers() const {
    const CellInfo& info = cellInfo(cell_);
    const bool serendipity = cell_ == Cell::Quadrilateral8 || cell_ == Cell::Hexahedron20;
    std::vector<std::array<int, 3>> all;
    for (int a = 0; a <= info.order; ++a)
      for (int b = 0; b <= info.order; ++b)
        for (int c = 0; c <= (dimension_ == 3 ? info.order : 0); ++c) {
          if (isSimplex(cell_) && a + b + c > info.order) continue;
          if (cell_ == Cell::Wedge6 && a + b > 1) continue;
          if (cell_ == Cell::Pyramid5 && a + b + c > 1) continue;
          if (serendipity && (a == 2) + (b == 2) + (c == 2) > 1) continue;
          all.push_back({a, b, c});
        }
    return all;
  }

  Cell cell_;
  int dimension_, nodes_ = 0;
  std::vector<Point> places_;  // nodes first
  Matrix functions_[4], toPowers_;
};

}  // namespace

TEUCHOS_UNIT_TEST(CellGeometry, HasTheDeterminantOfAnAffineMapInEveryCell) {
  std::vector<Point> mirrored = sound, flat = sound;
  mirrored[1] = scaled(-1, mirrored[1]);
  flat[1] = scaled(2, flat[0]);
  for (const Cell cell : referencecells::all()) {
    const double expected = determinant(dimensionOf(cell), sound);
    TEST_FLOATING_EQUALITY(smallestJacobian(referencecells::image(cell, sound), 0), expected, 1e-13);
    TEST_FLOATING_EQUALITY(smallestJacobian(referencecells::image(cell, mirrored), 0), -expected, 1e-13);
    TEST_COMPARE(std::abs(smallestJacobian(referencecells::image(cell, flat), 0)), <, 1e-13);
  }
}

TEUCHOS_UNIT_TEST(CellGeometry, MeasuresTheSizeOfEveryCell) {
  for (const Cell cell : referencecells::all()) {
    const CellBlock block = referencecells::image(cell, sound);
    TEST_FLOATING_EQUALITY(signedSize(block, 0), determinant(dimensionOf(cell), sound) * referencecells::size(cell), 1e-13);
    Point mean{0, 0, 0};
    double diameter = 0;
    const int vertices = cellInfo(cell).vertices;
    for (int i = 0; i < vertices; ++i) {
      mean = plus(mean, scaled(1.0 / vertices, block.point(i)));
      for (int k = 0; k < vertices; ++k) diameter = std::max(diameter, norm(minus(block.point(i), block.point(k))));
    }
    TEST_COMPARE(norm(minus(centreOf(block, 0), mean)), <, 1e-14);
    TEST_FLOATING_EQUALITY(diameterOf(block, 0), diameter, 1e-14);
  }
}

TEUCHOS_UNIT_TEST(CellGeometry, SeesAMidSideNodeThatFoldsTheElement) {
  for (const auto& [cell, middle] : {std::pair(Cell::Triangle6, 3), {Cell::Tetrahedron10, 4}}) {
    CellBlock block = drawn(cell);
    TEST_COMPARE(smallestJacobian(block, 0), >, 0.9);
    block.coordinates[std::size_t(block.dimension) * middle] = 7 + 0.8;  // the middle of the first side, moved beyond three quarters of it
    TEST_COMPARE(smallestJacobian(block, 0), <, -0.1);
  }
}

TEUCHOS_UNIT_TEST(CellGeometry, FindsTheLeastDeterminantOfCurvedElementsBetweenTheirNodes) {
  std::mt19937 random(1);
  for (const Cell cell : {Cell::Triangle6, Cell::Quadrilateral8, Cell::Quadrilateral9}) {
    Sampled sampled(cell);
    int hidden = 0;  // elements that are valid at all nodes and folded between them
    for (int k = 0; k < 300; ++k) {
      CellBlock block = drawn(cell);
      bend(block, 0.4, random);
      sampled.sample(block);
      Point place;
      const double least = smallestJacobian(block, 0, &place);
      TEST_COMPARE(std::abs(least - sampled.least), <, 0.02);
      TEST_COMPARE(norm(minus(place, sampled.place)), <, 0.1);
      hidden += sampled.leastAtNodes > 0 && least < 0 && sampled.least < 0;
    }
    out << cellInfo(cell).name << ": " << hidden << " of 300 folded between sound nodes\n";
    TEST_COMPARE(hidden, >, 0);
  }
}

// In 3D the grid is coarse: its least value exceeds the true one by little more than the square of a step.
TEUCHOS_UNIT_TEST(CellGeometry, FindsTheLeastDeterminantOfBentCellsIn3D) {
  std::mt19937 random(7);
  for (const Cell cell : referencecells::solid) {
    Sampled sampled(cell);
    int folded = 0;
    double apart = 0;
    for (int k = 1; k <= 60; ++k) {
      CellBlock block = drawn(cell);
      bend(block, (cellInfo(cell).order == 2 ? 0.005 : 0.02) * k, random);
      sampled.sample(block);
      Point place;
      const double least = smallestJacobian(block, 0, &place);
      TEST_COMPARE(least, <, sampled.least + 2e-3 * sampled.largest);
      TEST_COMPARE(least, >, sampled.least - 0.05 * sampled.largest);
      apart = std::max(apart, std::abs(least - sampled.least) / sampled.largest);
      folded += sampled.least < 0;
      if (sampled.least < 0) TEST_COMPARE(least, <, 0);
    }
    out << cellInfo(cell).name << ": " << folded << " of 60 folded; apart " << apart << "\n";
    TEST_COMPARE(folded, >, 0);
    TEST_COMPARE(folded, <, 60);
  }
}

// A hexahedron whose sections are a bent quadrilateral has its determinant, and like it may be folded between valid nodes.
TEUCHOS_UNIT_TEST(CellGeometry, FindsTheLeastDeterminantOfAnExtrudedElement) {
  std::mt19937 random(1);
  Sampled sampled(Cell::Quadrilateral9);
  int hidden = 0;
  for (int k = 0; k < 60; ++k) {
    CellBlock flat = drawn(Cell::Quadrilateral9), block = drawn(Cell::Hexahedron27);
    bend(flat, 0.35, random);
    sampled.sample(flat);
    const std::vector<Point> square = referencecells::places(Cell::Quadrilateral9), cube = referencecells::places(Cell::Hexahedron27);
    for (std::size_t i = 0; i < cube.size(); ++i)
      for (int node = 0; node < flat.nodes(); ++node)
        if (square[node][0] == cube[i][0] && square[node][1] == cube[i][1])
          std::copy_n(flat.coordinates.begin() + 2 * node, 2, block.coordinates.begin() + static_cast<std::ptrdiff_t>(3 * i));
    const double least = smallestJacobian(block, 0);
    TEST_COMPARE(std::abs(least - smallestJacobian(flat, 0)), <, 2e-3 * sampled.largest);
    hidden += sampled.leastAtNodes > 0 && least < 0 && sampled.least < 0;
  }
  TEST_COMPARE(hidden, >, 0);
}

// Products of three lengths overflow here; a search for their least value would not end.
TEUCHOS_UNIT_TEST(CellGeometry, GivesNoFiniteNumberWherePlacesAreTooLarge) {
  for (const Cell cell : referencecells::solid) {
    CellBlock block = drawn(cell);
    for (double& x : block.coordinates) x *= 1e150;
    TEST_ASSERT(!std::isfinite(smallestJacobian(block, 0)));
  }
}

TEUCHOS_UNIT_TEST(CellGeometry, SeesCellsThatAreNotConvex) {
  // A vertex is pulled across the diagonal of its cell, towards the opposite one: the volume stays positive.
  for (const auto& [cell, vertex, to] :
       {std::tuple(Cell::Quadrilateral4, 2, Point{-0.5, -0.5, 0}), {Cell::Hexahedron8, 6, Point{-0.5, -0.5, -0.5}}}) {
    CellBlock block = drawn(cell);
    const Point shift{7, -3, 2};
    for (int k = 0; k < block.dimension; ++k) block.coordinates[std::size_t(block.dimension) * vertex + k] = shift[k] + to[k];
    TEST_COMPARE(signedSize(block, 0), >, 0);
    TEST_COMPARE(smallestJacobian(block, 0), <, 0);
  }
}
