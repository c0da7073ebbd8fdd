#include <suture/quality/PatchMoments.hpp>

#include <Eigen/Cholesky>
#include <cmath>

namespace suture::patch {

namespace {

constexpr double leastPivot = 1e-10;      // smallest pivot accepted, of the matrix scaled to a unit diagonal
constexpr double leastThickness = 1e-20;  // square of a patch's extent along an axis over that along both: less is rounding

int degreeOf(int term) { return term == 0 ? 0 : term < 3 ? 1 : 2; }

}  // namespace

int termsOf(int order) { return (order + 1) * (order + 2) / 2; }
int orderOf(Cell cell) { return cell == Cell::Triangle3 || cell == Cell::Quadrilateral4 ? 1 : 2; }

Terms monomials(double x, double y, int order) {
  Terms m(termsOf(order));
  m(0) = 1.0;
  if (order > 0) m(1) = x, m(2) = y;
  if (order > 1) m(3) = x * x, m(4) = x * y, m(5) = y * y;
  return m;
}

Small shift(double a, double b, int order) {
  Small s = Small::Identity(termsOf(order), termsOf(order));
  if (order > 0) s(1, 0) = a, s(2, 0) = b;
  if (order > 1) {
    s(3, 0) = a * a, s(3, 1) = 2 * a;
    s(4, 0) = a * b, s(4, 1) = b, s(4, 2) = a;
    s(5, 0) = b * b, s(5, 2) = 2 * b;
  }
  return s;
}

bool fit(const Layout& layout, const double* column, const double* variances, int order, double most, Eigen::Ref<Vector> polynomial) {
  const int n = termsOf(order);
  const double points = column[layout.points()];
  if (points < n - 0.5) return false;
  Small a = layout.matrix(column).topLeftCorner(n, n);
  const double extent = order > 0 ? (a(1, 1) + a(2, 2)) / points : 0.0;
  Terms scale(n);
  for (int i = 0; i < n; ++i) {
    if (!(a(i, i) > leastThickness * points * std::pow(extent, degreeOf(i)))) return false;
    scale(i) = 1.0 / std::sqrt(a(i, i));
  }
  a = (scale.asDiagonal() * a * scale.asDiagonal()).eval();
  const Eigen::LLT<Small> factor(a);
  if (factor.info() != Eigen::Success || factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() < leastPivot) return false;
  const Terms vertex = scale.asDiagonal() * factor.solve(Terms(scale(0) * Terms::Unit(n, 0)));
  if (vertex.dot(layout.matrix(variances).topLeftCorner(n, n) * vertex) > most) return false;
  const Polynomial right = scale.asDiagonal() * layout.rightSide(column).topRows(n);
  polynomial.setZero();
  Eigen::Map<Matrix>(polynomial.data(), layout.terms, components).topRows(n) = scale.asDiagonal() * factor.solve(right);
  return true;
}

}  // namespace suture::patch
