// Stresses in equilibrium on one simplex, against polynomial stresses whose tractions, sources and energies are known, and against their
// own definition evaluated point by point.
#include <Eigen/Dense>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <random>
#include <suture/answer/bound/StressElement.hpp>
#include <suture/base/Errors.hpp>
#include <suture/mesh/GaussRule.hpp>

namespace suture {
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

/// Places of the data's nodes on a side: vertices in ascending order, then the middles of edges.
template <int D>
Eigen::Matrix<double, D, Eigen::Dynamic> sidePlaces(const Vertices<D>& vertices, int side, int count) {
  Eigen::Matrix<double, D, Eigen::Dynamic> places(D, count);
  places.template leftCols<D>() = partOf<D>(vertices, side).template leftCols<D>();
  if (count > D) places.col(D) = (places.col(0) + places.col(1)) / 2;
  if (count > D && D == 3) {
    places.col(4) = (places.col(1) + places.col(2)) / 2;
    places.col(5) = (places.col(0) + places.col(2)) / 2;
  }
  return places;
}

template <int D>
Vector dataOf(const StressElement<D>& element, const Vertices<D>& vertices, const Field<D>& field) {
  Vector data(element.data());
  int at = 0;
  for (int side = 0; side <= D; ++side) {
    const auto places = sidePlaces<D>(vertices, side, element.sideNodes());
    const Direction<D> normal = awayFrom<D>(places.template leftCols<D>(), vertices.col(side)).first;
    for (int node = 0; node < element.sideNodes(); ++node, at += D) data.segment(at, D) = tensor<D>(field.at(places.col(node))) * normal;
  }
  for (int node = 0; node < element.sourceNodes(); ++node, at += D)
    data.segment(at, D) = -field.divergence(element.sourceNodes() == 1 ? Direction<D>(vertices.rowwise().mean()) : vertices.col(node));
  return data;
}

template <int D>
double energyOf(const Vertices<D>& vertices, const Compliance<D>& compliance, const Field<D>& field) {
  return integral<D>(vertices, [&](const auto& point) {
    const auto s = field.at(vertices * point);
    return s.dot(compliance * s);
  });
}

template <int D>
double quadraticForm(const StressElement<D>& element, const Vertices<D>& vertices, const Compliance<D>& compliance, const Vector& data) {
  Matrix gram;
  element.gram(mapOf<D>(vertices), compliance, gram);
  return data.dot(gram * data);
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

/// A simplex with edges of order one, except for one direction in which it is thinner by a factor.
template <int D>
Vertices<D> thinned(const Vertices<D>& vertices, double factor, Random& random) {
  const Direction<D> across = random.matrix<Direction<D>>(D, 1).normalized();
  return (Tensor<D>::Identity() - (1 - factor) * across * across.transpose()) * vertices;
}

template <int D>
Vertices<D> Random::simplex() {
  for (;;) {
    const Vertices<D> vertices = matrix<Vertices<D>>(D, D + 1).array() + 3.0;
    if (aspect<D>(vertices) < 6) return vertices;
  }
}

/// x.G x, and the size of its terms: round-off is relative to the latter.
struct Form {
  double value, terms;
};
template <int D>
Form formOf(const StressElement<D>& element, const Vertices<D>& vertices, const Compliance<D>& compliance, const Vector& data) {
  Matrix gram;
  element.gram(mapOf<D>(vertices), compliance, gram);
  return {data.dot(gram * data), data.cwiseAbs().dot(gram.cwiseAbs() * data.cwiseAbs())};
}

#define BOTH_DIMENSIONS(claim)               \
  TEUCHOS_UNIT_TEST(StressElement, claim) {  \
    for (const int degree : {1, 2}) {        \
      check##claim<2>(degree, out, success); \
      check##claim<3>(degree, out, success); \
    }                                        \
  }

TEUCHOS_UNIT_TEST(StressElement, HasTheRanksOfTheTheory) {
  // Johnson and Mercier 1978; Gopalakrishnan, Guzman and Lee 2024: bubbles without data exist from degree 2
  TEST_EQUALITY(StressElement<2>::of(1).unknowns(), 27);
  TEST_EQUALITY(StressElement<2>::of(1).rank(), 27);
  TEST_EQUALITY(StressElement<2>::of(2).unknowns(), 54);
  TEST_EQUALITY(StressElement<2>::of(2).rank(), 51);
  TEST_EQUALITY(StressElement<3>::of(1).unknowns(), 96);
  TEST_EQUALITY(StressElement<3>::of(1).rank(), 96);
  TEST_EQUALITY(StressElement<3>::of(2).unknowns(), 240);
  TEST_EQUALITY(StressElement<3>::of(2).rank(), 222);
  TEST_EQUALITY(StressElement<2>::of(1).data(), 14);
  TEST_EQUALITY(StressElement<2>::of(2).data(), 24);
  TEST_EQUALITY(StressElement<3>::of(1).data(), 39);
  TEST_EQUALITY(StressElement<3>::of(2).data(), 84);
  TEST_THROW(StressElement<2>::of(3), InternalError);
}

// With degree 1 the data determine the stress; with degree 2 a stress has the least energy if its strains are those of a displacement.
template <int D>
void checkHasTheEnergyOfAPolynomialStress(int degree, Teuchos::FancyOStream& out, bool& success) {
  const StressElement<D>& element = StressElement<D>::of(degree);
  Random random(7 * D + degree);
  int flipped = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Vertices<D> vertices = random.simplex<D>();
    flipped += mapOf<D>(vertices).determinant() < 0;
    const Compliance<D> compliance = random.compliance<D>();
    const Direction<D> centre = vertices.rowwise().mean();
    const Field<D> field = degree == 1 ? randomField<D>(random, 1, centre) : compatibleField<D>(random, compliance, centre);
    const Vector data = dataOf<D>(element, vertices, field);
    const double exact = energyOf<D>(vertices, compliance, field);
    TEST_FLOATING_EQUALITY(quadraticForm<D>(element, vertices, compliance, data), exact, 1e-11);
    TEST_FLOATING_EQUALITY(element.energy(mapOf<D>(vertices), compliance, data), exact, 1e-12);
  }
  TEST_COMPARE(flipped, >, 3);
  TEST_COMPARE(flipped, <, 17);
}
BOTH_DIMENSIONS(HasTheEnergyOfAPolynomialStress)

// Least energy: the stress is orthogonal to every stress without data, such as its difference from another stress with the same data.
template <int D>
void checkIncompatibleQuadraticStresses(Teuchos::FancyOStream& out, bool& success) {
  const StressElement<D>& element = StressElement<D>::of(2);
  Random random(D);
  int less = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const Vertices<D> vertices = random.simplex<D>();
    const Compliance<D> compliance = random.compliance<D>();
    const Field<D> field = randomField<D>(random, 2, vertices.rowwise().mean());
    const Vector data = dataOf<D>(element, vertices, field);
    const double least = formOf<D>(element, vertices, compliance, data).value, exact = energyOf<D>(vertices, compliance, field);
    double mixed = 0.0;
    for (int part = 0; part <= D; ++part) {
      const Vertices<D> corners = partOf<D>(vertices, part);
      mixed += integral<D>(corners, [&](const auto& point) {
        return field.at(corners * point).dot(compliance * element.stress(mapOf<D>(vertices), compliance, data, part, point));
      });
    }
    TEST_FLOATING_EQUALITY(mixed, least, 1e-11);
    TEST_COMPARE(least, <, exact * (1 + 1e-12));
    TEST_COMPARE(least, >, 0.0);
    less += least < exact * (1 - 1e-5);
  }
  TEST_COMPARE(less, >, 10);
}
TEUCHOS_UNIT_TEST(StressElement, HasLessEnergyThanAnIncompatibleStress) {
  checkIncompatibleQuadraticStresses<2>(out, success);
  checkIncompatibleQuadraticStresses<3>(out, success);
}

