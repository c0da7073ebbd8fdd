// Pressures with the moments of given ones, which are checked by quadrature; forces that no pressure balances.
#include "PressedLines.hpp"

#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace suture {
namespace {

double largestOf(const std::vector<double>& values) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  return largest;
}

/// What a user of the pressures relies on, relative to the largest force or pressure.
struct Checks {
  double negative = 0;    // most negative value of p on a fine sampling
  double unbalanced = 0;  // |force - rest - integral of p phi|
  double resultant = 0;   // of the rest of a cluster: force, and moment about its mean place / extent
  double outside = 0;     // rest outside of clusters
};

Checks checked(const PressedSides& sides, const Pressures& pressures) {
  Checks found;
  const double force = largestOf(sides.forces), pressure = pressures.values.cwiseAbs().maxCoeff();
  std::vector<double> balance = sides.forces;
  for (int side = 0; side < sides.sides(); ++side) {
    const auto valueAt = [&](const std::vector<double>& at) {
      const std::vector<double> phi = lagrange(sides, at);
      double value = 0;
      for (std::size_t i = 0; i < phi.size(); ++i) value += phi[i] * pressures.values(Eigen::Index(i), side);
      return value;
    };
    for (const SidePoint& point : quadrature(sides.dimension)) {
      const std::vector<double> phi = lagrange(sides, point.at);
      for (std::size_t i = 0; i < phi.size(); ++i)
        balance[std::size_t(sides.nodesOf(side)[i])] -= sides.sizes[std::size_t(side)] * point.weight * valueAt(point.at) * phi[i];
    }
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; i + j <= 10; ++j) {
        const std::vector<double> at =
            sides.dimension == 2 ? std::vector<double>{0.1 * i, 1 - 0.1 * i} : std::vector<double>{0.1 * i, 0.1 * j, 1 - 0.1 * i - 0.1 * j};
        found.negative = std::max(found.negative, -valueAt(at) / pressure);
      }
  }
  std::vector<char> isInside(sides.places.size(), 0);
  for (const std::vector<int>& cluster : pressures.clusters) {
    Point mean{}, moment{};
    double sum = 0, extent = 0;
    for (const int node : cluster)
      for (std::size_t d = 0; d < 3; ++d) mean[d] += sides.places[std::size_t(node)][d] / double(cluster.size());
    for (const int node : cluster) {
      if (isInside[std::size_t(node)]) throw std::logic_error("clusters have common nodes");
      isInside[std::size_t(node)] = 1;
      sum += pressures.rest[std::size_t(node)];
      for (std::size_t d = 0; d < 3; ++d) {
        const double arm = sides.places[std::size_t(node)][d] - mean[d];
        extent = std::max(extent, std::abs(arm));
        moment[d] += arm * pressures.rest[std::size_t(node)];
      }
    }
    found.resultant = std::max({found.resultant, std::abs(sum) / force, largestOf({moment[0], moment[1]}) / (extent * force)});
  }
  for (std::size_t node = 0; node < balance.size(); ++node) {
    found.unbalanced = std::max(found.unbalanced, std::abs(balance[node] - pressures.rest[node]) / force);
    if (!isInside[node]) found.outside = std::max(found.outside, std::abs(pressures.rest[node]) / force);
  }
  return found;
}

/// Tests that all checks hold; returns the pressures.
Pressures valid(const PressedSides& sides, bool& success, Teuchos::FancyOStream& out) {
  const Pressures pressures = admissiblePressures(sides);
  const Checks found = checked(sides, pressures);
  TEST_ASSERT(pressures.feasible);
  TEST_COMPARE(pressures.misfit, <=, 1e-12);
  TEST_COMPARE(found.negative, <=, 1e-14);
  TEST_COMPARE(found.unbalanced, <=, 1e-12);
  TEST_COMPARE(found.resultant, <=, 1e-12);
  TEST_EQUALITY(found.outside, 0);
  return pressures;
}

std::size_t largestCluster(const Pressures& pressures) {
  std::size_t largest = 0;
  for (const auto& cluster : pressures.clusters) largest = std::max(largest, cluster.size());
  return largest;
}

double uniform01(std::mt19937& random) { return std::uniform_real_distribution<double>(0, 1)(random); }

