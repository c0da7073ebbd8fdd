#include <suture/algebra/elimination/NestedDissection.hpp>

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace suture {

namespace {

/// Orders by one coordinate, then by the others.
struct Before {
  const std::vector<Point>& places;
  int axis;

  bool operator()(int a, int b) const {
    const double x = places[a][axis], y = places[b][axis];
    return x < y || (x == y && key(a) < key(b));
  }
  std::tuple<double, double, int> key(int vertex) const {
    const Point& p = places[vertex];
    return {p[(axis + 1) % 3], p[(axis + 2) % 3], vertex};
  }
};

class Dissector {
 public:
  Dissector(const Adjacency& graph, const std::vector<Point>& places, int count, int leaf)
      : graph_(graph), places_(places), leaf_(std::max(leaf, 1)), half_(graph.size(), -1), vertices_(count) {
    std::iota(vertices_.begin(), vertices_.end(), 0);
    result_.order.reserve(count);
  }

  DissectionOrder run() && {
    dissect(0, static_cast<int>(vertices_.size()));
    return std::move(result_);
  }

 private:
  // Vertices [begin, end) of the work space.
  void dissect(int begin, int end) {
    if (end - begin <= leaf_) {
      append(vertices_.begin() + begin, vertices_.begin() + end);
      return;
    }
    const int axis = longestAxis(begin, end), middle = begin + (end - begin) / 2;
    const auto at = [this](int position) { return vertices_.begin() + position; };
    // Vertices with equal coordinates, as in regular meshes, are ordered along their line: any other order would cut the line many times.
    std::nth_element(at(begin), at(middle), at(end), Before{places_, axis});
    const int low = newMark(), high = newMark();
    mark(begin, middle, low);
    mark(middle, end, high);
    const auto touching = [&](int mark) { return [this, mark](int vertex) { return touches(vertex, mark); }; };
    const auto ofLow = std::count_if(at(begin), at(middle), touching(high)), ofHigh = std::count_if(at(middle), at(end), touching(low));
    const bool fromLow = ofLow < ofHigh;
    const int first = fromLow ? begin : middle, last = fromLow ? middle : end;
    const auto isInside = [this, other = fromLow ? high : low](int vertex) { return !touches(vertex, other); };
    const int split = static_cast<int>(std::partition(at(first), at(last), isInside) - vertices_.begin());
    // Along the separator, so that the rows below a front have few gaps.
    std::sort(at(split), at(last), Before{places_, axis == 0 ? 1 : 0});
    dissect(begin, fromLow ? split : middle);
    dissect(middle, fromLow ? end : split);
    append(at(split), at(last));
  }

  int longestAxis(int begin, int end) const {
    Point least, most;
    least.fill(std::numeric_limits<double>::infinity());
    most.fill(-std::numeric_limits<double>::infinity());
    for (int i = begin; i < end; ++i)
      for (int k = 0; k < 3; ++k) {
        const double x = places_[vertices_[i]][k];
        least[k] = std::min(least[k], x);
        most[k] = std::max(most[k], x);
      }
    int axis = 0;
    for (int k = 1; k < 3; ++k)
      if (most[k] - least[k] > most[axis] - least[axis]) axis = k;
    return axis;
  }

  int newMark() { return ++marks_; }
  void mark(int begin, int end, int mark) {
    for (int i = begin; i < end; ++i) half_[vertices_[i]] = mark;
  }
  bool touches(int vertex, int mark) const {
    const Span<const int> neighbours = graph_.of(vertex);
    return std::any_of(neighbours.begin(), neighbours.end(), [&](int other) { return half_[other] == mark; });
  }

  template <typename Iterator>
  void append(Iterator begin, Iterator end) {
    if (begin == end) return;
    result_.order.insert(result_.order.end(), begin, end);
    result_.ends.push_back(static_cast<int>(result_.order.size()));
  }

  const Adjacency& graph_;
  const std::vector<Point>& places_;
  const int leaf_;
  int marks_ = 0;
  std::vector<int> half_;  // mark of each vertex's last half; none for vertices that are not ordered
  std::vector<int> vertices_;
  DissectionOrder result_;
};

}  // namespace

DissectionOrder nestedDissection(const Adjacency& graph, const std::vector<Point>& places, int count, int leaf) {
  return Dissector(graph, places, count, leaf).run();
}

}  // namespace suture
