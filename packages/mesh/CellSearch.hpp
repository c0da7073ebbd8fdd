#pragma once
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/CellBlock.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

namespace suture {

/// Finds the element of a block that contains a point, or the nearest element: a tree of bounding boxes gives candidates, Newton's method
/// their reference coordinates. All cells, straight and curved, in 2D and 3D. Local.
class CellSearch {
 public:
  /// A point outside an element by up to this fraction of its size is treated as inside, since a straight side cuts off part of the curve
  /// that it approximates.
  static constexpr double kNear = 0.05;

  /// `block` must outlive the search.
  explicit CellSearch(const CellBlock& block);

  /// A point in an element, or close to it.
  struct Place {
    int element = -1;  ///< -1: there is none
    ReferencePoint at{0, 0, 0};
    double outside = std::numeric_limits<double>::infinity();  ///< distance outside, relative to the element's size; 0 inside
  };
  /// The element that contains a point, or that the point leaves by at most kNear; of several the one left least, then the lowest.
  Place find(const Point& point) const;

  /// The element nearest to a point outside all elements.
  struct Nearest : Place {      // `at`: extrapolated, or that of `foot` where the element's map cannot be inverted
    Point foot{0, 0, 0};        ///< nearest point on the surface of the element's vertices
    double distance = outside;  ///< distance of the point from `foot` [length]
  };
  Nearest nearest(const Point& point) const;

 private:
  /// The reference point that an element maps to `place`, and how far it is outside. False if Newton's method finds none less than `most`
  /// outside.
  bool invert(int element, const Point& place, double most, Place& found) const;
  Nearest footOn(int element, const Point& place) const;

  const CellBlock& block_;
  BoxTree tree_;
};

}  // namespace suture
