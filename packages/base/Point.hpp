#pragma once
#include <suture/base/Types.hpp>

#include <cmath>

namespace suture {

// Points and directions of three components: the third is zero in 2D.

/// A vector from its components, two in 2D.
inline Point pointOf(const double* components, int dimension) {
  return {components[0], components[1], dimension == 3 ? components[2] : 0.0};
}
inline Point plus(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point scaled(double factor, const Point& a) { return {factor * a[0], factor * a[1], factor * a[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/// The cross product; for vectors in 2D only its third component is nonzero.
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
/// Quarter turn to the left, in 2D.
inline Point turned(const Point& a) { return {-a[1], a[0], 0}; }
inline double norm(const Point& a) { return a[2] == 0.0 ? std::hypot(a[0], a[1]) : std::hypot(a[0], a[1], a[2]); }
/// a / |a| for a nonzero a; components of round-off size (below 1e-9) become zero, so that sides along an axis have exact normals.
Point unit(const Point& a);
/// Angle between two directions, 0 .. pi.
inline double angleBetween(const Point& a, const Point& b) { return std::atan2(norm(cross(a, b)), dot(a, b)); }

}  // namespace suture