// The stress at points: energy, continuity of tractions between the parts, equilibrium, tractions of the sides.
template <int D>
void checkIsInEquilibriumPointByPoint(int degree, Teuchos::FancyOStream& out, bool& success) {
  using Barycentric = typename StressElement<D>::Barycentric;
  const StressElement<D>& element = StressElement<D>::of(degree);
  Random random(100 + 7 * D + degree);
  for (int trial = 0; trial < 5; ++trial) {
    const Vertices<D> vertices = random.simplex<D>();
    const Tensor<D> map = mapOf<D>(vertices);
    const Compliance<D> compliance = random.compliance<D>();
    // Balanced data that are not those of one polynomial: any, less the combination of resultants.
    Matrix balance;
    element.resultants(vertices, balance);
    Vector data = random.matrix<Vector>(element.data(), 1);
    data -= balance.transpose() * (balance * balance.transpose()).ldlt().solve(balance * data);
    const auto stressAt = [&](int part, const Barycentric& point) { return element.stress(map, compliance, data, part, point); };

    double energy = 0.0;
    for (int part = 0; part <= D; ++part)
      energy += integral<D>(partOf<D>(vertices, part), [&](const Barycentric& point) {
        const auto s = stressAt(part, point);
        return s.dot(compliance * s);
      });
    TEST_FLOATING_EQUALITY(quadraticForm<D>(element, vertices, compliance, data), energy, 1e-12);
    TEST_FLOATING_EQUALITY(element.energy(map, compliance, data), energy, 1e-12);

    const auto barycentric = [&](int part, const Direction<D>& place) {
      const Vertices<D> corners = partOf<D>(vertices, part);
      const Direction<D> rest = mapOf<D>(corners).inverse() * (place - corners.col(0));
      Barycentric point;
      point << 1 - rest.sum(), rest;
      return point;
    };
    const auto valueAt = [&](int part, const Direction<D>& place) { return tensor<D>(stressAt(part, barycentric(part, place))); };
    double largest = 0.0;
    for (int part = 0; part <= D; ++part) largest = std::max(largest, stressAt(part, Barycentric::Constant(1.0 / (D + 1))).norm());

    const Direction<D> centre = vertices.rowwise().mean();
    for (int a = 0; a <= D; ++a)
      for (int b = 0; b < a; ++b) {
        Tensor<D> side;
        side.col(0) = centre;
        for (int i = 0, n = 1; i <= D; ++i)
          if (i != a && i != b) side.col(n++) = vertices.col(i);
        const Direction<D> normal = awayFrom<D>(side, vertices.col(a)).first;
        for (int sample = 0; sample < 4; ++sample) {
          Direction<D> weights = random.matrix<Direction<D>>(D, 1).cwiseAbs();
          const Direction<D> place = side * weights / weights.sum();
          TEST_COMPARE(((valueAt(a, place) - valueAt(b, place)) * normal).norm(), <, 1e-12 * largest);
        }
      }

    for (int part = 0; part <= D; ++part) {
      const Direction<D> place = partOf<D>(vertices, part).rowwise().mean();
      Direction<D> divergence = Direction<D>::Zero(), source = data.tail(D);
      const double step = 1e-2;  // central differences are exact for quadratic stresses
      for (int j = 0; j < D; ++j)
        divergence +=
            (valueAt(part, place + step * Direction<D>::Unit(j)) - valueAt(part, place - step * Direction<D>::Unit(j))).col(j) / (2 * step);
      if (degree == 2) {
        const Direction<D> rest = map.inverse() * (place - vertices.col(0));
        Barycentric point;
        point << 1 - rest.sum(), rest;
        source.setZero();
        for (int node = 0; node <= D; ++node) source += point(node) * data.segment(element.tractions() + node * D, D);
      }
      TEST_COMPARE((divergence + source).norm(), <, 1e-10 * largest);
    }

    for (int side = 0; side <= D; ++side) {
      const auto places = sidePlaces<D>(vertices, side, element.sideNodes());
      const Direction<D> normal = awayFrom<D>(places.template leftCols<D>(), vertices.col(side)).first;
      for (int node = 0; node < element.sideNodes(); ++node) {
        const Direction<D> given = data.segment((side * element.sideNodes() + node) * D, D);
        TEST_COMPARE((valueAt(side, places.col(node)) * normal - given).norm(), <, 1e-12 * largest);
      }
    }
  }
}
BOTH_DIMENSIONS(IsInEquilibriumPointByPoint)