/// Lines and squares, regular and irregular.
std::vector<PressedSides> surfaces(int degree) {
  std::mt19937 random(3);
  return {pressedLine(steps(40, 0, random), degree), pressedLine(steps(300, 0.9, random), degree), pressedSquare(6, degree, 0),
          pressedSquare(12, degree, 0.3)};
}

TEUCHOS_UNIT_TEST(ContactPressures, HaveTheMomentsOfRandomPressures) {
  std::mt19937 random(11);
  for (const int degree : {1, 2})
    for (PressedSides& sides : surfaces(degree)) {
      press(sides, [&](int, int) { return uniform01(random); });
      TEST_ASSERT(valid(sides, success, out).clusters.empty());
    }
}

// Half of the coefficients are zero; zones without any pressure separate parts.
TEUCHOS_UNIT_TEST(ContactPressures, HaveTheMomentsOfPressuresWithZeros) {
  std::mt19937 random(12);
  for (const int degree : {1, 2})
    for (PressedSides& sides : surfaces(degree)) {
      press(sides, [&](int side, int node) {
        return std::fmod(10 * placeOf(sides, side, node)[0], 2) < 1 && uniform01(random) < 0.5 ? uniform01(random) : 0.0;
      });
      const Pressures pressures = valid(sides, success, out);
      TEST_COMPARE(largestOf(pressures.rest), <=, 1e-6 * largestOf(sides.forces));  // forces on the boundary of what p >= 0 balances
    }
}

TEUCHOS_UNIT_TEST(ContactPressures, HaveTheMomentsOfHertzAndOfSharpEnds) {
  for (const int degree : {1, 2})
    for (const bool isSharp : {false, true})
      for (PressedSides& sides : surfaces(degree)) {
        press(sides, [&](int side, int node) {
          const Point at = placeOf(sides, side, node);
          const double r2 = std::pow(2 * at[0] - 1, 2) + (sides.dimension == 3 ? std::pow(2 * at[1] - 1, 2) : 0.0);
          return isSharp ? 1 / std::sqrt(std::max(1e-4, std::abs(1 - r2))) : std::sqrt(std::max(0.0, 0.5 - r2));
        });
        TEST_ASSERT(valid(sides, success, out).clusters.empty());
      }
}

// For smooth pressures p has second order, except near the ends of a contact.
TEUCHOS_UNIT_TEST(ContactPressures, AreCloseToSmoothPressures) {
  const auto errorOf = [](int count, int degree) {
    std::mt19937 random(5);
    PressedSides sides = pressedLine(steps(count, 0, random), degree);
    const auto exact = [](double x) { return 1 + std::sin(3 * x); };
    for (int side = 0; side < sides.sides(); ++side)
      for (const SidePoint& point : quadrature(2)) {
        const double x = point.at[0] * placeOf(sides, side, 0)[0] + point.at[1] * placeOf(sides, side, 1)[0];
        const std::vector<double> phi = lagrange(sides, point.at);
        for (std::size_t i = 0; i < phi.size(); ++i)
          sides.forces[std::size_t(sides.nodesOf(side)[i])] += sides.sizes[std::size_t(side)] * point.weight * exact(x) * phi[i];
      }
    const Pressures pressures = admissiblePressures(sides);
    double error = 0;
    for (int side = 8; side + 8 < sides.sides(); ++side)  // at the ends the smooth estimate has first order
      for (int i = 0; i < sides.sideNodes(); ++i)
        error = std::max(error, std::abs(pressures.values(i, side) - exact(placeOf(sides, side, i)[0])));
    return error;
  };
  for (const int degree : {1, 2}) {
    TEST_COMPARE(errorOf(20, degree), <=, 0.02);
    TEST_COMPARE(errorOf(80, degree), <=, errorOf(20, degree) / 8);
  }
}

TEUCHOS_UNIT_TEST(ContactPressures, BalanceResultantsWhereNodesDoNot) {
  std::mt19937 random(13);
  for (const int degree : {1, 2})
    for (PressedSides& sides : surfaces(degree)) {
      const int inner = sides.dimension == 2 ? 20 : sides.count() > 200 ? 6 * 13 + 6 : 3 * 7 + 3;
      sides.forces[std::size_t(inner)] = 2.5;  // one closed vertex
      const Pressures pressures = valid(sides, success, out);
      TEST_EQUALITY(pressures.clusters.size(), 1);
      // Only the sides that meet there can carry pressure.
      for (int side = 0; side < sides.sides(); ++side)
        if (std::find(sides.nodesOf(side), sides.nodesOf(side) + sides.vertices(), inner) == sides.nodesOf(side) + sides.vertices())
          TEST_EQUALITY(pressures.values.col(side).cwiseAbs().maxCoeff(), 0);
    }
}

