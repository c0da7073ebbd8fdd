#pragma once
#include <suture/base/Point.hpp>
#include <suture/base/Types.hpp>
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Dual graph of a mesh: elements are neighbours if they share a side. Compressed rows, neighbours ascending.
struct ElementGraph {
  std::vector<int> offsets{0};  ///< elements + 1
  std::vector<int> neighbours;
  std::vector<Point> centres;  ///< in 3D: centres of the elements, for cuts by planes [length]; empty in 2D

  int elements() const { return static_cast<int>(offsets.size()) - 1; }
  Span<const int> of(int element) const {
    return {neighbours.data() + offsets[element], std::size_t(offsets[element + 1] - offsets[element])};
  }
};

/// Local. \throws InputError  if more than two elements share a side; names the place.
ElementGraph elementGraph(const CellBlock& block);

/// Graphs of parts, each numbered by its own elements in their order; neighbours in other parts are omitted. Local.
/// \param partOf  element -> part, 0..parts-1
std::vector<ElementGraph> subgraphs(const ElementGraph& graph, const std::vector<int>& partOf, int parts);

/// Connected components of elements with equal labels.
struct Components {
  std::vector<int> of;                     ///< element -> component
  std::vector<std::vector<int>> elements;  ///< elements of each component, ascending; components in the order of their first elements
  int count() const { return static_cast<int>(elements.size()); }
};
Components components(const ElementGraph& graph, const std::vector<int>& labels);

}  // namespace suture
