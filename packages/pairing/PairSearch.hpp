#pragma once
#include <suture/mesh/BoxTree.hpp>

#include <vector>

namespace suture {

/// Finds the sides of one surface that stand opposite to a side of another, whatever lies between them: all that lines along a direction,
/// in both of its senses, lead to. By a tree of boxes, in the plane and in space. Local.
class PairSearch {
 public:
  /// \param sides  for each side the points between which it lies
  explicit PairSearch(const std::vector<std::vector<Point>>& sides);

  /// Numbers of the sides, ascending, whose boxes meet the lines along `direction` through a side. No side that such a line meets is
  /// missing; some that none meets may be there.
  /// \param nodes  of the side through which the lines go, or a single point;  \param direction  not zero, of any length
  std::vector<int> along(const std::vector<Point>& nodes, const Point& direction) const;

  /// Number of boxes that all searches so far have looked at.
  long long boxTests() const { return boxTests_; }

 private:
  BoxTree tree_;
  double size_ = 0.0;  // largest distance of a point from the origin
  mutable long long boxTests_ = 0;
};

}  // namespace suture