// Against integrals of the tractions and sources, as functions of position, with the Gauss rule.
template <int D>
void checkSumsItsResultants(int degree, Teuchos::FancyOStream& out, bool& success) {
  const StressElement<D>& element = StressElement<D>::of(degree);
  Random random(200 + 7 * D + degree);
  const Vertices<D> vertices = random.simplex<D>();
  const Direction<D> centre = vertices.rowwise().mean();
  Matrix sums;
  element.resultants(vertices, sums);
  TEST_EQUALITY(sums.rows(), D * (D + 1) / 2);
  TEST_EQUALITY(sums.cols(), element.data());

  const Field<D> field = randomField<D>(random, degree, centre);
  const Vector balanced = dataOf<D>(element, vertices, field);
  TEST_COMPARE((sums * balanced).norm(), <, 1e-13 * balanced.norm());

  const double length = std::sqrt((vertices.colwise() - centre).squaredNorm() / (D + 1));
  const auto rigid = [&](int mode, const Direction<D>& place) {
    const Direction<D> x = place - centre;
    Direction<D> u = Direction<D>::Zero();
    if (mode < D)
      u(mode) = 1.0;
    else if constexpr (D == 2)
      u << -x(1) / length, x(0) / length;
    else
      u = Direction<3>::Unit(mode - 3).cross(x) / length;
    return u;
  };
  // Tractions of one side: those of a field that is the stress only there. Integrals over a side by splitting it off as a simplex: the mean
  // of a polynomial over the side is the integral of weights at Gauss points of the side's own coordinates.
  const LineRule rule = gaussRule(4);
  const int n = int(rule.points.size());
  for (int side = 0; side <= D; ++side) {
    const auto places = sidePlaces<D>(vertices, side, element.sideNodes());
    const auto [normal, area] = awayFrom<D>(places.template leftCols<D>(), vertices.col(side));
    Vector data = Vector::Zero(element.data());
    const int own = element.sideNodes() * D;
    data.segment(side * own, own) = balanced.segment(side * own, own);
    Vector expected = Vector::Zero(sums.rows());
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < (D == 2 ? 1 : n); ++j) {
        const double a = (1 + rule.points[i]) / 2;
        double weight = rule.weights[i] / 2;
        Direction<D> place;
        if constexpr (D == 2) {
          place = (1 - a) * places.col(0) + a * places.col(1);
        } else {
          const double b = (1 + rule.points[j]) / 2 * (1 - a);
          weight *= rule.weights[j] * (1 - a);
          place = (1 - a - b) * places.col(0) + a * places.col(1) + b * places.col(2);
        }
        const Direction<D> traction = tensor<D>(field.at(place)) * normal;
        for (int mode = 0; mode < sums.rows(); ++mode) expected(mode) += weight * area * traction.dot(rigid(mode, place));
      }
    TEST_COMPARE((sums * data - expected).norm(), <, 1e-13 * balanced.norm());
    TEST_COMPARE(expected.norm(), >, 1e-3);
  }
  Vector data = Vector::Zero(element.data()), expected(sums.rows());
  data.tail(element.sourceNodes() * D) = balanced.tail(element.sourceNodes() * D);
  for (int mode = 0; mode < sums.rows(); ++mode)
    expected(mode) = integral<D>(vertices, [&](const auto& point) {
      const Direction<D> place = vertices * point;
      return -field.divergence(place).dot(rigid(mode, place));
    });
  TEST_COMPARE((sums * data - expected).norm(), <, 1e-13 * balanced.norm());
  TEST_COMPARE(expected.norm(), >, 1e-3);
}
BOTH_DIMENSIONS(SumsItsResultants)

