#pragma once
#include <suture/base/Types.hpp>

#include <optional>
#include <vector>

namespace suture {

/// Closed triangulated boundary of one body, for its extent and thickness. Local.
class Skin {
 public:
  struct Triangle {
    std::array<Point, 3> corners;
    std::array<std::size_t, 3> nodes;        ///< numbers of the corners in the mesh
    int face = 0;                            ///< tag of its CAD face
    Point centre{0, 0, 0}, normal{0, 0, 0};  ///< unit normal, outward
    double area = 0.0;                       ///< [length^2]
  };

  /// Turns the normals of each face outward. \param triangles  all of one body; those of a face have the same orientation
  explicit Skin(std::vector<Triangle> triangles);

  /// Triangle with the centre, normal and area that follow from its corners.
  static Triangle triangle(const std::array<Point, 3>& corners, const std::array<std::size_t, 3>& nodes, int face);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Point& low() const { return low_; }
  const Point& high() const { return high_; }
  /// Diagonal of the bounding box [length].
  double extent() const;
  double area() const { return area_; }
  double volume() const;

  /// Distance through the material behind a triangle to the opposite, nearly parallel side; none if no such side is met. [length]
  std::optional<double> thicknessAt(std::size_t triangle) const;

 private:
  /// Calls visit(distance, triangle) for all triangles that a ray meets, except `without`.
  template <typename Visit>
  void cast(const Point& from, const Point& along, std::size_t without, const Visit& visit) const;
  void turnOutward();

  std::vector<Triangle> triangles_;
  Point low_{0, 0, 0}, high_{0, 0, 0};
  double area_ = 0.0;
};

}  // namespace suture
