#pragma once
#include <suture/pairing/PairSearch.hpp>
#include <suture/pairing/mortar/MortarSegment.hpp>

#include <optional>
#include <vector>

namespace suture {

/// Divides the sides of one surface by those of the other that stand opposite to them, seen along a direction (the segments of a mortar
/// method). In the plane the overlap of two sides is an interval. Costs log n steps a side, n the sides of the other surface. Local.
class Segmentation {
 public:
  /// \param others  sides of the other surface; they outlive this
  explicit Segmentation(const std::vector<MortarSegment>& others);

  /// Point of a side of the other surface that the line through a point along a direction meets face to face.
  struct Meeting {
    const MortarSegment* other = nullptr;
    double eta = 0.0;  ///< reference coordinate on `other`
    double gap = 0.0;  ///< way there along the direction [length]
  };
  /// The point on one side of the other surface; nothing if the line passes it, or the normals differ by less than 120 degrees.
  static std::optional<Meeting> meet(const Point& from, const Point& direction, const MortarSegment& other);
  /// The nearest of these points on any side of the other surface, before or behind `from`; not those behind a body, which the way there
  /// leaves before it ends. \param body  of `from`: it meets other bodies
  std::optional<Meeting> nearest(const Point& from, const Point& direction, int body) const;

  /// Part of a side to which one side of the other surface is the nearest.
  struct Overlap {
    double begin, end;  ///< reference coordinates
    const MortarSegment* other;
  };
  /// Overlaps of a side in ascending order. They fill it where the other surface stands opposite to all of it.
  std::vector<Overlap> overlaps(const MortarSegment& own, const Point& direction) const;

 private:
  bool isThrough(const Meeting& met, const Point& from, const Point& direction, const std::vector<int>& candidates) const;
  std::vector<int> candidates(const std::vector<Point>& nodes, const Point& direction, int body) const;
  std::optional<Meeting> nearest(const Point& from, const Point& direction, const std::vector<int>& candidates) const;
  std::vector<double> breaks(const MortarSegment& own, const Point& direction, const std::vector<int>& candidates) const;

  const std::vector<MortarSegment>& others_;
  PairSearch search_;
};

}  // namespace suture
