// Smooth surfaces through the nodes of straight-sided 3D meshes, against known surfaces.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Point.hpp>
#include <suture/pairs/mortar/SmoothFace.hpp>

#include <algorithm>

#include "SpaceScenes.hpp"

using namespace pairstesting;

namespace {

using Map = std::function<Point(Point)>;

/// Sides by their nodes.
struct Sheet {
  std::vector<Point> points;
  std::vector<std::vector<int>> sides;
  Surface surface() const { return Surface(3, points, sides); }
};

/// An octant of a sphere of radius 10 about the origin: a face of an octahedron in n^2 triangles, seen from the centre.
Sheet octant(int n) {
  Sheet sheet;
  const auto at = [n](int i, int j) { return i * (n + 1) - i * (i - 1) / 2 + j; };
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n - i; ++j) sheet.points.push_back(scaled(10, unit(Point{double(i), double(j), double(n - i - j)})));
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n - i; ++j) {
      sheet.sides.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + j + 1 < n) sheet.sides.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return sheet;
}

/// The rectangle [0, nx] x [0, ny] of unit squares, or of pairs of triangles with alternating diagonals, mapped.
Sheet grid(int nx, int ny, bool triangles, const Map& map) {
  Sheet sheet;
  const auto at = [ny](int i, int j) { return i * (ny + 1) + j; };
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j) sheet.points.push_back(map({double(i), double(j), 0}));
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j) {
      const int a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
      if (!triangles)
        sheet.sides.push_back({a, b, c, d});
      else if ((i + j) % 2)
        sheet.sides.push_back({a, b, c}), sheet.sides.push_back({a, c, d});
      else
        sheet.sides.push_back({a, b, d}), sheet.sides.push_back({b, c, d});
    }
  return sheet;
}

/// Largest distances, by a function of place, of the elements and of the smooth surface over them.
struct Largest {
  double facets = 0, smooth = 0;
};
Largest largest(const Sheet& sheet, const std::function<double(Point)>& distance, const std::vector<int>& groups = {}) {
  const Surface surface = sheet.surface();
  const BoundarySurface smooth(surface, groups);
  Largest most;
  for (int side = 0; side < surface.sides(); ++side) {
    const MortarFace face(surface, side);
    const SmoothFace over(face, smooth.jets(side));
    for (const auto& [at, weight] : face.quadrature()) {
      const MortarFace::Place place = face.place(at);
      const Point out = unit(place.density);
      most.facets = std::max(most.facets, std::abs(distance(place.point)));
      const double way = over.way(place, over.spread(place.values), out);
      most.smooth = std::max(most.smooth, std::abs(distance(plus(place.point, scaled(way, out)))));
    }
  }
  return most;
}

double fromSphere(const Point& p) { return norm(p) - 10; }

/// A plane of the given number of columns that continues, after a kink by the angle `turn`, as a cylinder of radius 10 in columns of .1
/// radians.
Map planeAndCylinder(int columns, double turn) {
  return [=](Point p) {
    if (p[0] <= columns) return Point{p[0] - columns, p[1], 0};
    const double angle = 0.1 * (p[0] - columns), x = 10 * std::sin(angle), z = 10 * std::cos(angle) - 10;
    return Point{x * std::cos(turn) + z * std::sin(turn), p[1], z * std::cos(turn) - x * std::sin(turn)};
  };
}
double fromPlaneAndCylinder(const Point& p, double turn) {
  if (p[0] <= 0) return p[2];
  return std::hypot(p[0] + 10 * std::sin(turn), p[2] + 10 * std::cos(turn)) - 10;
}

TEUCHOS_UNIT_TEST(BoundarySurface, LiesOnASphereOfTriangles) {
  // Measured on meshes of these sizes and another pattern by another program: .11 .033 .0084, by four passes 1.1e-6, 2.6e-9, 2e-12.
  const double bands[] = {1.1e-6, 2.6e-9, 2e-12};
  int n = 9;
  for (const double band : bands) {
    const Largest most = largest(octant(n), fromSphere);
    out << n << ": " << most.facets << " " << most.smooth << "\n";
    TEST_COMPARE(most.facets, >, 0.09 * 81 / (n * n));
    TEST_COMPARE(most.smooth, <, band);
    n *= 2;
  }
}

TEUCHOS_UNIT_TEST(BoundarySurface, LiesOnASphereOfWarpedQuadrilaterals) {
  for (const double sign : {1.0, -1.0}) {
    const Sheet sheet = grid(8, 8, false, [sign](Point p) {
      return scaled(10, unit(Point{0.1 * (p[0] - 3), sign * (0.12 * (p[1] - 5) + 0.01 * p[0]), 1 + 0.02 * p[0]}));
    });
    const Largest most = largest(sheet, fromSphere);
    out << most.facets << " " << most.smooth << "\n";
    TEST_COMPARE(most.facets, >, 0.01);
    TEST_COMPARE(most.smooth, <, 1e-8);
  }
}