TEUCHOS_UNIT_TEST(ContactPressures, AcceptAlternatingForcesAndForcesOfVerticesOnly) {
  for (const int degree : {1, 2})
    for (PressedSides& sides : surfaces(degree)) {
      const int vertices = sides.dimension == 2 ? int(sides.sides()) + 1 : sides.sides() == 72 ? 49 : 169;
      for (int i = 1; i < vertices - 1; i += 2) sides.forces[std::size_t(i)] = 1;
      TEST_ASSERT(!valid(sides, success, out).clusters.empty());
      if (degree == 1) continue;
      std::fill_n(sides.forces.begin(), vertices, 1.0);
      TEST_ASSERT(!valid(sides, success, out).clusters.empty());
    }
}

// Constant pressure with one force that no p >= 0 balances there: the cluster stays around it, the other sides keep the exact pressure.
TEUCHOS_UNIT_TEST(ContactPressures, KeepClustersSmall) {
  for (const int degree : {1, 2}) {
    PressedSides line = pressedLine(
        [] {
          std::vector<double> x(201);
          std::iota(x.begin(), x.end(), 0.0);
          return x;
        }(),
        degree);
    press(line, [](int, int) { return 1.0; });
    for (const std::size_t node : {std::size_t(0), std::size_t(100)}) {
      PressedSides changed = line;
      changed.forces[node] *= 5;
      const Pressures pressures = valid(changed, success, out);
      TEST_EQUALITY(pressures.clusters.size(), 1);
      TEST_COMPARE(largestCluster(pressures), <=, 5);
      for (int side = 0; side < changed.sides(); ++side)
        if (std::abs(side - int(node)) > 20) TEST_COMPARE((pressures.values.col(side).array() - 1).abs().maxCoeff(), <=, 1e-3);
    }
    PressedSides square = pressedSquare(20, degree, 0.25);
    press(square, [](int, int) { return 1.0; });
    square.forces[10 * 21 + 10] += 20 * square.sizes[0];
    const Pressures pressures = valid(square, success, out);
    TEST_EQUALITY(pressures.clusters.size(), 1);
    TEST_COMPARE(largestCluster(pressures), <=, 40);
  }
}

// A force at the very end of a line or the corner of a square is not the resultant of any pressure.
TEUCHOS_UNIT_TEST(ContactPressures, ReportResultantsThatNoPressureHas) {
  for (const int degree : {1, 2})
    for (PressedSides& sides : surfaces(degree)) {
      sides.forces[0] = 1;
      TEST_ASSERT(!admissiblePressures(sides).feasible);
      sides.forces[0] = -1;  // tension
      TEST_ASSERT(!admissiblePressures(sides).feasible);
    }
  PressedSides lonely = surfaces(1)[0];
  lonely.places.push_back({9, 0, 0});
  lonely.forces.push_back(1);  // a node without sides
  const Pressures pressures = admissiblePressures(lonely);
  TEST_ASSERT(!pressures.feasible);
  TEST_EQUALITY(pressures.misfit, 1);
  const Pressures none = admissiblePressures(surfaces(2)[2]);  // no force at all
  TEST_ASSERT(none.feasible);
  TEST_EQUALITY(none.values.cwiseAbs().maxCoeff(), 0);
}

/// Pressures with a cluster: part exact, part resultants.
PressedSides mixed(int dimension, int degree) {
  std::mt19937 random(17);
  PressedSides sides = dimension == 2 ? pressedLine(steps(60, 0.6, random), degree) : pressedSquare(9, degree, 0.3);
  press(sides, [&](int, int) { return 0.5 + uniform01(random); });
  sides.forces[dimension == 2 ? 30 : 45] += 8 * *std::max_element(sides.forces.begin(), sides.forces.end());
  return sides;
}

