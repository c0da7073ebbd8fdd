#include <suture/base/Point.hpp>
#include <suture/mesh/BoxTree.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace suture {

namespace {
constexpr int kLeaf = 2;  // maximum number of boxes of a leaf
}

void BoundingBox::include(const Point& lowest, const Point& highest) {
  for (int k = 0; k < 3; ++k) {
    low[k] = std::min(low[k], lowest[k]);
    high[k] = std::max(high[k], highest[k]);
  }
}

double BoundingBox::distance(const Point& point) const {
  Point away{0, 0, 0};
  for (int k = 0; k < 3; ++k) away[k] = std::max({low[k] - point[k], point[k] - high[k], 0.0});
  return norm(away);
}

BoxTree::BoxTree(const std::vector<BoundingBox>& boxes) : boxes_(boxes), order_(boxes.size()) {
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(2 * boxes.size());
  if (!boxes.empty()) build(0, static_cast<int>(boxes.size()));
}

int BoxTree::build(int first, int count) {
  const int at = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  BoundingBox whole, centres;
  const auto centre = [this](int i, int k) { return boxes_[i].low[k] + boxes_[i].high[k]; };  // twice the centre
  for (int k = first; k < first + count; ++k) {
    const int i = order_[k];
    whole.include(boxes_[i]);
    centres.include(Point{centre(i, 0), centre(i, 1), centre(i, 2)});
  }
  nodes_[at].box = whole;
  if (count <= kLeaf) {
    nodes_[at].first = first;
    nodes_[at].count = count;
    return at;
  }
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (centres.high[k] - centres.low[k] > centres.high[axis] - centres.low[axis]) axis = k;
  const int half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half, order_.begin() + first + count, [&](int i, int j) {
    const double a = centre(i, axis), b = centre(j, axis);
    return a < b || (a == b && i < j);
  });
  build(first, half);
  const int second = build(first + half, count - half);  // may reallocate nodes_
  nodes_[at].second = second;
  return at;
}

void BoxTree::sort(std::vector<int>& numbers) { std::sort(numbers.begin(), numbers.end()); }

}  // namespace suture
