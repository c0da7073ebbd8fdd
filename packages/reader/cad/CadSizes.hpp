#pragma once
#include <suture/base/Types.hpp>
#include <suture/mesh/BoxTree.hpp>
#include <suture/reader/cad/Skin.hpp>

#include <map>
#include <memory>
#include <vector>

namespace suture {

/// Element sizes of a CAD file whose user gives none: at most a fraction of the extent of the body, of the thickness of its walls and of
/// the radii of its faces, and smaller where bodies face each other. Sizes grow linearly away from the places that need small elements, in
/// the material and on flat faces, too: Gmsh's own extension of sizes from the boundary makes the whole face between two small holes fine.
/// Local.
class CadSizes {
 public:
  /// Smallest radii of curvature. [length]
  struct Radii {
    struct At {
      std::size_t body;
      Point place;
      double radius;
    };
    std::map<int, double> ofFace;  ///< by face, where it is equally round everywhere
    std::vector<At> at;            ///< at places of other faces
  };
  /// \param order  of the elements: first-order elements need several in the thickness of a wall
  CadSizes(const std::vector<Skin>& bodies, int order, const Radii& radii);

  /// Size of elements [length] at a place in or on a body.
  double at(std::size_t body, const Point& place) const;
  /// Size of elements [length] on a face of a body whose smallest radius of curvature is known: elementsPerTurn(), or down to half of them
  /// on a detail of the body.
  double ofRadius(std::size_t body, double radius) const;

  /// Elements on a full circle.
  static int elementsPerTurn(int order) { return order == 1 ? 24 : 16; }
  /// Smallest number of elements on a full circle that is small in its body.
  static int leastPerTurn(int order) { return elementsPerTurn(order) / 2; }
  /// Smallest size [length]: tiny details are not resolved further.
  double least() const { return smallest_; }

 private:
  struct Sample {
    Point place;
    double size;  ///< [length]
  };
  struct Body {
    double most;  ///< size far from all samples [length]
    std::vector<Sample> samples;
    std::shared_ptr<const BoxTree> tree;  ///< places of the samples
  };

  int order_;
  std::vector<Body> bodies_;
  double least_ = 0.0, smallest_ = 0.0;
};

}  // namespace suture
