#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/pairs/PairFrame.hpp>
#include <suture/pairs/PairSearch.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace suture {

namespace {

constexpr double kRounding = 1e-12;

/// Largest sum of the magnitudes of a side's shape functions: every point of the side lies within this number of half extents of the box
/// around its nodes.
double overshoot(std::size_t nodes) {
  switch (nodes) {
    case 1:
    case 2:
    case 4:
      return 1.0;
    case 3:  // for a line; it is 1 for a triangle
      return 1.25;
    case 6:
      return 5.0 / 3;
    case 8:
      return 3.0;
    case 9:
      return 1.25 * 1.25;
    default:
      throw InternalError("a side of " + std::to_string(nodes) + " nodes");
  }
}

std::vector<BoundingBox> boxesOf(const std::vector<std::vector<Point>>& sides) {
  std::vector<BoundingBox> boxes(sides.size());
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (const Point& point : sides[i]) boxes[i].include(point);
  return boxes;
}

/// Projections on a direction.
class Interval {
 public:
  explicit Interval(const Point& direction) : direction_(direction) {}
  void include(const Point& point) {
    const double at = dot(direction_, point);
    low_ = std::min(low_, at);
    high_ = std::max(high_, at);
  }
  void grow(double factor, double more) {
    const double middle = (low_ + high_) / 2, half = factor * (high_ - low_) / 2 + more;
    low_ = middle - half;
    high_ = middle + half;
  }
  bool meets(const BoundingBox& box) const {
    double middle = 0, half = 0;
    for (int k = 0; k < 3; ++k) {
      middle += direction_[k] * (box.low[k] + box.high[k]) / 2;
      half += std::abs(direction_[k]) * (box.high[k] - box.low[k]) / 2;
    }
    return middle + half >= low_ && middle - half <= high_;
  }

 private:
  Point direction_;
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

}  // namespace

PairSearch::PairSearch(const std::vector<std::vector<Point>>& sides) : tree_(boxesOf(sides)) {
  for (const std::vector<Point>& side : sides)
    for (const Point& point : side) size_ = std::max(size_, norm(point));
}

std::vector<int> PairSearch::along(const std::vector<Point>& nodes, const Point& direction) const {
  // Not unit(), which rounds small components to zero and would rotate a line accordingly.
  const std::vector<Point> frame = pairFrame(scaled(1 / norm(direction), direction), 3);
  std::array<Interval, 2> shadow{Interval(frame[1]), Interval(frame[2])};
  double size = size_;
  for (const Point& node : nodes) {
    size = std::max(size, norm(node));
    for (Interval& interval : shadow) interval.include(node);
  }
  for (Interval& interval : shadow) interval.grow(overshoot(nodes.size()), kRounding * size);
  return tree_.find([&](const BoundingBox& box) {
    ++boxTests_;
    return shadow[0].meets(box) && shadow[1].meets(box);
  });
}

}  // namespace suture
