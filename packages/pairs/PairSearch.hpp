#pragma once
#include <suture/mesh/BoxTree.hpp>

#include <vector>

namespace suture {

/// Finds the sides of one surface that are opposite to a side of another: all that are met by lines along a direction, in either sense,
/// including sides hidden behind others. Uses a bounding-box tree. 2D and 3D. Local.
class PairSearch {
 public:
  /// \param sides  points of each side, between which it lies
  explicit PairSearch(const std::vector<std::vector<Point>>& sides);

  /// Indices of the sides, ascending, whose boxes meet the lines along `direction` through a side. Contains every side that such a line
  /// meets, and possibly some that none meets.
  /// \param nodes  nodes of the side through which the lines run, or a single point;  \param direction  any non-zero length
  std::vector<int> along(const std::vector<Point>& nodes, const Point& direction) const;

  /// Number of boxes tested by all searches so far.
  long long boxTests() const { return boxTests_; }

 private:
  BoxTree tree_;
  double size_ = 0.0;  // largest distance of a point from the origin
  mutable long long boxTests_ = 0;
};

}  // namespace suture
