#pragma once
#include <suture/mesh/BoxTree.hpp>
#include <suture/mesh/CellBlock.hpp>
#include <suture/mesh/ShapeFunctions.hpp>

namespace suture {

/// Finds the element of a block that holds a point, or the one that is nearest to it: a tree of bounding boxes gives candidates, Newton's
/// method their reference coordinates. All cells, straight and curved, in the plane and in space. Local.
class CellSearch {
 public:
  /// Part of an element's size: a point so far outside counts as in it, since a side of straight elements cuts the curve that it stands
  /// for.
  static constexpr double kNear = 0.05;

  /// `block` must outlive the search.
  explicit CellSearch(const CellBlock& block);

  /// A point in an element, or beside it.
  struct Place {
    int element = -1;  ///< -1: there is none
    ReferencePoint at{0, 0, 0};
    double outside = std::numeric_limits<double>::infinity();  ///< how far outside, as a part of the element's size; 0 inside
  };
  /// The element in which a point lies, or which it leaves by at most kNear; of several the one that it leaves least, then the lowest.
  Place find(const Point& point) const;

  /// The nearest element of a point outside all of them.
  struct Nearest : Place {      // `at`: extrapolated, or where the element's map does not reach so far of `foot`
    Point foot{0, 0, 0};        ///< nearest point on the surface of the element's vertices
    double distance = outside;  ///< of the point from it [length]
  };
  Nearest nearest(const Point& point) const;

 private:
  /// The reference point that an element maps to a place, and how far it is outside. False where Newton's method finds none that is less
  /// than `most` outside.
  bool invert(int element, const Point& place, double most, Place& found) const;
  Nearest footOn(int element, const Point& place) const;

  const CellBlock& block_;
  BoxTree tree_;
};

}  // namespace suture
