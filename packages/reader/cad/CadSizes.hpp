#pragma once
#include <suture/base/Types.hpp>
#include <suture/reader/cad/Skin.hpp>

#include <map>
#include <vector>

namespace suture {

/// Element sizes of a CAD file whose user gives none: at most a fraction of the extent of the body and of the thickness of its walls, and
/// smaller where bodies face each other. Sizes grow linearly away from the places that need small elements. Curvature is left to Gmsh
/// (kElementsPerTurn). Local.
class CadSizes {
 public:
  /// \param order  of the elements: first-order elements need several in the thickness of a wall
  /// \param radii  of round faces whose curvature Gmsh does not see, by face
  CadSizes(const std::vector<Skin>& bodies, int order, const std::map<int, double>& radii = {});

  /// Size of elements [length] at a place in or on a body.
  double at(std::size_t body, const Point& place) const;

  /// Elements on a full circle.
  static int elementsPerTurn(int order) { return order == 1 ? 24 : 16; }
  /// Smallest size [length]: tiny details are not resolved further.
  double least() const { return least_; }

 private:
  struct Sample {
    Point place;
    double size;  ///< [length]
  };
  struct Body {
    double most;  ///< size far from all samples [length]
    std::vector<Sample> samples;
  };
  void prune(Body& body) const;

  std::vector<Body> bodies_;
  double least_ = 0.0;
};

}  // namespace suture
