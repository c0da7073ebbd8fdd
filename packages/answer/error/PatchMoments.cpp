#include <suture/answer/error/PatchMoments.hpp>

#include <Eigen/Cholesky>
#include <cmath>

namespace suture::patch {

namespace {

constexpr double leastPivot = 1e-10;      // smallest accepted pivot of the matrix scaled to a unit diagonal
constexpr double leastThickness = 1e-20;  // least ratio of a patch's squared extent along an axis to the total; less is round-off

template <int D>
int degreeOf(int term) {
  return term == 0 ? 0 : term <= D ? 1 : 2;
}

}  // namespace

template <int D>
Terms<D> monomials(const Point& x, int order) {
  Terms<D> m(termsOf<D>(order));
  m(0) = 1.0;
  for (int i = 0; order > 0 && i < D; ++i) m(1 + i) = x[i];
  int term = D;
  for (int i = 0; order > 1 && i < D; ++i)
    for (int j = i; j < D; ++j) m(++term) = x[i] * x[j];
  return m;
}

template <int D>
Small<D> shift(const Point& a, int order) {
  Small<D> s = Small<D>::Identity(termsOf<D>(order), termsOf<D>(order));
  for (int i = 0; order > 0 && i < D; ++i) s(1 + i, 0) = a[i];
  int term = D;
  for (int i = 0; order > 1 && i < D; ++i)
    for (int j = i; j < D; ++j) {
      s(++term, 0) = a[i] * a[j];
      s(term, 1 + i) += a[j];
      s(term, 1 + j) += a[i];
    }
  return s;
}

template <int D>
bool fit(const Layout<D>& layout, const double* column, const double* variances, int order, double most, Eigen::Ref<Vector> polynomial) {
  const int n = termsOf<D>(order);
  const double points = column[layout.points()];
  if (points < n - 0.5) return false;
  Small<D> a = layout.matrix(column).topLeftCorner(n, n);
  double extent = 0.0;
  for (int k = 1; order > 0 && k <= D; ++k) extent += a(k, k);
  extent /= points;
  Terms<D> scale(n);
  for (int i = 0; i < n; ++i) {
    if (!(a(i, i) > leastThickness * points * std::pow(extent, degreeOf<D>(i)))) return false;
    scale(i) = 1.0 / std::sqrt(a(i, i));
  }
  a = (scale.asDiagonal() * a * scale.asDiagonal()).eval();
  const Eigen::LLT<Small<D>> factor(a);
  if (factor.info() != Eigen::Success || factor.matrixLLT().diagonal().cwiseAbs2().minCoeff() < leastPivot) return false;
  const Terms<D> vertex = scale.asDiagonal() * factor.solve(Terms<D>(scale(0) * Terms<D>::Unit(n, 0)));
  if (vertex.dot(layout.matrix(variances).topLeftCorner(n, n) * vertex) > most) return false;
  const Polynomial<D> right = scale.asDiagonal() * layout.rightSide(column).topRows(n);
  polynomial.setZero();
  Eigen::Map<Matrix>(polynomial.data(), layout.terms, components<D>).topRows(n) = scale.asDiagonal() * factor.solve(right);
  return true;
}

template Terms<2> monomials<2>(const Point& x, int order);
template Terms<3> monomials<3>(const Point& x, int order);
template Small<2> shift<2>(const Point& a, int order);
template Small<3> shift<3>(const Point& a, int order);
template bool fit<2>(const Layout<2>& layout, const double* column, const double* variances, int order, double most,
                     Eigen::Ref<Vector> polynomial);
template bool fit<3>(const Layout<3>& layout, const double* column, const double* variances, int order, double most,
                     Eigen::Ref<Vector> polynomial);

}  // namespace suture::patch
