#include <suture/base/Point.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/pairs/mortar/SmoothFace.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

namespace {

constexpr double kAside = 0.2;  // least denominator of a distance, for directions nearly along the surface

}  // namespace

SmoothFace::SmoothFace(const MortarFace& face, const std::vector<BoundarySurface::Jet>& jets) : face_(face), jets_(jets) {}

// Sum over pairs of nodes of the product of their shape functions times a function of both nodes and the vector between them.
template <typename Function>
double SmoothFace::sumOverPairs(const ShapeValues& values, const Function& of) const {
  const std::vector<Point>& points = face_.points();
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j) sum += values[i] * values[j] * of(i, j, minus(points[j], points[i]));
  return sum;
}

double SmoothFace::Curvature::along(const Point& arm) const {
  const double a = dot(arm, s), b = dot(arm, t);
  return (ss * a + st * b) * dot(arm, normalS) + (st * a + tt * b) * dot(arm, normalT);
}

SmoothFace::Curvature SmoothFace::curvature(const ReferencePoint& at) const {
  Curvature result;
  ShapeJet shapes[kMostSideNodes];
  shapeJets(face_.cell(), at, shapes);
  for (std::size_t i = 0; i < face_.points().size(); ++i) {
    const Point& normal = hasBulge() ? jets_[i].normal : face_.normal(static_cast<int>(i));
    result.s = plus(result.s, scaled(shapes[i].gradient[0], face_.points()[i]));
    result.t = plus(result.t, scaled(shapes[i].gradient[1], face_.points()[i]));
    if (!isCurved() || (isLinear() && !hasBulge())) continue;
    result.normalS = plus(result.normalS, scaled(shapes[i].gradient[0], normal));
    result.normalT = plus(result.normalT, scaled(shapes[i].gradient[1], normal));
  }
  const double ss = dot(result.s, result.s), st = dot(result.s, result.t), tt = dot(result.t, result.t), det = ss * tt - st * st;
  result.ss = tt / det, result.st = -st / det, result.tt = ss / det;
  return result;
}

double SmoothFace::spread(const ShapeValues& values) const {
  if (!hasBulge()) return 0.0;
  return sumOverPairs(values,
                      [&](std::size_t i, std::size_t j, const Point& arm) { return dot(arm, minus(jets_[j].normal, jets_[i].normal)); });
}

double SmoothFace::spread(const ShapeValues& values, const Curvature& curvature) const {
  return sumOverPairs(values, [&](std::size_t, std::size_t, const Point& arm) { return curvature.along(arm); });
}

double SmoothFace::doubt(const ShapeValues& values) const {
  if (!hasBulge()) return 0.0;
  return sumOverPairs(values,
                      [&](std::size_t i, std::size_t j, const Point& arm) {
                        return dot(arm, minus(jets_[j].normal, jets_[i].normal)) - (jets_[i].curvature(arm) + jets_[j].curvature(arm)) / 2;
                      }) /
         2;
}

double SmoothFace::way(const MortarFace::Place& place, double height, const Point& direction) const {
  if (height == 0) return 0.0;
  const double size = sumOverPairs(place.values, [](std::size_t, std::size_t, const Point& arm) { return dot(arm, arm); });
  if (size <= 0) return 0.0;  // at a node
  Point normal = unit(place.density);
  double along = height / size;
  if (const double own = spread(place.values); own != 0) {
    // The normal of a surface with another spread is tilted against the element in proportion.
    const double part = std::clamp(height / own, -1.0, 1.0);
    Point smooth{0, 0, 0};
    along = 0;
    for (std::size_t i = 0; i < jets_.size(); ++i) {
      smooth = plus(smooth, scaled(place.values[i], jets_[i].normal));
      along += part * place.values[i] * jets_[i].along;
    }
    normal = plus(normal, scaled(part, minus(smooth, normal)));
  }
  const double across = dot(direction, normal);
  return height / std::max(across + std::sqrt(std::max(0.0, across * across + along * height)), kAside);
}

}  // namespace suture
