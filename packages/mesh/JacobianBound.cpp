#include <suture/mesh/JacobianBound.hpp>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace suture {

namespace {

constexpr double kNear = 1e-3;  // accuracy of the least value, relative to the largest coefficient
constexpr int kHalvings = 7;    // maximum per direction
constexpr int kMostDegree = 5;  // Hexahedron27: a product of three derivatives

using Degrees = std::array<int, 3>;

/// Degrees of the determinant on the cube from which the reference cell is mapped.
Degrees degreesOf(Cell cell) {
  switch (cell) {
    case Cell::Triangle3:
    case Cell::Tetrahedron4:
      return {0, 0, 0};
    case Cell::Triangle6:
      return {2, 2, 0};
    case Cell::Quadrilateral4:
      return {1, 1, 0};
    case Cell::Quadrilateral8:
    case Cell::Quadrilateral9:
      return {3, 3, 0};
    case Cell::Tetrahedron10:
      return {3, 3, 3};
    case Cell::Hexahedron8:
      return {2, 2, 2};
    case Cell::Hexahedron20:
    case Cell::Hexahedron27:
      return {5, 5, 5};
    case Cell::Wedge6:
      return {1, 1, 2};
    case Cell::Pyramid5:
      return {2, 2, 0};
  }
  return {0, 0, 0};
}

/// The point of the reference cell for a point of [-1,1]^3.
ReferencePoint placeOf(Cell cell, const Point& p) {
  const double a = (1 + p[0]) / 2, b = (1 + p[1]) / 2, c = (1 + p[2]) / 2;
  switch (cell) {
    case Cell::Triangle3:
    case Cell::Triangle6:
      return {a, b * (1 - a), 0};
    case Cell::Tetrahedron4:
    case Cell::Tetrahedron10:
      return {a, b * (1 - a), c * (1 - a) * (1 - b)};
    case Cell::Wedge6:
      return {a, b * (1 - a), p[2]};
    case Cell::Pyramid5:  // the determinant is the same at all heights
      return {p[0], p[1], 0};
    default:
      return dimensionOf(cell) == 2 ? Point{p[0], p[1], 0} : p;
  }
}

/// Interpolation points of a polynomial, and the matrix from its values there to Bernstein coefficients.
struct Interpolation {
  Vector points;
  Matrix toBernstein;

  explicit Interpolation(int degree) : points(degree + 1) {
    Matrix values(degree + 1, degree + 1);
    for (int i = 0; i <= degree; ++i) {
      points(i) = degree == 0 ? 0.0 : -std::cos((2 * i + 1) * std::acos(-1.0) / (2 * degree + 2));  // Chebyshev points: well conditioned
      const double t = (1 + points(i)) / 2;
      double binomial = 1;
      for (int j = 0; j <= degree; ++j) {
        values(i, j) = binomial * std::pow(t, j) * std::pow(1 - t, degree - j);
        binomial = binomial * (degree - j) / (j + 1);
      }
    }
    toBernstein = values.inverse();
  }
};

const Interpolation& interpolation(int degree) {
  static const std::array<Interpolation, kMostDegree + 1> all{Interpolation(0), Interpolation(1), Interpolation(2),
                                                              Interpolation(3), Interpolation(4), Interpolation(5)};
  return all[degree];
}

/// A polynomial on a box in [-1,1]^3 by its Bernstein coefficients; the first direction runs fastest.
struct Piece {
  std::vector<double> coefficients;
  Point low{-1, -1, -1}, high{1, 1, 1};
};

class Search {
 public:
  Search(Cell cell, const Degrees& degrees) : cell_(cell) {
    for (int k = 0, step = 1; k < 3; ++k) count_[k] = degrees[k] + 1, step_[k] = step, step *= count_[k];
    size_ = step_[2] * count_[2];
  }

