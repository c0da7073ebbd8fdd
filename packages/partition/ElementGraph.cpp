#include <algorithm>
#include <numeric>
#include <suture/base/Errors.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/partition/ElementGraph.hpp>

namespace suture {
namespace {

// A side by its end point of higher number, in the list of its lower one.
struct HalfSide {
  int high;
  int element;
};

}  // namespace

ElementGraph elementGraph(const CellBlock& block) {
  const auto forEachSide = [&block](const auto& visit) {
    for (int e = 0; e < block.elements(); ++e) {
      const Span<const int> nodes = block.nodesOf(e);
      for (const std::vector<int>& side : cellInfo(block.cells[e]).sideNodes) visit(e, std::minmax(nodes[side[0]], nodes[side[1]]));
    }
  };

  // Sides sorted by their lower end point, by counting: linear in the size of the mesh.
  std::vector<int> start(block.nodes() + 1, 0);
  forEachSide([&](int, std::pair<int, int> ends) { ++start[ends.first + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<HalfSide> sides(start.back());
  std::vector<int> next(start.begin(), start.end() - 1);
  forEachSide([&](int e, std::pair<int, int> ends) { sides[next[ends.first]++] = {ends.second, e}; });

  std::vector<std::pair<int, int>> links;
  for (int node = 0; node < block.nodes(); ++node) {
    const auto begin = sides.begin() + start[node], end = sides.begin() + start[node + 1];
    std::sort(begin, end, [](const HalfSide& a, const HalfSide& b) { return std::tie(a.high, a.element) < std::tie(b.high, b.element); });
    for (auto first = begin; first != end;) {
      const auto last = std::find_if(first, end, [&](const HalfSide& side) { return side.high != first->high; });
      if (last - first > 2)
        throw InputError("Mesh", std::to_string(last - first) + " elements share the side from " + placeText(block.point(node)) + " to " +
                                     placeText(block.point(first->high)) + "; at most two can");
      if (last - first == 2) {
        links.emplace_back(first->element, (first + 1)->element);
        links.emplace_back((first + 1)->element, first->element);
      }
      first = last;
    }
  }

  ElementGraph graph;
  graph.offsets.assign(block.elements() + 1, 0);
  for (const auto& link : links) ++graph.offsets[link.first + 1];
  std::partial_sum(graph.offsets.begin(), graph.offsets.end(), graph.offsets.begin());
  graph.neighbours.resize(links.size());
  std::vector<int> fill(graph.offsets.begin(), graph.offsets.end() - 1);
  for (const auto& link : links) graph.neighbours[fill[link.first]++] = link.second;
  for (int e = 0; e < graph.elements(); ++e)
    std::sort(graph.neighbours.begin() + graph.offsets[e], graph.neighbours.begin() + graph.offsets[e + 1]);
  return graph;
}

ElementGraph subgraph(const ElementGraph& graph, const std::vector<int>& elements) {
  std::vector<int> numberOf(graph.elements(), -1);
  for (std::size_t i = 0; i < elements.size(); ++i) numberOf[elements[i]] = static_cast<int>(i);
  ElementGraph part;
  for (int e : elements) {
    for (int other : graph.of(e))
      if (numberOf[other] >= 0) part.neighbours.push_back(numberOf[other]);
    std::sort(part.neighbours.begin() + part.offsets.back(), part.neighbours.end());
    part.offsets.push_back(static_cast<int>(part.neighbours.size()));
  }
  return part;
}

Components components(const ElementGraph& graph, const std::vector<int>& labels) {
  Components found;
  found.of.assign(graph.elements(), -1);
  std::vector<int> reached, sizes;
  for (int seed = 0; seed < graph.elements(); ++seed) {
    if (found.of[seed] >= 0) continue;
    const int number = static_cast<int>(sizes.size());
    reached.assign(1, seed);
    found.of[seed] = number;
    for (std::size_t i = 0; i < reached.size(); ++i)
      for (int other : graph.of(reached[i]))
        if (found.of[other] < 0 && labels[other] == labels[seed]) {
          found.of[other] = number;
          reached.push_back(other);
        }
    sizes.push_back(static_cast<int>(reached.size()));
  }
  found.elements.resize(sizes.size());
  for (std::size_t c = 0; c < sizes.size(); ++c) found.elements[c].reserve(sizes[c]);
  for (int e = 0; e < graph.elements(); ++e) found.elements[found.of[e]].push_back(e);  // ascending, without sorting
  return found;
}

}  // namespace suture
