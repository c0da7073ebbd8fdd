#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/Cell.hpp>

namespace suture::patch {

// Patch recovery on one patch: moments of stresses about its vertex, and the polynomial that fits them. For PatchRecovery.cpp.

constexpr int components = 4;  // as in elementStresses(): xx, yy, zz, xy
constexpr int maxTerms = 6;

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, maxTerms, maxTerms>;
using Terms = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, maxTerms, 1>;
using Stress = Eigen::Matrix<double, components, 1>;
using Polynomial = Eigen::Matrix<double, Eigen::Dynamic, components, 0, maxTerms, components>;

int termsOf(int order);
int orderOf(Cell cell);
Terms monomials(double x, double y, int order);
/// monomials(x + a, y + b) = shift(a, b) monomials(x, y)
Small shift(double a, double b, int order);

// A column of moments: A = sum of m m^T over the points (half of it), B = sum of m s^T, and a few sums over the elements.
struct Layout {
  int order, terms, half, right;
  explicit Layout(int order) : order(order), terms(termsOf(order)), half(terms * (terms + 1) / 2), right(half + terms * components) {}
  int points() const { return right; }
  int quadratic() const { return right + 1; }  // elements of order 2
  int width() const { return right + 2; }

  Small matrix(const double* column) const {
    Small a(terms, terms);
    for (int j = 0, k = 0; j < terms; ++j)
      for (int i = 0; i <= j; ++i, ++k) a(i, j) = a(j, i) = column[k];
    return a;
  }
  Polynomial rightSide(const double* column) const { return Eigen::Map<const Polynomial>(column + half, terms, components); }
  void addPoint(const Terms& m, const Stress& stress, double* column) const {
    for (int j = 0; j < terms; ++j)
      for (int i = 0; i <= j; ++i) *column++ += m(i) * m(j);
    for (int k = 0; k < components; ++k)
      for (int i = 0; i < terms; ++i) *column++ += m(i) * stress(k);
    *column += 1.0;
  }
  // Adds a column about one vertex to a column about another.
  void addShifted(const double* other, const Point& from, const Point& to, double* column) const {
    const Small s = shift(from[0] - to[0], from[1] - to[1], order), a = s * matrix(other) * s.transpose();
    const Polynomial b = s * rightSide(other);
    for (int k = points(); k < width(); ++k) column[k] += other[k];
    for (int j = 0; j < terms; ++j)
      for (int i = 0; i <= j; ++i) *column++ += a(i, j);
    for (int k = 0; k < components; ++k)
      for (int i = 0; i < terms; ++i) *column++ += b(i, k);
  }
  int orderOfPatch(const double* column) const { return column[quadratic()] > 0.0 ? order : 1; }
};

// Least squares by a polynomial of an order; false, and nothing is written, if the points do not determine it, or leave the value at the
// vertex a variance above `most`. `variances`: as `column`, each point counted by the square of its weight.
bool fit(const Layout& layout, const double* column, const double* variances, int order, double most, Eigen::Ref<Vector> polynomial);

}  // namespace suture::patch
