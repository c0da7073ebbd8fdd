#pragma once
#include <suture/base/Point.hpp>
#include <suture/mesh/BoxTree.hpp>

#include <array>
#include <vector>

namespace suture {

/// A straight piece of an outline: a segment (2D) or a triangle (3D).
struct Facet {
  int body = -1, group = -1;
  std::array<Point, 3> corners{};
  Point normal{0, 0, 0};
  double size = 0.0;   ///< longest edge [length]
  double bulge = 0.0;  ///< estimated distance of the curve through its nodes from the facet [length]
  std::vector<int> contacts;

  template <typename Self, typename Each>
  static void forEachField(Self& self, const Each& each) {
    each(self.body), each(self.group), each(self.corners), each(self.normal), each(self.size), each(self.bulge), each(self.contacts);
  }
};

/// True if the boxes intersect.
bool meet(const BoundingBox& a, const BoundingBox& b);

/// All facets of one body, as a closed outline. A point is inside if it lies behind the nearest facet, or, if several are nearest, behind
/// their mean weighted by the angles under which they are seen from the point (Baerentzen and Aanaes 2005). Local.
class BodyOutline {
 public:
  /// \param facets  of the body; must outlive it
  BodyOutline(int dimension, std::vector<const Facet*> facets);

  struct Depth {
    double size = 0.0;  ///< distance from the outline; negative outside [length]
    const Facet* nearest = nullptr;
  };
  Depth depthAt(const Point& p) const;

  /// Intersections of a segment with facets, as fractions of its length, ascending.
  std::vector<double> crossings(const Point& a, const Point& b) const;

 private:
  struct Nearest {
    Point point{0, 0, 0};
    double angle = 0.0;  // under which the facet is seen from the point
    bool onRim = false;
  };
  static Nearest onSegment(const Point& a, const Point& b, const Point& p);
  static Nearest onTriangle(const std::array<Point, 3>& corners, const Point& normal, const Point& p);
  Nearest nearestOn(const Facet& facet, const Point& p) const;
  /// Fraction of the segment from a to b; negative if there is no intersection.
  double crossing(const Facet& facet, const Point& a, const Point& b) const;
  std::vector<BoundingBox> boxes() const;

  int dimension_;
  std::vector<const Facet*> facets_;
  BoxTree tree_;
};

}  // namespace suture
