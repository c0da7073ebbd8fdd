#pragma once
#include <suture/pairs/PairSearch.hpp>
#include <suture/pairs/mortar/MortarSegment.hpp>

#include <limits>
#include <optional>
#include <vector>

namespace suture {

/// Divides the sides of one surface by the opposite sides of the other, seen along a direction (the segments of a mortar method). 2D: the
/// overlap of two sides is an interval. Costs O(log n) per side, n the number of sides of the other surface. Local.
class Segmentation {
 public:
  /// \param others  sides of the other surface; must outlive this object \param reach  see Contact::reach
  explicit Segmentation(const std::vector<MortarSegment>& others, double reach = std::numeric_limits<double>::infinity());

  /// Point of a side of the other surface that the line through a point along a direction meets from outside.
  struct Meeting {
    const MortarSegment* other = nullptr;
    double eta = 0.0;  ///< reference coordinate on `other`
    double gap = 0.0;  ///< signed distance along the direction [length]
  };
  /// Meeting with one side of the other surface; nothing if the line misses it or the normals differ by less than 120 degrees.
  static std::optional<Meeting> meet(const Point& from, const Point& direction, const MortarSegment& other);
  /// Nearest meeting with any side of the other surface, before or behind `from`, except those that are reached only through a body; if the
  /// line misses all sides, the end of a side that is nearest to it. \param body  body of `from`: only other bodies are met
  /// \param beyond  largest distance of the line from that end [length]
  std::optional<Meeting> nearest(const Point& from, const Point& direction, int body, double beyond = 0.0) const;

  /// Part of a side for which one side of the other surface is the nearest.
  struct Overlap {
    double begin, end;  ///< reference coordinates
    const MortarSegment* other;
  };
  /// Overlaps of a side in ascending order. They fill the side if all of it is opposite to the other surface.
  std::vector<Overlap> overlaps(const MortarSegment& own, const Point& direction) const;

 private:
  bool isThrough(const Meeting& met, const Point& from, const Point& direction, const std::vector<int>& candidates) const;
  std::vector<int> candidates(const std::vector<Point>& nodes, const Point& direction, int body) const;
  std::optional<Meeting> nearest(const Point& from, const Point& direction, const std::vector<int>& candidates) const;
  std::vector<double> breaks(const MortarSegment& own, const Point& direction, const std::vector<int>& candidates) const;

  const std::vector<MortarSegment>& others_;
  double reach_;
  PairSearch search_;
};

}  // namespace suture
