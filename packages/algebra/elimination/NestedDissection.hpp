#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// Graph of the couplings, in both directions: the neighbours of i are adjacent[first[i] .. first[i + 1]).
struct Adjacency {
  std::vector<int> first = {0}, adjacent;

  int size() const { return static_cast<int>(first.size()) - 1; }
  Span<const int> of(int i) const { return {adjacent.data() + first[i], static_cast<std::size_t>(first[i + 1] - first[i])}; }
};

/// An elimination order in blocks, children before parents.
struct DissectionOrder {
  std::vector<int> order;  ///< position -> vertex
  std::vector<int> ends;   ///< end of each block, where the next begins
};

/// Nested dissection (George 1973) by coordinates: a set of vertices is halved at the median along the longer side of its bounding box. The
/// vertices of one half that are adjacent to the other half, taken from the half where they are fewer, form the separator and come last. A
/// set of up to `leaf` vertices is one block. Correct for any coordinates; efficient if neighbours are close to each other. Local.
/// \param count  number of vertices, from the first on, that are ordered; the others are left out
DissectionOrder nestedDissection(const Adjacency& graph, const std::vector<Point>& places, int count, int leaf);

}  // namespace suture