TEUCHOS_UNIT_TEST(ContactPressures, DoNotDependOnUnits) {
  for (const int dimension : {2, 3})
    for (const int degree : {1, 2}) {
      const PressedSides sides = mixed(dimension, degree);
      const Pressures pressures = valid(sides, success, out);
      PressedSides scaledSides = sides;
      const double length = 1e-3, force = 1e9;
      for (double& f : scaledSides.forces) f *= force;
      for (double& size : scaledSides.sizes) size *= std::pow(length, dimension - 1);
      for (Point& place : scaledSides.places)
        for (double& x : place) x *= length;
      const Pressures other = valid(scaledSides, success, out);
      const double unit = force / std::pow(length, dimension - 1), largest = pressures.values.maxCoeff();
      TEST_ASSERT(!pressures.clusters.empty());
      TEST_ASSERT(other.clusters == pressures.clusters);
      TEST_COMPARE((other.values / unit - pressures.values).cwiseAbs().maxCoeff(), <=, 1e-9 * largest);
    }
}

TEUCHOS_UNIT_TEST(ContactPressures, DoNotDependOnNumbers) {
  for (const int dimension : {2, 3})
    for (const int degree : {1, 2}) {
      const PressedSides sides = mixed(dimension, degree);
      std::mt19937 random(19);
      std::vector<int> node(sides.places.size()), order(sides.sizes.size());
      std::iota(node.begin(), node.end(), 0), std::iota(order.begin(), order.end(), 0);
      std::shuffle(node.begin(), node.end(), random), std::shuffle(order.begin(), order.end(), random);
      PressedSides other = sides;
      for (std::size_t i = 0; i < node.size(); ++i)
        other.places[std::size_t(node[i])] = sides.places[i], other.forces[std::size_t(node[i])] = sides.forces[i];
      for (std::size_t k = 0; k < order.size(); ++k) {
        other.sizes[k] = sides.sizes[std::size_t(order[k])];
        for (int i = 0; i < sides.sideNodes(); ++i)
          other.nodes[k * std::size_t(sides.sideNodes()) + std::size_t(i)] = node[std::size_t(sides.nodesOf(order[k])[i])];
      }
      const Pressures first = valid(sides, success, out), second = valid(other, success, out);
      double difference = 0;
      for (std::size_t k = 0; k < order.size(); ++k)
        difference = std::max(difference, (second.values.col(Eigen::Index(k)) - first.values.col(order[k])).cwiseAbs().maxCoeff());
      TEST_COMPARE(difference, <=, 1e-6 * first.values.maxCoeff());
    }
}

TEUCHOS_UNIT_TEST(ContactPressures, RefuseInvalidSides) {
  std::mt19937 random(1);
  const PressedSides sides = pressedLine(steps(4, 0, random), 2);
  PressedSides bad = sides;
  bad.sizes[1] = 0;
  TEST_THROW(admissiblePressures(bad), std::exception);
  bad = sides;
  bad.nodes[3] = 99;
  TEST_THROW(admissiblePressures(bad), std::exception);
  bad = sides;
  bad.degree = 3;
  TEST_THROW(admissiblePressures(bad), std::exception);
  bad = sides;
  bad.forces[0] = std::nan("");
  TEST_THROW(admissiblePressures(bad), std::exception);
}

