#pragma once
#include <array>
#include <vector>

namespace suture {

// Polygons in a plane, their corners counter-clockwise. Local.

using PlanePoint = std::array<double, 2>;
using Polygon = std::vector<PlanePoint>;

/// Area of a polygon, negative where its corners run clockwise. [length^2]
double areaOf(const Polygon& polygon);

/// The polygon itself where it is convex, else a quadrilateral as two triangles. Each as places of its corners.
std::vector<std::vector<int>> convexParts(const Polygon& polygon);

/// The common part of two convex polygons, by cutting the first along each edge of the second (Sutherland and Hodgman 1974).
/// \param tolerance  distance up to which a corner on the wrong side of an edge counts as on it: no slivers of rounding [length]
/// \return nothing where they have no area in common
Polygon commonPart(const Polygon& polygon, const Polygon& by, double tolerance);

/// True if a point is in a convex polygon, or at most `tolerance` beyond one of its edges.
bool contains(const Polygon& convex, const PlanePoint& point, double tolerance);

/// Quadrature over a triangle: barycentric coordinates of the points, and weights that add up to one.
struct TriangleRule {
  std::vector<std::array<double, 3>> points;
  std::vector<double> weights;
};
/// A rule that is exact for polynomials of a degree: for 5 and less the one of seven points (Radon 1948), else Gauss and Legendre's in both
/// directions of a square, one of whose edges is drawn together to a corner.
const TriangleRule& triangleRule(int degree);

}  // namespace suture
