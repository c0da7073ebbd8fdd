#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// Graph of the couplings, both ways: neighbours of i are adjacent[first[i] .. first[i + 1]).
struct Adjacency {
  std::vector<int> first = {0}, adjacent;

  int size() const { return static_cast<int>(first.size()) - 1; }
  Span<const int> of(int i) const { return {adjacent.data() + first[i], static_cast<std::size_t>(first[i + 1] - first[i])}; }
};

/// An order of elimination in blocks, children before parents.
struct DissectionOrder {
  std::vector<int> order;  ///< position -> vertex
  std::vector<int> ends;   ///< end of each block: where the next begins
};

/// Nested dissection (George 1973) by places: a set of vertices is halved at the median along the longer side of its bounding box; those of
/// one half that touch the other, of the half where they are fewer, separate the rest, and come last. Up to `leaf` vertices are a block of
/// their own. Right for any places, good where neighbours are near each other. Local.
/// \param count  the first so many vertices are ordered; the others are left out
DissectionOrder nestedDissection(const Adjacency& graph, const std::vector<Point>& places, int count, int leaf);

}  // namespace suture
