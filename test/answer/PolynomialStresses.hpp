#pragma once
#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <random>
#include <suture/answer/bound/StressElement.hpp>
#include <suture/mesh/GaussRule.hpp>
#include <utility>
#include <vector>

namespace suture {
/// Random simplices, materials and polynomial stresses whose values, divergences and energies are known: input of tests of stresses in
/// equilibrium.
namespace stresses {

template <int D>
using Direction = Eigen::Matrix<double, D, 1>;
template <int D>
using Vertices = typename StressElement<D>::Vertices;
template <int D>
using Compliance = typename StressElement<D>::Compliance;
template <int D>
using Tensor = Eigen::Matrix<double, D, D>;

class Random {
 public:
  explicit Random(int seed) : engine_(seed) {}
  double number() { return uniform_(engine_); }
  template <class Matrix>
  Matrix matrix(int rows, int columns) {
    return Matrix::NullaryExpr(rows, columns, [this] { return number(); });
  }
  /// A simplex of either orientation, away from the origin, whose longest edge is less than six times its least height.
  template <int D>
  Vertices<D> simplex();
  /// A compliance without any symmetry of the material.
  template <int D>
  Compliance<D> compliance() {
    constexpr int n = StressElement<D>::components;
    const auto root = matrix<Compliance<D>>(n, n);
    return 0.5 * root * root.transpose() + Compliance<D>::Identity();
  }

 private:
  std::mt19937 engine_;
  std::uniform_real_distribution<double> uniform_{-1.0, 1.0};
};

template <int D>
Tensor<D> mapOf(const Vertices<D>& vertices) {
  return vertices.template rightCols<D>().colwise() - vertices.col(0);
}

/// Vertices of part `part` of the Alfeld split, the centroid last.
template <int D>
Vertices<D> partOf(const Vertices<D>& vertices, int part) {
  Vertices<D> result;
  for (int i = 0, n = 0; i <= D; ++i)
    if (i != part) result.col(n++) = vertices.col(i);
  result.col(D) = vertices.rowwise().mean();
  return result;
}

template <int D>
double volumeOf(const Vertices<D>& vertices) {
  return std::abs(mapOf<D>(vertices).determinant()) / (D == 2 ? 2 : 6);
}

/// Unit normal of the side with the given D vertices that points away from a point, and the area of the side.
template <int D>
std::pair<Direction<D>, double> awayFrom(const Tensor<D>& side, const Direction<D>& inside) {
  Direction<D> normal;
  if constexpr (D == 2)
    normal << side(1, 1) - side(1, 0), side(0, 0) - side(0, 1);
  else
    normal = (side.col(1) - side.col(0)).cross(side.col(2) - side.col(0)) / 2;
  const double area = normal.norm();
  normal /= area;
  return {normal.dot(side.col(0) - inside) > 0 ? normal : Direction<D>(-normal), area};
}

/// Integral over a simplex, exact for polynomials up to degree 6. \param value  of barycentric coordinates
template <int D, class F>
double integral(const Vertices<D>& vertices, F value) {
  const LineRule rule = gaussRule(5);
  double sum = 0.0;
  const auto at = [&](int i) { return (1 + rule.points[i]) / 2; };
  const auto weight = [&](int i) { return rule.weights[i] / 2; };
  const int n = int(rule.points.size());
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < (D == 2 ? 1 : n); ++k) {
        const double a = at(i), b = at(j) * (1 - a);
        Eigen::Matrix<double, D + 1, 1> point;
        double w = weight(i) * weight(j) * (1 - a);
        if constexpr (D == 2) {
          point << 1 - a - b, a, b;
        } else {
          const double c = at(k) * (1 - a - b);
          point << 1 - a - b - c, a, b, c;
          w *= weight(k) * (1 - a - b);
        }
        sum += w * value(point);
      }
  return sum * volumeOf<D>(vertices) * (D == 2 ? 2 : 6);
}

/// A symmetric stress, polynomial of degree up to 2 in coordinates relative to a point: values and derivatives.
template <int D>
struct Field {
  static constexpr int components = StressElement<D>::components;
  using Values = Eigen::Matrix<double, components, 1>;
  Direction<D> origin = Direction<D>::Zero();
  Values constant = Values::Zero();
  Eigen::Matrix<double, components, D> linear = Eigen::Matrix<double, components, D>::Zero();
  std::array<Tensor<D>, components> quadratic;  // symmetric

