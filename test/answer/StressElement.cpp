// Stresses in equilibrium on one simplex, against polynomial stresses whose tractions, sources and energies are known, and against their
// own definition evaluated point by point.
#include <Eigen/Dense>
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <suture/base/Errors.hpp>

#include "PolynomialStresses.hpp"

namespace suture {
namespace stresses {

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
double quadraticForm(const StressElement<D>& element, const Vertices<D>& vertices, const Compliance<D>& compliance, const Vector& data) {
  Matrix gram;
  element.gram(mapOf<D>(vertices), compliance, gram);
  return data.dot(gram * data);
}

/// A simplex with edges of order one, except for one direction in which it is thinner by a factor.
template <int D>
Vertices<D> thinned(const Vertices<D>& vertices, double factor, Random& random) {
  const Direction<D> across = random.matrix<Direction<D>>(D, 1).normalized();
  return (Tensor<D>::Identity() - (1 - factor) * across * across.transpose()) * vertices;
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
