#pragma once
#include <numeric>
#include <vector>

namespace suture {

/// Union-find with path halving on the numbers 0, 1, ...: connected components without a graph search. A set is identified by its lowest
/// member. Local.
class DisjointSets {
 public:
  explicit DisjointSets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// Lowest member of the set of i.
  int lowest(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Unites the sets of i and j; returns the lowest member.
  int join(int i, int j) {
    if (parent_[j] == i && parent_[i] == i) return i;  // the most frequent case on large meshes, with i returned by the last call
    const int a = lowest(i), b = lowest(j);
    return a < b ? parent_[b] = a : parent_[a] = b;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace suture