  Field() { quadratic.fill(Tensor<D>::Zero()); }
  Values at(const Direction<D>& place) const {
    const Direction<D> x = place - origin;
    Values s = constant + linear * x;
    for (int q = 0; q < components; ++q) s(q) += x.dot(quadratic[q] * x);
    return s;
  }
  Direction<D> divergence(const Direction<D>& place) const {
    Direction<D> sum = Direction<D>::Zero();
    for (int q = 0; q < components; ++q) {
      const auto [i, j] = tensorAxes<D>()[q];
      const Direction<D> gradient = linear.row(q).transpose() + 2 * quadratic[q] * (place - origin);
      sum(i) += gradient(j);
      if (i != j) sum(j) += gradient(i);
    }
    return sum;
  }
};

template <int D>
Tensor<D> tensor(const typename Field<D>::Values& s) {
  Tensor<D> result;
  for (int q = 0; q < s.size(); ++q) {
    const auto [i, j] = tensorAxes<D>()[q];
    result(i, j) = result(j, i) = s(q);
  }
  return result;
}

template <int D>
Field<D> randomField(Random& random, int degree, const Direction<D>& origin) {
  Field<D> field;
  field.origin = origin;
  field.constant = random.matrix<typename Field<D>::Values>(Field<D>::components, 1);
  field.linear = random.matrix<decltype(field.linear)>(Field<D>::components, D);
  if (degree == 2)
    for (Tensor<D>& q : field.quadratic) {
      const auto m = random.matrix<Tensor<D>>(D, D);
      q = m + m.transpose();
    }
  return field;
}

/// The stress of a random displacement of degree 3 (order 2: degree 2) relative to a point.
template <int D>
Field<D> compatibleField(Random& random, const Compliance<D>& compliance, const Direction<D>& origin) {
  Field<D> strain;
  strain.origin = origin;
  // u_i = a_ij x_j + b_ijk x_j x_k + c_ijkl x_j x_k x_l with b, c symmetric in the indices of coordinates
  const auto a = random.matrix<Tensor<D>>(D, D);
  std::array<Tensor<D>, D> b;
  std::array<std::array<Tensor<D>, D>, D> c;
  for (int i = 0; i < D; ++i) {
    const auto m = random.matrix<Tensor<D>>(D, D);
    b[i] = m + m.transpose();
    for (int j = 0; j < D; ++j)
      for (int k = j; k < D; ++k)
        for (int l = k; l < D; ++l) {
          const double value = random.number();
          for (const auto& [p, q, r] : std::vector<std::array<int, 3>>{{j, k, l}, {j, l, k}, {k, j, l}, {k, l, j}, {l, j, k}, {l, k, j}})
            c[i][p](q, r) = value;
        }
  }
  for (int q = 0; q < Field<D>::components; ++q) {
    const auto [i, j] = tensorAxes<D>()[q];
    const double half = i == j ? 0.5 : 1.0;  // engineering shear strains
    strain.constant(q) = half * (a(i, j) + a(j, i));
    strain.linear.row(q) = half * 2 * (b[i].row(j) + b[j].row(i));
    strain.quadratic[q] = half * 3 * (c[i][j] + c[j][i]);
  }
  const Compliance<D> stiffness = compliance.inverse();
  Field<D> field;
  field.origin = origin;
  field.constant = stiffness * strain.constant;
  field.linear = stiffness * strain.linear;
  for (int p = 0; p < Field<D>::components; ++p)
    for (int q = 0; q < Field<D>::components; ++q) field.quadratic[p] += stiffness(p, q) * strain.quadratic[q];
  return field;
}

template <int D>
double energyOf(const Vertices<D>& vertices, const Compliance<D>& compliance, const Field<D>& field) {
  return integral<D>(vertices, [&](const auto& point) {
    const auto s = field.at(vertices * point);
    return s.dot(compliance * s);
  });
}

template <int D>
Compliance<D> isotropic(double nu) {  // plane strain in 2D; E = 1
  Compliance<D> c = Compliance<D>::Zero();
  c.diagonal().setConstant(2 * (1 + nu));
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) c(i, j) = D == 2 ? (i == j ? 1 - nu * nu : -nu * (1 + nu)) : (i == j ? 1.0 : -nu);
  return c;
}

/// The longest edge over the least height.
template <int D>
double aspect(const Vertices<D>& vertices) {
  double longest = 0.0, largest = 0.0;
  for (int i = 0; i <= D; ++i)
    for (int j = 0; j < i; ++j) longest = std::max(longest, (vertices.col(i) - vertices.col(j)).norm());
  for (int side = 0; side <= D; ++side)
    largest = std::max(largest, awayFrom<D>(partOf<D>(vertices, side).template leftCols<D>(), vertices.col(side)).second);
  return longest * largest / (D * volumeOf<D>(vertices));
}

template <int D>
Vertices<D> Random::simplex() {
  for (;;) {
    const Vertices<D> vertices = matrix<Vertices<D>>(D, D + 1).array() + 3.0;
    if (aspect<D>(vertices) < 6) return vertices;
  }
}

}  // namespace stresses
}  // namespace suture