TEUCHOS_UNIT_TEST(GapLift, MakesGapsNonnegative) {
  std::mt19937 random(23);
  for (const int dimension : {2, 3}) {
    const PressedSides sides = dimension == 2 ? pressedLine(steps(400, 0.5, random), 2) : pressedSquare(12, 2, 0.3);
    std::vector<double> gap(sides.places.size());
    for (double& g : gap) g = uniform01(random) < 0.3 ? 0.0 : uniform01(random);
    for (int side = 0; side < sides.sides(); ++side)  // gaps of mid-edge nodes down to -0.5
      for (int i = sides.vertices(); i < sides.sideNodes(); ++i) gap[std::size_t(sides.nodesOf(side)[i])] = uniform01(random) - 0.5;
    Matrix gaps(sides.sideNodes(), sides.sides());
    for (int side = 0; side < sides.sides(); ++side)
      for (int i = 0; i < sides.sideNodes(); ++i) gaps(i, side) = gap[std::size_t(sides.nodesOf(side)[i])];
    const std::vector<double> lift = liftOfGaps(sides, gaps);
    double least = 0, least2 = 1;
    int lifted = 0, kept = 0;
    for (int side = 0; side < sides.sides(); ++side) {
      double before = 1, after = 1;
      for (int i = 0; i <= 100; ++i)
        for (int j = 0; j <= (dimension == 2 ? 0 : 100 - i); ++j) {
          const std::vector<double> at = dimension == 2 ? std::vector<double>{0.01 * i, 1 - 0.01 * i}
                                                        : std::vector<double>{0.01 * i, 0.01 * j, 1 - 0.01 * i - 0.01 * j};
          const std::vector<double> phi = lagrange(sides, at);
          double old = 0, now = 0;
          for (int k = 0; k < sides.sideNodes(); ++k) {
            old += phi[std::size_t(k)] * gaps(k, side);
            now += phi[std::size_t(k)] * (gaps(k, side) + lift[std::size_t(sides.nodesOf(side)[k])]);
          }
          before = std::min(before, old), after = std::min(after, now);
        }
      least = std::min(least, after);
      double most = 0;
      for (int k = sides.vertices(); k < sides.sideNodes(); ++k) most = std::max(most, lift[std::size_t(sides.nodesOf(side)[k])]);
      // In 2D each middle node has one side: no lift without penetration, and a lifted gap touches zero.
      if (dimension == 2 && most > 1e-3) TEST_COMPARE(after, <=, 1e-3);
      if (dimension == 2 && before > 1e-3) TEST_EQUALITY(most, 0);
      (most > 0 ? lifted : kept) += 1;
      least2 = std::min(least2, before);
    }
    TEST_COMPARE(least, >=, -1e-15);
    TEST_COMPARE(least2, <=, -0.1);
    TEST_COMPARE(lifted, >, 20);
    if (dimension == 2) TEST_COMPARE(kept, >, 20);
  }
}

// Squares of linear functions, which touch zero inside of the triangle, need no lift: the condition is exact, not that of coefficients.
TEUCHOS_UNIT_TEST(GapLift, IsZeroForSquares) {
  std::mt19937 random(29);
  PressedSides sides = pressedSquare(1, 2, 0);
  for (int trial = 0; trial < 200; ++trial) {
    const double c[3] = {uniform01(random) - 0.5, uniform01(random) - 0.5, uniform01(random) - 0.5};
    Matrix gaps(6, 2);
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < 6; ++i) {
        const Point at = placeOf(sides, side, i);
        gaps(i, side) = std::pow(c[0] + c[1] * at[0] + c[2] * at[1], 2);
      }
    TEST_COMPARE(largestOf(liftOfGaps(sides, gaps)), <=, 1e-8);
    gaps.array() -= 0.1;  // vertices may be negative by round-off only: keep them
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < 3; ++i) gaps(i, side) += 0.1;
    const double c0 = gaps(3, 0);
    if (c0 < 0) TEST_COMPARE(largestOf(liftOfGaps(sides, gaps)), >, 0);
  }
  TEST_EQUALITY(largestOf(liftOfGaps(pressedSquare(2, 1, 0), Matrix::Constant(3, 8, -1.0))), 0);  // degree 1
}

TEUCHOS_UNIT_TEST(GapLift, WorkIsTheIntegralOfPressureTimesGap) {
  std::mt19937 random(31);
  for (const int degree : {1, 2})
    for (const PressedSides& sides : surfaces(degree)) {
      Matrix p(sides.sideNodes(), sides.sides()), g = p;
      double expected = 0;
      for (int side = 0; side < sides.sides(); ++side) {
        for (int i = 0; i < sides.sideNodes(); ++i) p(i, side) = uniform01(random), g(i, side) = uniform01(random);
        for (const SidePoint& point : quadrature(sides.dimension)) {
          const std::vector<double> phi = lagrange(sides, point.at);
          double pressure = 0, gap = 0;
          for (int i = 0; i < sides.sideNodes(); ++i) pressure += phi[std::size_t(i)] * p(i, side), gap += phi[std::size_t(i)] * g(i, side);
          expected += sides.sizes[std::size_t(side)] * point.weight * pressure * gap;
        }
      }
      TEST_FLOATING_EQUALITY(gapWork(sides, p, g), expected, 1e-13);
    }
}

}  // namespace
}  // namespace suture
