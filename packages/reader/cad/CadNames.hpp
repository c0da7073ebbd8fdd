#pragma once
#include <suture/base/Types.hpp>
#include <suture/reader/cad/SurfaceShape.hpp>

#include <string>
#include <vector>

namespace suture {

/// Solid of a CAD file.
struct CadBody {
  std::string label;                  ///< path of names in the file, "Shapes/assembly/part"; empty: none
  Point low{0, 0, 0}, high{0, 0, 0};  ///< bounding box [length]
};

/// Faces of one body that get one name.
struct CadFace {
  int body = 0;
  SurfaceShape shape;     ///< shape; the axis of a plane is its outward normal
  Point centre{0, 0, 0};  ///< centre of area [length]
  double area = 0.0;      ///< [length^2]
};

/// Names of the bodies: the last part of the label with letters, digits and underscores only, otherwise "body". Bodies with the same name
/// are numbered by place: "bolt_1", "bolt_2". A single unnamed body is "body_1". Local.
std::vector<std::string> cadBodyNames(const std::vector<CadBody>& bodies);

/// Names of the faces, `<body>_<place>` or `<body>_<kind>_<number>`. Local.
///
/// The place is that of a plane at an end of its body with the normal along an axis: "left" and "right" (x), "front" and "back" (y),
/// "bottom" and "top" (z); several of them at the same end are numbered. The kind is that of kindName(). Numbers follow the places of the
/// centres, in the order of x, y, z, then the areas: they depend neither on the order in the file nor on round-off.
std::vector<std::string> cadFaceNames(const std::vector<CadFace>& faces, const std::vector<CadBody>& bodies,
                                      const std::vector<std::string>& bodyNames);

}  // namespace suture
