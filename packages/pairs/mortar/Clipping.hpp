#pragma once
#include <array>
#include <vector>

namespace suture {

// Polygons in a plane, with counter-clockwise corners. Local.

using PlanePoint = std::array<double, 2>;
using Polygon = std::vector<PlanePoint>;

/// Area of a polygon, negative if its corners run clockwise. [length^2]
double areaOf(const Polygon& polygon);

/// Splits a non-convex quadrilateral into two triangles and returns a convex polygon unchanged; each part as indices of its corners.
std::vector<std::vector<int>> convexParts(const Polygon& polygon);

/// Intersection of two convex polygons, by cutting the first along each edge of the second (Sutherland and Hodgman 1974).
/// \param tolerance  distance up to which a corner on the wrong side of an edge counts as on it, to avoid slivers due to round-off [length]
/// \return nothing if the intersection has no area
Polygon commonPart(const Polygon& polygon, const Polygon& by, double tolerance);

/// True if a point is inside a convex polygon or at most `tolerance` beyond one of its edges.
bool contains(const Polygon& convex, const PlanePoint& point, double tolerance);

/// Quadrature over a triangle: barycentric coordinates of the points, and weights that sum to one.
struct TriangleRule {
  std::vector<std::array<double, 3>> points;
  std::vector<double> weights;
};
/// Rule that is exact for polynomials of a degree: up to 5 the seven-point rule (Radon 1948), above it a Gauss-Legendre product rule on a
/// square with one edge collapsed to a corner.
const TriangleRule& triangleRule(int degree);

}  // namespace suture
