#pragma once
#include <utility>
#include <vector>

namespace suture {

/// A node for each of some edges, found by the two ends of the edge: lists per lower end, which are short. Local.
class EdgeNodes {
 public:
  /// \param nodes  expected number of nodes; ends with larger numbers are possible
  explicit EdgeNodes(int nodes) : first_(static_cast<std::size_t>(nodes), -1) {}

  /// Node of the edge between two nodes, or -1.
  int at(int a, int b) const {
    if (b < a) std::swap(a, b);
    if (a >= static_cast<int>(first_.size())) return -1;
    for (int k = first_[a]; k >= 0; k = entries_[k].next)
      if (entries_[k].high == b) return entries_[k].node;
    return -1;
  }
  /// Adds an edge that has no node yet.
  void add(int a, int b, int node) {
    if (b < a) std::swap(a, b);
    if (a >= static_cast<int>(first_.size())) first_.resize(static_cast<std::size_t>(a) + a / 2 + 1, -1);
    entries_.push_back({b, node, first_[a]});
    first_[a] = static_cast<int>(entries_.size()) - 1;
  }
  std::size_t size() const { return entries_.size(); }

 private:
  struct Entry {
    int high, node, next;
  };
  std::vector<int> first_;
  std::vector<Entry> entries_;
};

}  // namespace suture