TEUCHOS_UNIT_TEST(BoundarySurface, IsOfThirdOrderOnAnEllipsoid) {
  const Point axes{1, 0.8, 0.6};
  const auto distance = [&](const Point& p) {  // to the first order
    Point q = p, gradient = p;
    for (int k = 0; k < 3; ++k) q[k] /= axes[k], gradient[k] = q[k] / axes[k];
    return (norm(q) - 10) * norm(q) / norm(gradient);
  };
  std::vector<double> smooth;
  for (const int n : {9, 18, 36}) {
    Sheet sheet = octant(n);
    for (Point& point : sheet.points)
      for (int k = 0; k < 3; ++k) point[k] *= axes[k];
    const Largest most = largest(sheet, distance);
    out << n << ": " << most.facets << " " << most.smooth << "\n";
    smooth.push_back(most.smooth);
  }
  TEST_COMPARE(smooth[0], <, 5.1e-3);
  TEST_COMPARE(smooth[1], <, 5.8e-4);
  TEST_COMPARE(smooth[2], <, 7.4e-5);
}

TEUCHOS_UNIT_TEST(BoundarySurface, DoesNotLeakFromACylinderIntoAPlane) {
  for (const bool triangles : {true, false})
    for (const double turn : {0.0, 0.4, -0.4}) {  // smooth, a kink outward, one inward
      const Sheet sheet = grid(10, 4, triangles, planeAndCylinder(4, turn));
      const Largest most = largest(sheet, [&](const Point& p) { return fromPlaneAndCylinder(p, turn); });
      out << triangles << " " << turn << ": " << most.facets << " " << most.smooth << "\n";
      TEST_COMPARE(most.facets, >, 0.01);
      TEST_COMPARE(most.smooth, <, 1e-9);
      const Surface surface = sheet.surface();
      const BoundarySurface smooth(surface);
      for (int side = 0; side < surface.sides(); ++side) {
        bool inPlane = true;
        for (const int node : surface.nodesOf(side)) inPlane = inPlane && surface.at(node).position[0] < 1e-9;
        TEST_EQUALITY(smooth.jets(side).empty(), inPlane);
      }
    }
}

