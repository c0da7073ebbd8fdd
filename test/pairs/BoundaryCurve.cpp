// Curvature from the nodes of a line, against known curves.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/pairs/mortar/BoundaryCurve.hpp>

#include <algorithm>

#include "PairsTesting.hpp"

namespace {

using namespace pairstesting;

/// A strip whose lower side, of the given number of elements, follows a curve of the parameter t from 0 to 1; the body is above.
Mesh strip(int elements, const std::function<Point(double)>& curve, Cell cell = Cell::Triangle3) {
  Box box;
  box.name = "strip";
  box.x1 = 1, box.y1 = 1, box.nx = elements, box.ny = 1, box.cell = cell;
  Mesh mesh = boxes({box});
  assignBodies(mesh, {"strip"});
  moveAll(mesh, [&](Point p) {
    const Point at = curve(p[0]);
    return Point{at[0], at[1] + p[1], 0};
  });
  return mesh;
}
const std::vector<Side>& lower(const Mesh& mesh) { return mesh.sideGroups.at("strip_bottom"); }

/// Largest f(point of the smooth line) over all sides and a few points of each.
double largest(const Mesh& mesh, const std::function<double(Point)>& f) {
  const BoundaryCurve curve(Surface(mesh, lower(mesh)));
  double most = 0;
  for (std::size_t s = 0; s < lower(mesh).size(); ++s) {
    const std::vector<int> nodes = mesh.nodesOf(lower(mesh)[s]);
    const Point a = mesh.point(nodes[0]), b = mesh.point(nodes[1]), chord = minus(b, a);
    for (double xi = -1; xi < 1.01; xi += 0.25) {
      const double height = arcOver(curve.bend(s).at(xi), norm(chord), xi).height, h = norm(chord);
      const Point at{(a[0] * (1 - xi) + b[0] * (1 + xi)) / 2 + height * chord[1] / h,
                     (a[1] * (1 - xi) + b[1] * (1 + xi)) / 2 - height * chord[0] / h, 0};
      most = std::max(most, std::abs(f(at)));
    }
  }
  return most;
}

TEUCHOS_UNIT_TEST(BoundaryCurve, IsExactOnGradedArcs) {
  // A body above a convex arc, and one above a concave arc; spacings grow by a factor of ten.
  for (const double sign : {1.0, -1.0}) {
    const auto arc = [&](double t) {
      const double angle = 1.2 * (t * t + 0.1 * t) / 1.1 - 0.6;
      return Point{3 * std::sin(angle), -sign * 3 * std::cos(angle), 0};
    };
    const Mesh mesh = strip(9, arc);
    TEST_COMPARE(largest(mesh, [](Point p) { return std::hypot(p[0], p[1]) - 3; }), <, 1e-13);
    const BoundaryCurve curve(Surface(mesh, lower(mesh)));
    for (std::size_t s = 0; s < lower(mesh).size(); ++s) {
      TEST_FLOATING_EQUALITY(curve.bend(s).at(0.3), sign / 3, 1e-12);
      TEST_COMPARE(std::abs(curve.bend(s).doubt), <, 1e-12);
    }
  }
}

TEUCHOS_UNIT_TEST(BoundaryCurve, IsZeroToTheLastBitOnStraightLines) {
  for (const double slope : {0.0, 0.3, 1.7}) {
    const Mesh mesh = strip(13, [&](double t) { return Point{1e3 + 7.3 * t * t + t, slope * (7.3 * t * t + t), 0}; });
    const BoundaryCurve curve(Surface(mesh, lower(mesh)));
    for (std::size_t s = 0; s < lower(mesh).size(); ++s) {
      TEST_EQUALITY(curve.bend(s).begin, 0.0);
      TEST_EQUALITY(curve.bend(s).end, 0.0);
      TEST_EQUALITY(arcOver(curve.bend(s).at(0.1), 1.0, 0.1).height, 0.0);
    }
  }
}

// A line of length 1, then an arc of radius 2; eight elements each, with a node at the joint.
TEUCHOS_UNIT_TEST(BoundaryCurve, KeepsTheJointOfALineAndAnArc) {
  const auto curve = [](double t) {
    if (t <= 0.5) return Point{2 * t - 1, 0, 0};
    const double angle = 1.4 * (t - 0.5);
    return Point{2 * std::sin(angle), 2 - 2 * std::cos(angle), 0};
  };
  const Mesh mesh = strip(16, curve);
  TEST_COMPARE(largest(mesh, [](Point p) { return p[0] < 0 ? p[1] : std::hypot(p[0], p[1] - 2) - 2; }), <, 1e-13);
}

TEUCHOS_UNIT_TEST(BoundaryCurve, KeepsKinksAndCorners) {
  for (const double angle : {0.2, 0.6, 1.2}) {  // the last one is a corner
    const auto curve = [&](double t) {
      return t <= 0.5 ? Point{t - 0.5, 0, 0} : Point{(t - 0.5) * std::cos(angle), (t - 0.5) * std::sin(angle), 0};
    };
    const auto away = [&](Point p) { return p[0] < 0 ? p[1] : p[1] * std::cos(angle) - p[0] * std::sin(angle); };
    TEST_COMPARE(largest(strip(10, curve), away), <, 1e-15);
  }
}

// A polygon of six sides, two elements each: every other node lies in the middle of a side.
TEUCHOS_UNIT_TEST(BoundaryCurve, KeepsPolygonsOfTwoElementsASide) {
  const double turn = pi / 6;
  const auto corner = [&](int k) { return Point{std::sin((k - 3) * turn), -std::cos((k - 3) * turn), 0}; };
  const auto polygon = [&](double t) {
    const int i = int(std::lround(12 * t));
    const Point a = corner(i / 2), b = corner((i + 1) / 2);
    return Point{(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, 0};
  };
  const auto away = [&](Point p) {
    double out = -1;
    for (int k = 0; k < 6; ++k) out = std::max(out, p[0] * std::sin((k - 2.5) * turn) - p[1] * std::cos((k - 2.5) * turn));
    return out - std::cos(turn / 2);
  };
  TEST_COMPARE(largest(strip(12, polygon), away), <, 1e-15);
}

// One element cuts a corner: chamfer and fillet cannot be distinguished, as its uncertainty shows. The lines are lines.
TEUCHOS_UNIT_TEST(BoundaryCurve, KeepsLinesBesideAChamfer) {
  const double turn = 0.6;
  const auto chamfer = [&](double t) {
    const int i = int(std::lround(7 * t));
    const double u = std::max(0, i - 3) > 0 ? 0.5 : 0.0, v = std::max(0, i - 4);
    return Point{std::min(i, 3) + u * std::cos(turn) + v * std::cos(2 * turn), u * std::sin(turn) + v * std::sin(2 * turn), 0};
  };
  const Mesh mesh = strip(7, chamfer);
  const BoundaryCurve curve(Surface(mesh, lower(mesh)));
  int lines = 0;
  for (std::size_t s = 0; s < lower(mesh).size(); ++s) {
    const std::vector<int> nodes = mesh.nodesOf(lower(mesh)[s]);
    const auto& bend = curve.bend(s);
    if (norm(minus(mesh.point(nodes[1]), mesh.point(nodes[0]))) < 0.9) {
      TEST_FLOATING_EQUALITY(std::abs(bend.doubt), std::abs(bend.at(0)), 1e-9);
      continue;
    }
    TEST_EQUALITY(bend.at(0), 0.0);
    TEST_EQUALITY(bend.doubt, 0.0);
    ++lines;
  }
  TEST_EQUALITY(lines, 6);
}

// Lines of long elements, and between them an arc of radius 2 of two elements. The curvature at the joints is a mean of line and arc.
TEUCHOS_UNIT_TEST(BoundaryCurve, FindsTheArcOfAFilletOfTwoElements) {
  const double half = 0.2;
  for (const double spacing : {0.3, 1.0, 3.0}) {  // spacing on the lines, the arc's being 0.4
    const auto fillet = [&](double t) {
      const double i = 8 * t - 4;
      if (std::abs(i) < 1.5) return Point{2 * std::sin(i * half), 2 - 2 * std::cos(i * half), 0};
      const double along = (std::abs(i) - 1) * spacing, side = i < 0 ? -1 : 1;
      return Point{side * (2 * std::sin(half) + along * std::cos(half)), 2 - 2 * std::cos(half) + along * std::sin(half), 0};
    };
    const auto away = [&](Point p) {
      const double x = std::abs(p[0]);
      return x < 2 * std::sin(half) ? std::hypot(x, p[1] - 2) - 2 : (2 - p[1]) * std::cos(half) + x * std::sin(half) - 2;
    };
    TEST_COMPARE(largest(strip(8, fillet), away), <, 1e-13);
  }
}

// Halving the elements divides the distance to an ellipse by eight.
TEUCHOS_UNIT_TEST(BoundaryCurve, IsOfThirdOrderOnAnEllipse) {
  std::vector<double> error;
  for (const int n : {8, 16, 32, 64}) {
    const auto ellipse = [](double t) { return Point{2 * std::sin(2 * t - 1), 2 - std::cos(2 * t - 1), 0}; };
    error.push_back(largest(strip(n, ellipse), [](Point p) { return std::hypot(p[0] / 2, p[1] - 2) - 1; }));
    out << n << ": " << error.back() << "\n";
  }
  for (std::size_t i = 0; i + 1 < error.size(); ++i) TEST_COMPARE(std::log2(error[i] / error[i + 1]), >, 2.6);
}

// y = x^3: the curvature changes its sign in the middle.
TEUCHOS_UNIT_TEST(BoundaryCurve, PassesAnInflection) {
  std::vector<double> error;
  for (const int n : {20, 40, 80, 160}) {
    const Mesh mesh = strip(n, [](double t) { return Point{2 * t - 1, std::pow(2 * t - 1, 3) / 3, 0}; });
    error.push_back(largest(mesh, [](Point p) { return p[1] - p[0] * p[0] * p[0] / 3; }));
    out << n << ": " << error.back() << "\n";
  }
  for (std::size_t i = 0; i + 1 < error.size(); ++i) TEST_COMPARE(std::log2(error[i] / error[i + 1]), >, 2.6);
}

// Noise in the coordinates shows as uncertainty: second differences of curvatures.
TEUCHOS_UNIT_TEST(BoundaryCurve, DoubtsNoisyCoordinates) {
  const double noise = 1e-4;
  int k = 0;
  const Mesh mesh = strip(20, [&](double t) {
    const double angle = 1.2 * t - 0.6, radius = 10 + noise * std::sin(40 * pi * t * 0.37 + ++k);
    return Point{radius * std::sin(angle), -radius * std::cos(angle), 0};
  });
  const BoundaryCurve curve(Surface(mesh, lower(mesh)));
  double doubt = 0;
  for (std::size_t s = 0; s < lower(mesh).size(); ++s) doubt = std::max(doubt, std::abs(arcOver(curve.bend(s).doubt, 0.6, 0).height));
  TEST_COMPARE(doubt, >, 0.3 * noise);
  TEST_COMPARE(doubt, <, 10 * noise);
}

}  // namespace
