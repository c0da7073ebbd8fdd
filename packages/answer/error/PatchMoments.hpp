#pragma once
#include <suture/base/Types.hpp>
#include <suture/elasticity/StressVector.hpp>
#include <suture/mesh/Cell.hpp>

namespace suture::patch {

// Patch recovery on one patch: moments of stresses about its vertex, and the polynomial that fits them. For PatchRecovery.cpp.
// D: dimension of the cells.

template <int D>
constexpr int components = stressComponents<D>;
template <int D>
constexpr int maxTerms = D == 2 ? 6 : 10;

template <int D>
using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, maxTerms<D>, maxTerms<D>>;
template <int D>
using Terms = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, maxTerms<D>, 1>;
template <int D>
using Polynomial = Eigen::Matrix<double, Eigen::Dynamic, components<D>, 0, maxTerms<D>, components<D>>;

/// Number of monomials up to an order.
template <int D>
constexpr int termsOf(int order) {
  return D == 2 ? (order + 1) * (order + 2) / 2 : (order + 1) * (order + 2) * (order + 3) / 6;
}
/// 1, the coordinates, then their products: x x, x y, (x z,) y y, ...
template <int D>
Terms<D> monomials(const Point& x, int order);
/// monomials(x + a) = shift(a) monomials(x)
template <int D>
Small<D> shift(const Point& a, int order);

// A column of moments: A = sum of m m^T over the points (half of it), B = sum of m s^T, and a few sums over the elements.
template <int D>
struct Layout {
  int order, terms, half, right;
  explicit Layout(int order) : order(order), terms(termsOf<D>(order)), half(terms * (terms + 1) / 2), right(half + terms * components<D>) {}
  int points() const { return right; }
  int quadratic() const { return right + 1; }  // elements of order 2
  int width() const { return right + 2; }

  Small<D> matrix(const double* column) const {
    Small<D> a(terms, terms);
    for (int j = 0, k = 0; j < terms; ++j)
      for (int i = 0; i <= j; ++i, ++k) a(i, j) = a(j, i) = column[k];
    return a;
  }
  Polynomial<D> rightSide(const double* column) const { return Eigen::Map<const Polynomial<D>>(column + half, terms, components<D>); }
  void addPoint(const Terms<D>& m, const StressVector<D>& stress, double* column) const {
    for (int j = 0; j < terms; ++j)
      for (int i = 0; i <= j; ++i) *column++ += m(i) * m(j);
    for (int k = 0; k < components<D>; ++k)
      for (int i = 0; i < terms; ++i) *column++ += m(i) * stress(k);
    *column += 1.0;
  }
  // Adds a column about one vertex to a column about another.
  void addShifted(const double* other, const Point& from, const Point& to, double* column) const {
    const Small<D> s = shift<D>({from[0] - to[0], from[1] - to[1], from[2] - to[2]}, order), a = s * matrix(other) * s.transpose();
    const Polynomial<D> b = s * rightSide(other);
    for (int k = points(); k < width(); ++k) column[k] += other[k];
    for (int j = 0; j < terms; ++j)
      for (int i = 0; i <= j; ++i) *column++ += a(i, j);
    for (int k = 0; k < components<D>; ++k)
      for (int i = 0; i < terms; ++i) *column++ += b(i, k);
  }
  int orderOfPatch(const double* column) const { return column[quadratic()] > 0.0 ? order : 1; }
};

// Least-squares fit of a polynomial of an order; returns false without writing if the points do not determine it, or if the variance of the
// value at the vertex exceeds `most`. `variances`: as `column`, with each point weighted by the square of its weight.
template <int D>
bool fit(const Layout<D>& layout, const double* column, const double* variances, int order, double most, Eigen::Ref<Vector> polynomial);

}  // namespace suture::patch