TEUCHOS_UNIT_TEST(BoundarySurface, KeepsAKinkBetweenCylinders) {
  // Two cylinders of radius 10 that meet at 24 degrees, by columns of .1 radians.
  const auto bent = [](Point p) {
    const double angle = 0.1 * std::abs(p[0] - 5) + 0.2, sign = p[0] < 5 ? -1 : 1;
    return Point{sign * 10 * (std::sin(angle) - std::sin(0.2)), p[1], 10 * std::cos(angle)};
  };
  for (const bool triangles : {true, false}) {
    const Largest most =
        largest(grid(10, 4, triangles, bent), [](const Point& p) { return std::hypot(std::abs(p[0]) + 10 * std::sin(0.2), p[2]) - 10; });
    out << most.facets << " " << most.smooth << "\n";
    TEST_COMPARE(most.smooth, <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(BoundarySurface, EndsBetweenGroups) {
  // A plane of one column next to a cylinder: from the nodes alone it looks like a coarse cylinder.
  const Sheet sheet = grid(7, 4, false, planeAndCylinder(1, 0.0));
  std::vector<int> groups;
  for (const auto& nodes : sheet.sides) groups.push_back(sheet.points[nodes[0]][0] < -0.5 ? 0 : 1);
  TEST_COMPARE(largest(
                   sheet, [](const Point& p) { return fromPlaneAndCylinder(p, 0.0); }, groups)
                   .smooth,
               <, 1e-9);
}

TEUCHOS_UNIT_TEST(BoundarySurface, IsExactOnOneLayerOfACylinder) {
  for (const bool triangles : {true, false})
    for (const double sign : {1.0, -1.0}) {
      const Sheet sheet = grid(9, 1, triangles, [sign](Point p) {
        const double angle = 0.005 * p[0] * (p[0] + 12);  // graded
        return Point{10 * std::sin(angle), sign * p[1], 10 * std::cos(angle)};
      });
      const Largest most = largest(sheet, [](const Point& p) { return std::hypot(p[0], p[2]) - 10; });
      out << most.facets << " " << most.smooth << "\n";
      TEST_COMPARE(most.smooth, <, 1e-9);
    }
}

TEUCHOS_UNIT_TEST(BoundarySurface, IsThePlaneOfFlatSides) {
  const Turned turned({1, 2, 3}, 0.7);
  for (const bool triangles : {true, false})
    for (const int rows : {1, 5}) {
      const Sheet sheet = grid(6, rows, triangles, [&](Point p) { return turned({p[0] + 0.1 * p[1] * p[1], p[1] * 1.3, 0.4}); });
      const BoundarySurface smooth(sheet.surface());
      for (std::size_t side = 0; side < sheet.sides.size(); ++side) TEST_ASSERT(smooth.jets(int(side)).empty());
    }
}

TEUCHOS_UNIT_TEST(BoundarySurface, HasNoUnitOfLength) {
  for (const double scale : {1e-6, 1e6}) {
    const auto wave = [](Point p) { return Point{p[0], p[1], 0.05 * p[0] * p[0] + 0.03 * p[0] * p[1] - 0.02 * p[1] * p[1]}; };
    for (const bool triangles : {true, false}) {
      const Sheet one = grid(5, 4, triangles, wave), other = grid(5, 4, triangles, [&](Point p) { return scaled(scale, wave(p)); });
      const BoundarySurface a(one.surface()), b(other.surface());
      for (std::size_t side = 0; side < one.sides.size(); ++side)
        for (std::size_t i = 0; i < a.jets(int(side)).size(); ++i) {
          const BoundarySurface::Jet &mine = a.jets(int(side))[i], &its = b.jets(int(side)).at(i);
          TEST_COMPARE(norm(minus(mine.normal, its.normal)), <, 1e-12);
          for (int k = 0; k < 3; ++k) TEST_COMPARE(norm(minus(mine.bend[k], scaled(scale, its.bend[k]))), <, 1e-12);
        }
    }
  }
}

TEUCHOS_UNIT_TEST(FaceSampling, TakesTheGapBetweenConcentricSpheres) {
  // Shells from radius 9 to 10 and from 10.02 to 11, of different meshes.
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4})
    for (const Contact::Geometry geometry : {Contact::Geometry::Automatic, Contact::Geometry::Smooth, Contact::Geometry::Facets}) {
      Mesh mesh = facing(cell, 4, 3, cell, 3, 3, 0.02);
      moveAll(mesh, [](Point p) { return scaled(10 + p[2], unit(Point{0.4 * (p[0] - 1), 0.4 * (p[1] - 0.75), 1})); });
      Contact contact = Contact::between("lower_top", "upper_bottom");
      contact.coupling = Contact::Coupling::Mortar, contact.geometry = geometry;
      const PairedSurface paired = pairsOf(mesh, contact);
      double worst = 0, doubt = 0;
      for (const ContactPair& pair : paired.pairs) worst = std::max(worst, std::abs(pair.gap - 0.02));
      for (const double one : paired.gapDoubts) doubt = std::max(doubt, std::abs(one));
      out << worst << " " << doubt << "\n";
      const bool facets = geometry == Contact::Geometry::Facets;
      if (facets) {
        TEST_COMPARE(worst, >, 1e-2);
        TEST_COMPARE(doubt, >, 1e-2);
      } else {
        TEST_COMPARE(worst, <, 4e-4);
        TEST_COMPARE(doubt, <, 1e-10);  // no uncertainty on spheres
      }
      TEST_EQUALITY(paired.gapDoubts.size(), paired.pairs.size());
    }
}

TEUCHOS_UNIT_TEST(FaceSampling, SharesTheCurvatureOfASphereOnAPlane) {
  // Pressed together both have half the curvature: the closed gap of a sphere of radius R before a plane at the height g is that of its
  // elements, less half of the sphere's height over them, and the plane rises by half of its elements' spread.
  Mesh mesh = facing(Cell::Hexahedron8, 4, 3, Cell::Hexahedron8, 4, 3, 0.1);
  move(mesh, 1, [](Point p) {
    const double x = p[0] - 1, y = p[1] - 0.75;
    return Point{p[0], p[1], p[2] + 9 - std::sqrt(81 - x * x - y * y)};
  });
  std::map<Contact::Geometry, std::vector<double>> gaps;
  for (const Contact::Geometry geometry : {Contact::Geometry::Automatic, Contact::Geometry::Smooth, Contact::Geometry::Facets}) {
    Contact contact = Contact::between("lower_top", "upper_bottom");
    contact.coupling = Contact::Coupling::Mortar, contact.geometry = geometry, contact.carrier = Contact::Carrier::SideA;
    for (const ContactPair& pair : pairsOf(mesh, contact).pairs) gaps[geometry].push_back(pair.gap);
  }
  // For equal bodies and meshes the sphere's convex half and the plane's concave half cancel: the gap is that of the facets, to the second
  // order of the angle between the normals, up to 0.14 on the rim.
  for (std::size_t i = 0; i < gaps[Contact::Geometry::Facets].size(); ++i) {
    const double facet = gaps[Contact::Geometry::Facets][i], smooth = gaps[Contact::Geometry::Smooth][i];
    TEST_COMPARE(facet - smooth, >, 2e-3);
    TEST_COMPARE(std::abs(gaps[Contact::Geometry::Automatic][i] - facet), <, 0.07 * (facet - smooth));
  }
}

}  // namespace