// A simplex s times as large: the energy of equal tractions is s^D times as large, that of equal sources s^(D + 2).
template <int D>
void checkScalesWithItsLength(int degree, Teuchos::FancyOStream& out, bool& success) {
  const StressElement<D>& element = StressElement<D>::of(degree);
  Random random(300 + 7 * D + degree);
  const Vertices<D> vertices = random.simplex<D>();
  const Compliance<D> compliance = random.compliance<D>();
  for (const double scale : {1e-6, 37.0, 1e8}) {
    Matrix one, other;
    element.gram(mapOf<D>(vertices), compliance, one);
    element.gram(scale * mapOf<D>(vertices), compliance / 5e10, other);
    Vector factors = Vector::Ones(element.data());
    factors.tail(element.sourceNodes() * D).setConstant(scale);
    const Matrix expected = std::pow(scale, D) / 5e10 * (factors.asDiagonal() * one * factors.asDiagonal());
    const Vector sizes = expected.diagonal().cwiseSqrt().cwiseInverse();
    TEST_COMPARE((sizes.asDiagonal() * (other - expected) * sizes.asDiagonal()).norm(), <, 1e-12);
    TEST_EQUALITY((other - other.transpose()).norm(), 0.0);
    const Vector values = Eigen::SelfAdjointEigenSolver<Matrix>(sizes.asDiagonal() * other * sizes.asDiagonal()).eigenvalues();
    TEST_COMPARE(values(0), >, -1e-12 * values(values.size() - 1));
  }
}
BOTH_DIMENSIONS(ScalesWithItsLength)