  template <typename Value>
  double run(const Value& value, ReferencePoint& where) {
    Piece whole;
    whole.coefficients.resize(size_);
    for (int i = 0; i < size_; ++i) {
      Point p{0, 0, 0};
      for (int k = 0; k < 3; ++k) p[k] = interpolation(count_[k] - 1).points(i / step_[k] % count_[k]);
      whole.coefficients[i] = value(placeOf(cell_, p));
    }
    for (int k = 0; k < 3; ++k) {
      const Matrix& to = interpolation(count_[k] - 1).toBernstein;
      forEachLine(k, [&](int first) {
        double line[kMostDegree + 1];
        for (int i = 0; i < count_[k]; ++i) line[i] = whole.coefficients[first + i * step_[k]];
        for (int i = 0; i < count_[k]; ++i) {
          double sum = 0;
          for (int j = 0; j < count_[k]; ++j) sum += to(i, j) * line[j];
          whole.coefficients[first + i * step_[k]] = sum;
        }
      });
    }
    for (const double c : whole.coefficients)
      if (!std::isfinite(c)) return c;  // subdivision would not help
    least_ = std::numeric_limits<double>::infinity();
    visit(whole, 0);
    where = placeOf(cell_, place_);
    return least_;
  }

 private:
  /// Calls each(first) with the first coefficient of every line along a direction.
  template <typename Each>
  void forEachLine(int direction, const Each& each) const {
    for (int i = 0; i < size_; ++i)
      if (i / step_[direction] % count_[direction] == 0) each(i);
  }

  void visit(const Piece& piece, int halvings) {
    double bound = piece.coefficients[0], largest = 0;
    for (const double c : piece.coefficients) bound = std::min(bound, c), largest = std::max(largest, std::abs(c));
    for (int corner = 0; corner < 8; ++corner) {
      int at = 0;
      Point place;
      for (int k = 0; k < 3; ++k) {
        const bool upper = corner >> k & 1;
        place[k] = upper ? piece.high[k] : piece.low[k];
        at += upper ? (count_[k] - 1) * step_[k] : 0;
      }
      if (piece.coefficients[at] < least_) least_ = piece.coefficients[at], place_ = place;
    }
    const bool isKnown = bound >= least_ - kNear * largest && (bound > 0 || least_ <= 1e-6 * kNear * largest);
    if (bound >= least_ || isKnown || halvings == kHalvings * 3) return;
    const int k = halvings % 3;
    if (count_[k] == 1) return visit(piece, halvings + 1);
    Piece left = piece, right = piece;
    left.high[k] = right.low[k] = (piece.low[k] + piece.high[k]) / 2;
    const int degree = count_[k] - 1;
    forEachLine(k, [&](int first) {  // de Casteljau
      double line[kMostDegree + 1];
      for (int i = 0; i <= degree; ++i) line[i] = piece.coefficients[first + i * step_[k]];
      for (int i = 0; i <= degree; ++i) {
        left.coefficients[first + i * step_[k]] = line[0];
        right.coefficients[first + (degree - i) * step_[k]] = line[degree - i];
        for (int j = 0; j < degree - i; ++j) line[j] = (line[j] + line[j + 1]) / 2;
      }
    });
    visit(left, halvings + 1);
    visit(right, halvings + 1);
  }

  Cell cell_;
  std::array<int, 3> count_{}, step_{};  // number of coefficients and stride in each direction
  int size_ = 1;
  double least_ = 0;
  Point place_{0, 0, 0};
};

}  // namespace

double jacobianAt(const CellBlock& block, int element, const ReferencePoint& at) {
  const Span<const int> nodes = block.nodesOf(element);
  ShapeJet jets[kMostCellNodes];
  shapeJets(block.cells[element], at, jets);
  double j[3][3] = {};  // [coordinate][reference direction]
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const ReferencePoint& g = jets[i].gradient;
    const Point x = block.point(nodes[i]);
    for (int k = 0; k < block.dimension; ++k)
      for (int l = 0; l < block.dimension; ++l) j[k][l] += x[k] * g[l];
  }
  if (block.dimension == 2) return j[0][0] * j[1][1] - j[0][1] * j[1][0];
  return j[0][0] * (j[1][1] * j[2][2] - j[1][2] * j[2][1]) - j[0][1] * (j[1][0] * j[2][2] - j[1][2] * j[2][0]) +
         j[0][2] * (j[1][0] * j[2][1] - j[1][1] * j[2][0]);
}

double leastJacobian(const CellBlock& block, int element, ReferencePoint& where) {
  const Cell cell = block.cells[element];
  return Search(cell, degreesOf(cell)).run([&](const ReferencePoint& at) { return jacobianAt(block, element, at); }, where);
}

}  // namespace suture
