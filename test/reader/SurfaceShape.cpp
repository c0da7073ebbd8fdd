#include <suture/base/Point.hpp>
#include <suture/reader/cad/SurfaceShape.hpp>

#include <Teuchos_UnitTestHarness.hpp>

#include <cmath>
#include <functional>

using namespace suture;
using Kind = SurfaceShape::Kind;

namespace {

struct Samples {
  std::vector<Point> points, normals;
};

/// Frame in an oblique position: its axes are perpendicular unit vectors.
const Point origin{100, -20, 7}, axisZ = scaled(1 / std::sqrt(14.0), {1, 2, 3}), axisX = scaled(1 / std::sqrt(5.0), {2, -1, 0}),
                                 axisY = cross(axisZ, axisX);
Point turn(const Point& local) { return plus(plus(scaled(local[0], axisX), scaled(local[1], axisY)), scaled(local[2], axisZ)); }

/// Samples of a surface by its local position and normal over u, v in [0, 1]. \param sign  -1 for a hole
Samples sampled(const std::function<std::pair<Point, Point>(double, double)>& at, double sign = 1) {
  Samples made;
  for (int i = 0; i < 5; ++i)
    for (int k = 0; k < 5; ++k) {
      const auto [place, normal] = at(0.1 + 0.2 * i, 0.1 + 0.2 * k);
      made.points.push_back(plus(origin, turn(place)));
      made.normals.push_back(scaled(sign, turn(normal)));
    }
  return made;
}
std::pair<Point, Point> onCylinder(double u, double v) {
  return {{3 * std::cos(u), 3 * std::sin(u), 10 * v}, {std::cos(u), std::sin(u), 0}};
}
std::pair<Point, Point> onSphere(double u, double v) {
  const Point n{std::cos(u) * std::cos(v), std::sin(u) * std::cos(v), std::sin(v)};
  return {scaled(2.5, n), n};
}
/// Half opening angle of 30 degrees, from the apex along z.
std::pair<Point, Point> onCone(double u, double v) {
  const double height = 1 + 4 * v, r = height / std::sqrt(3.0), c = std::sqrt(3.0) / 2;
  return {{r * std::cos(u), r * std::sin(u), height}, {c * std::cos(u), c * std::sin(u), -0.5}};
}
std::pair<Point, Point> onTorus(double u, double v) {
  const Point out{std::cos(u), std::sin(u), 0}, n = plus(scaled(std::cos(5 * v), out), {0, 0, std::sin(5 * v)});
  return {plus(scaled(8, out), scaled(1.5, n)), n};
}

}  // namespace

TEUCHOS_UNIT_TEST(SurfaceShape, FindsEveryShapeWithItsMeasures) {
  for (const double sign : {1.0, -1.0}) {
    const Samples onPlane = sampled([](double u, double v) { return std::make_pair(Point{u, 2 * v, 0}, Point{0, 0, 1}); }, sign);
    const SurfaceShape plane = surfaceShape(onPlane.points, onPlane.normals);
    TEST_ASSERT(plane.kind == Kind::Plane);
    TEST_COMPARE(norm(minus(plane.axis, scaled(sign, axisZ))), <, 1e-12);

    const Samples round = sampled(onCylinder, sign);
    const SurfaceShape cylinder = surfaceShape(round.points, round.normals);
    TEST_ASSERT(cylinder.kind == Kind::Cylinder && cylinder.hollow == (sign < 0));
    TEST_FLOATING_EQUALITY(cylinder.radius, 3.0, 1e-9);
    TEST_COMPARE(norm(cross(cylinder.axis, axisZ)), <, 1e-9);
    TEST_COMPARE(norm(cross(minus(cylinder.centre, origin), axisZ)), <, 1e-8);

    const Samples ball = sampled(onSphere, sign);
    const SurfaceShape sphere = surfaceShape(ball.points, ball.normals);
    TEST_ASSERT(sphere.kind == Kind::Sphere && sphere.hollow == (sign < 0));
    TEST_FLOATING_EQUALITY(sphere.radius, 2.5, 1e-9);
    TEST_COMPARE(norm(minus(sphere.centre, origin)), <, 1e-8);

    const Samples pointed = sampled(onCone, sign);
    const SurfaceShape cone = surfaceShape(pointed.points, pointed.normals);
    TEST_ASSERT(cone.kind == Kind::Cone && cone.hollow == (sign < 0));
    TEST_COMPARE(norm(minus(cone.centre, origin)), <, 1e-8);
    TEST_FLOATING_EQUALITY(cone.radius, (1 + 4 * 0.9) / std::sqrt(3.0), 1e-9);

    const Samples ring = sampled(onTorus, sign);
    TEST_ASSERT(surfaceShape(ring.points, ring.normals).kind == Kind::Other);  // without the radius of its tube
    const SurfaceShape torus = surfaceShape(ring.points, ring.normals, {}, 1.5);
    TEST_ASSERT(torus.kind == Kind::Torus && torus.hollow == (sign < 0));
    TEST_FLOATING_EQUALITY(torus.radius, 8.0, 1e-9);
    TEST_COMPARE(norm(cross(torus.axis, axisZ)), <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(SurfaceShape, TakesNoOtherSurfaceForOneOfThem) {
  const Samples saddle = sampled([](double u, double v) {
    const double n = std::sqrt(1 + u * u + v * v);
    return std::make_pair(Point{u, v, u * v}, Point{-v / n, -u / n, 1 / n});
  });
  TEST_ASSERT(surfaceShape(saddle.points, saddle.normals).kind == Kind::Other);
  // An elliptic cylinder, and points of a cylinder with the normals of a sphere.
  const Samples ellipse = sampled([](double u, double v) {
    const double n = std::hypot(std::cos(u) / 3, std::sin(u) / 2);
    return std::make_pair(Point{3 * std::cos(u), 2 * std::sin(u), v}, Point{std::cos(u) / 3 / n, std::sin(u) / 2 / n, 0});
  });
  TEST_ASSERT(surfaceShape(ellipse.points, ellipse.normals).kind == Kind::Other);
  TEST_ASSERT(surfaceShape(sampled(onCylinder).points, sampled(onSphere).normals).kind == Kind::Other);
  TEST_ASSERT(surfaceShape({{0, 0, 0}}, {{0, 0, 1}}).kind == Kind::Other);
}

TEUCHOS_UNIT_TEST(SurfaceShape, KnowsPartsOfTheSameSurface) {
  const auto shape = [](const Samples& of) { return surfaceShape(of.points, of.normals); };
  const auto moved = [](Samples of, const Point& by) {
    for (Point& p : of.points) p = plus(p, by);
    return of;
  };
  const Samples round = sampled(onCylinder);
  TEST_ASSERT(isSameShape(shape(round), shape(moved(round, scaled(5, axisZ))), 20));  // along its axis
  TEST_ASSERT(!isSameShape(shape(round), shape(moved(round, scaled(.01, axisX))), 20));
  TEST_ASSERT(!isSameShape(shape(round), shape(sampled(onCylinder, -1)), 20));  // the hole that a pin fills
  TEST_ASSERT(!isSameShape(shape(round), shape(sampled(onSphere)), 20));
  TEST_ASSERT(!isSameShape(shape(sampled(onSphere)), shape(moved(sampled(onSphere), scaled(5, axisZ))), 20));
}
