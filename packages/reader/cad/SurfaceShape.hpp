#pragma once
#include <suture/base/Types.hpp>

#include <string>
#include <vector>

namespace suture {

/// Simple surface through sample points, found from the points and the normals there: a face of a CAD file or of a triangulated surface.
struct SurfaceShape {
  enum class Kind { Plane, Cylinder, Cone, Sphere, Torus, Other };
  Kind kind = Kind::Other;
  Point axis{0, 0, 0};    ///< unit normal of a plane, along the given normals; unit axis of a cylinder, cone or torus, of either direction
  Point centre{0, 0, 0};  ///< point of a plane or an axis; apex of a cone; centre of a sphere or a torus [length]
  double radius =
      0.0;  ///< radius of a cylinder or a sphere; largest radius of a cone at the points; of a torus from the axis to the tube [length]
  double tube = 0.0;    ///< radius of the tube of a torus [length]
  bool hollow = false;  ///< the given normals point towards the axis or centre: a hole
};

/// Tolerances of surfaceShape().
struct ShapeTolerance {
  double angle = 1e-4;     ///< between a given normal and the normal of the shape [rad]
  double distance = 1e-6;  ///< distance of a point from the shape over the extent of the points
};

/// The shape that all points and normals fit within the tolerance; `Other` if there is none. A plane is preferred to a sphere, then come
/// cylinder, cone, and torus. Local.
/// \param points   at least three points [length]
/// \param normals  unit normals at the points
/// \param tube     radius of the tube of a torus; 0: not tested for a torus
SurfaceShape surfaceShape(const std::vector<Point>& points, const std::vector<Point>& normals, const ShapeTolerance& tolerance = {},
                          double tube = 0.0);

/// True if two shapes are parts of the same cylinder, cone, sphere or torus. Planes and other surfaces are never the same. Local.
/// \param extent  of the body [length]; positions and radii may differ by `tolerance` times the extent
bool isSameShape(const SurfaceShape& a, const SurfaceShape& b, double extent, double tolerance = 1e-5);

/// "plane", "cylinder", "cone", "sphere", "torus" or "surface": the word in the name of a face.
std::string kindName(SurfaceShape::Kind kind);

}  // namespace suture
