#include <algorithm>
#include <numeric>
#include <suture/algebra/DisjointSets.hpp>
#include <suture/base/Errors.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/partition/cut/ElementGraph.hpp>

namespace suture {
namespace {

// A side, stored in the list of its lowest vertex.
struct HalfSide {
  long long rest;  // SideKey::rest
  int element;     // the first element with this side; `none` after the second
};
constexpr int none = -1;

[[noreturn]] void refuse(const CellBlock& block, const SideKey& key, const Side& side) {
  int elements = 0;
  for (int e = 0; e < block.elements(); ++e) forEachSide(block, e, [&](const SideKey& other, const Side&) { elements += other == key; });
  std::string places;
  const CellInfo& cell = cellInfo(block.cells[side.element]);
  for (const int local : cell.sideNodes[side.side])
    if (local < cell.vertices)
      places += (places.empty() ? " from " : " to ") + placeText(block.point(block.nodesOf(side.element)[local]), block.dimension);
  throw InputError("Mesh", std::to_string(elements) + " elements share the side" + places + "; at most two can");
}

Point centreOfVertices(const CellBlock& block, int element) {
  Point centre{0, 0, 0};
  const int vertices = cellInfo(block.cells[element]).vertices;
  for (int k = 0; k < vertices; ++k) centre = plus(centre, scaled(1.0 / vertices, block.point(block.nodesOf(element)[k])));
  return centre;
}

}  // namespace

ElementGraph elementGraph(const CellBlock& block) {
  // Reserve space for the sides of each lowest vertex, by counting: linear in the size of the mesh.
  std::vector<int> start(block.nodes() + 1, 0);
  for (int e = 0; e < block.elements(); ++e) forEachSide(block, e, [&](const SideKey& key, const Side&) { ++start[key.low + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<HalfSide> sides(start.back());
  std::vector<int> stop(start.begin(), start.end() - 1);

  // Reserve space for a neighbour across each side; unused space is removed at the end.
  ElementGraph graph;
  graph.offsets.resize(block.elements() + 1);
  for (int e = 0; e < block.elements(); ++e)
    graph.offsets[e + 1] = graph.offsets[e] + static_cast<int>(cellInfo(block.cells[e]).sideNodes.size());
  graph.neighbours.resize(graph.offsets.back());
  std::vector<int> end(graph.offsets.begin(), graph.offsets.end() - 1);
  const auto match = [&](const SideKey& key, const Side& own) {
    HalfSide *side = sides.data() + start[key.low], *const last = sides.data() + stop[key.low];
    while (side != last && side->rest != key.rest) ++side;
    if (side == last) {
      *side = {key.rest, own.element};
      ++stop[key.low];
      return;
    }
    if (side->element == none) refuse(block, key, own);
    graph.neighbours[end[own.element]++] = side->element;
    graph.neighbours[end[side->element]++] = own.element;
    side->element = none;
  };
  for (int e = 0; e < block.elements(); ++e) forEachSide(block, e, match);
  int to = 0;
  for (int e = 0; e < block.elements(); ++e) {
    const int from = graph.offsets[e];
    graph.offsets[e] = to;
    for (int k = from; k < end[e]; ++k) graph.neighbours[to++] = graph.neighbours[k];
    std::sort(graph.neighbours.begin() + graph.offsets[e], graph.neighbours.begin() + to);
  }
  graph.offsets.back() = to;
  graph.neighbours.resize(to);
  graph.neighbours.shrink_to_fit();
  if (block.dimension == 3)
    for (int e = 0; e < block.elements(); ++e) graph.centres.push_back(centreOfVertices(block, e));
  return graph;
}

std::vector<ElementGraph> subgraphs(const ElementGraph& graph, const std::vector<int>& partOf, int parts) {
  std::vector<int> numberOf(graph.elements());
  std::vector<std::size_t> elements(parts, 0), neighbours(parts, 0);
  for (int e = 0; e < graph.elements(); ++e) {
    numberOf[e] = static_cast<int>(elements[partOf[e]]++);
    neighbours[partOf[e]] += graph.of(e).size();
  }
  std::vector<ElementGraph> of(parts);
  for (int part = 0; part < parts; ++part) {
    of[part].offsets.reserve(elements[part] + 1);
    of[part].neighbours.reserve(neighbours[part]);
  }
  for (int e = 0; e < graph.elements(); ++e) {
    ElementGraph& own = of[partOf[e]];
    for (const int other : graph.of(e))
      if (partOf[other] == partOf[e]) own.neighbours.push_back(numberOf[other]);  // ascending, because numbers are
    own.offsets.push_back(static_cast<int>(own.neighbours.size()));
    if (!graph.centres.empty()) own.centres.push_back(graph.centres[e]);
  }
  return of;
}

Components components(const ElementGraph& graph, const std::vector<int>& labels) {
  // Visit elements in memory order instead of following neighbours.
  DisjointSets sets(graph.elements());
  for (int e = 0; e < graph.elements(); ++e)
    for (const int other : graph.of(e))
      if (other < e && labels[other] == labels[e]) sets.join(e, other);
  Components found;
  found.of.resize(graph.elements());
  std::vector<int> sizes;
  for (int e = 0; e < graph.elements(); ++e) {
    const int first = sets.lowest(e);
    if (first == e) {
      found.of[e] = static_cast<int>(sizes.size());
      sizes.push_back(0);
    }
    found.of[e] = found.of[first];
    ++sizes[found.of[e]];
  }
  found.elements.resize(sizes.size());
  for (std::size_t c = 0; c < sizes.size(); ++c) found.elements[c].reserve(sizes[c]);
  for (int e = 0; e < graph.elements(); ++e) found.elements[found.of[e]].push_back(e);  // ascending without sorting
  return found;
}

}  // namespace suture
