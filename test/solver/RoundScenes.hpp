#pragma once
#include <support/SmallScenes.hpp>
#include <suture/base/Errors.hpp>
#include <suture/constraints/NodalRules.hpp>

/// Bodies between two circles or spheres, from bent boxes: for comparison with Lame's solutions.
namespace suture::scenes {

/// Data of tubes and spheres under inner pressure.
constexpr double kYoung = 3.0, kInner = 1.0, kOuter = 2.0, kPressure = 0.1;

/// A quarter of the ring a < r < b about the origin, nr x nt cells: groups body_left (r = a), body_right (r = b), body_bottom (the x axis),
/// body_top (the y axis). Curved sides of quadratic cells pass through the circle in three points.
Scene quarterRing(Cell cell, double a, double b, int nr, int nt, const Material& material, bool axisymmetric = false);

/// Largest error of the displacement of the nodes against a radial one, over the largest exact value.
template <typename Radial>
double radialError(const Scene& scene, const Vector& u, const Radial& exact) {
  double error = 0, size = 0;
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    const Point p = scene.mesh.point(node);
    const double r = std::hypot(p[0], p[1]), value = exact(r);
    size = std::max(size, std::abs(value));
    error = std::max(error, std::hypot(u(2 * node) - value * p[0] / r, u(2 * node + 1) - value * p[1] / r));
  }
  return error / size;
}

}  // namespace suture::scenes