// Another order of the vertices is the same simplex: the data of its sides are permuted.
template <int D>
void checkDoesNotDependOnTheOrderOfVertices(int degree, Teuchos::FancyOStream& out, bool& success) {
  const StressElement<D>& element = StressElement<D>::of(degree);
  Random random(400 + 7 * D + degree);
  Vertices<D> vertices = random.simplex<D>();
  const Compliance<D> compliance = random.compliance<D>();
  const Field<D> field = randomField<D>(random, degree, vertices.rowwise().mean());
  const double expected = quadraticForm<D>(element, vertices, compliance, dataOf<D>(element, vertices, field));
  for (int i = 0; i < D; ++i) {
    vertices.col(i).swap(vertices.col(i + 1));
    TEST_FLOATING_EQUALITY(quadraticForm<D>(element, vertices, compliance, dataOf<D>(element, vertices, field)), expected, 1e-12);
  }
}
BOTH_DIMENSIONS(DoesNotDependOnTheOrderOfVertices)

template <int D>
void checkIsExactNearlyIncompressible(int degree, Teuchos::FancyOStream& out, bool& success) {
  const StressElement<D>& element = StressElement<D>::of(degree);
  Random random(500 + 7 * D + degree);
  for (const double nu : {0.4999, 0.4999999}) {
    const Compliance<D> compliance = isotropic<D>(nu);
    for (int trial = 0; trial < 10; ++trial) {
      const Vertices<D> vertices = random.simplex<D>();
      const Direction<D> centre = vertices.rowwise().mean();
      const Field<D> field = degree == 1 ? randomField<D>(random, 1, centre) : compatibleField<D>(random, compliance, centre);
      const double exact = energyOf<D>(vertices, compliance, field);
      const Vector data = dataOf<D>(element, vertices, field);
      const Form form = formOf<D>(element, vertices, compliance, data);
      TEST_COMPARE(std::abs(form.value - exact), <, 1e-14 * form.terms);
      TEST_FLOATING_EQUALITY(element.energy(mapOf<D>(vertices), compliance, data), exact,
                             1e-13 * std::sqrt(form.terms / exact) + 1e-14 / (1 - 2 * nu));
    }
  }
}
BOTH_DIMENSIONS(IsExactNearlyIncompressible)

template <int D>
void checkIsAccurateOnNeedles(int degree, Teuchos::FancyOStream& out, bool& success) {
  const StressElement<D>& element = StressElement<D>::of(degree);
  Random random(600 + 7 * D + degree);
  for (const double nu : {0.3, 0.4999})
    for (const double factor : {1e-2, 1e-3}) {
      const Compliance<D> compliance = isotropic<D>(nu);
      for (int trial = 0; trial < 20; ++trial) {
        const Vertices<D> vertices = thinned<D>(random.simplex<D>(), factor, random);
        const Direction<D> centre = vertices.rowwise().mean();
        const Field<D> field = degree == 1 ? randomField<D>(random, 1, centre) : compatibleField<D>(random, compliance, centre);
        const double exact = energyOf<D>(vertices, compliance, field), a = aspect<D>(vertices);
        const Vector data = dataOf<D>(element, vertices, field);
        const Form form = formOf<D>(element, vertices, compliance, data);
        const double roundOff = 1e-13 * std::sqrt(form.terms / exact) + 1e-14 / (1 - 2 * nu);
        TEST_FLOATING_EQUALITY(element.energy(mapOf<D>(vertices), compliance, data), exact, roundOff);
        TEST_COMPARE(std::abs(form.value - exact), <, 1e-14 * form.terms);
        TEST_COMPARE(a, >, 0.2 / factor);
      }
    }
}
BOTH_DIMENSIONS(IsAccurateOnNeedles)

template <int D>
void checkGivesTheDataOfALinearStress(int degree, Teuchos::FancyOStream& out, bool& success) {
  const StressElement<D>& element = StressElement<D>::of(degree);
  Random random(700 + 7 * D + degree);
  for (int trial = 0; trial < 5; ++trial) {
    const Vertices<D> vertices = random.simplex<D>();
    const Field<D> field = randomField<D>(random, 1, Direction<D>::Zero());
    Eigen::Matrix<double, StressElement<D>::components, D + 1> values;
    for (int i = 0; i <= D; ++i) values.col(i) = field.at(vertices.col(i));
    Vector data;
    element.dataOf(vertices, values, data);
    const Vector expected = dataOf<D>(element, vertices, field);
    TEST_COMPARE((data - expected).norm(), <, 1e-13 * expected.norm());
  }
}
BOTH_DIMENSIONS(GivesTheDataOfALinearStress)

}  // namespace stresses
}  // namespace suture
