#pragma once
#include <numeric>
#include <vector>

namespace suture {

/// Sets of the numbers 0, 1, ... that are joined one by one (union-find with path halving): connected components without searching from
/// neighbour to neighbour. A set is known by its lowest member. Local.
class DisjointSets {
 public:
  explicit DisjointSets(int count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  /// Lowest member of the set that i is in.
  int lowest(int i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// Makes one set of those of i and j; returns its lowest member.
  int join(int i, int j) {
    if (parent_[j] == i && parent_[i] == i) return i;  // most often, where a mesh is large and i what the last call returned
    const int a = lowest(i), b = lowest(j);
    return a < b ? parent_[b] = a : parent_[a] = b;
  }

 private:
  std::vector<int> parent_;
};

}  // namespace suture
