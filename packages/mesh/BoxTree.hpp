#pragma once
#include <suture/base/Types.hpp>

#include <array>
#include <limits>
#include <vector>

namespace suture {

/// A box aligned with the axes; empty before the first point. [length]
struct BoundingBox {
  Point low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};

  void include(const Point& point) { include(point, point); }
  void include(const BoundingBox& box) { include(box.low, box.high); }
  /// Distance of a point from the box, zero inside. [length]
  double distance(const Point& point) const;

 private:
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  void include(const Point& lowest, const Point& highest);
};

/// A binary tree of bounding boxes, halved at the median of their centres along the longest extent. Building takes n log n steps, a search
/// that finds few boxes about log n box tests. 2D and 3D. Local.
class BoxTree {
 public:
  explicit BoxTree(const std::vector<BoundingBox>& boxes);

  /// Numbers of all boxes with touches(box), ascending. `touches` must be true for every box that contains a box for which it is true.
  template <typename Touches>
  std::vector<int> find(const Touches& touches) const;

  /// Number of the box whose object is nearest, or -1 if there are no boxes. The lowest number wins ties.
  /// \param distance  distance(i) of object i from the point; must not be smaller than that of its box [length]
  template <typename Distance>
  int nearest(const Point& point, const Distance& distance) const;

 private:
  /// A leaf has `count` entries of order_ from `first` on. The first child of an inner node follows it; `second` is the other child.
  struct Node {
    BoundingBox box;
    int first = 0, count = 0, second = 0;
  };
  int build(int first, int count);
  static void sort(std::vector<int>& numbers);

  static constexpr int kDepth = 64;  ///< bound of the depth reached by halving
  std::vector<BoundingBox> boxes_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

template <typename Touches>
std::vector<int> BoxTree::find(const Touches& touches) const {
  std::vector<int> found;
  std::array<int, kDepth> waiting{};
  int size = 0;
  if (!nodes_.empty()) waiting[size++] = 0;
  while (size > 0) {
    const int at = waiting[--size];
    const Node& node = nodes_[at];
    if (!touches(node.box)) continue;
    if (node.count == 0) {
      waiting[size++] = node.second;
      waiting[size++] = at + 1;
    } else if (node.count == 1) {
      found.push_back(order_[node.first]);
    } else {
      for (int k = node.first; k < node.first + node.count; ++k)
        if (touches(boxes_[order_[k]])) found.push_back(order_[k]);
    }
  }
  sort(found);
  return found;
}

template <typename Distance>
int BoxTree::nearest(const Point& point, const Distance& distance) const {
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  std::array<int, kDepth> waiting{};
  int size = 0;
  if (!nodes_.empty()) waiting[size++] = 0;
  while (size > 0) {
    const int at = waiting[--size];
    const Node& node = nodes_[at];
    if (node.box.distance(point) > least) continue;
    if (node.count == 0) {
      const bool firstIsNearer = nodes_[at + 1].box.distance(point) <= nodes_[node.second].box.distance(point);
      waiting[size++] = firstIsNearer ? node.second : at + 1;
      waiting[size++] = firstIsNearer ? at + 1 : node.second;
      continue;
    }
    for (int k = node.first; k < node.first + node.count; ++k) {
      const int i = order_[k];
      const double away = distance(i);
      if (best >= 0 && (away > least || (away == least && i > best))) continue;
      least = away;
      best = i;
    }
  }
  return best;
}

}  // namespace suture
