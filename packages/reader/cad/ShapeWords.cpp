#include <suture/base/Point.hpp>
#include <suture/reader/cad/ShapeWords.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace suture {

namespace {

/// A number without round-off digits. \param scale  of the numbers from which it was computed
std::string number(double value, double scale) {
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", std::abs(value) > 1e-7 * scale ? value : 0.0);
  return text;
}

/// "+z" for a direction along an axis, otherwise its components. \param isLine  "z" for both senses
std::string direction(Point d, bool isLine) {
  for (std::size_t k = 0; k < 3; ++k)
    if (std::abs(std::abs(d[k]) - 1) < 1e-6) return (isLine ? "" : d[k] > 0 ? "+" : "-") + std::string(1, "xyz"[k]);
  if (isLine) {
    const auto first = std::find_if(d.begin(), d.end(), [](double x) { return std::abs(x) > 1e-6; });
    if (first != d.end() && *first < 0) d = scaled(-1.0, d);
  }
  return "(" + number(d[0], 1) + ", " + number(d[1], 1) + ", " + number(d[2], 1) + ")";
}

}  // namespace

std::string inWords(const SurfaceShape& shape, double scale) {
  const auto length = [&](double value) { return number(scale * value, 0.0); };
  const std::string hollow = shape.hollow ? ", hollow" : "";
  switch (shape.kind) {
    case SurfaceShape::Kind::Plane:
      return "plane, normal " + direction(shape.axis, false);
    case SurfaceShape::Kind::Cylinder:
      return "cylinder, radius " + length(shape.radius) + ", along " + direction(shape.axis, true) + hollow;
    case SurfaceShape::Kind::Cone:
      return "cone, radius up to " + length(shape.radius) + ", along " + direction(shape.axis, true) + hollow;
    case SurfaceShape::Kind::Sphere:
      return "sphere, radius " + length(shape.radius) + hollow;
    case SurfaceShape::Kind::Torus:
      return "torus, radii " + length(shape.radius) + " and " + length(shape.tube) + ", around " + direction(shape.axis, true) + hollow;
    case SurfaceShape::Kind::Other:
      break;
  }
  return "curved";
}

}  // namespace suture
