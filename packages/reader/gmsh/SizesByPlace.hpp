#pragma once
#include <suture/mesh/BoxTree.hpp>
#include <suture/reader/gmsh/SizeField.hpp>

#include <optional>
#include <vector>

namespace suture {

/// Values of a size field at points (part of suture_mesher). They depend on the place alone, not on the body: where the sides of two bodies
/// coincide, both get the smallest size of the simplices there, and matching sides stay matching. Local.
class SizesByPlace {
 public:
  /// \param scale  factor on the lengths of the field
  SizesByPlace(SizeField field, double scale);
  /// Size at a point; between a curved side and the simplices next to it that of the nearest simplex, elsewhere outside that of the nearest
  /// vertex. [length]
  double at(const Point& point) const;

 private:
  Point vertex(int simplex, int k) const;
  /// Barycentric coordinates of a point; false for a simplex without volume.
  bool coordinatesIn(int simplex, const Point& point, double* all) const;
  double valueIn(int simplex, const double* coordinates) const;

  SizeField field_;
  std::optional<BoxTree> simplices_, vertices_;
};

}  // namespace suture
