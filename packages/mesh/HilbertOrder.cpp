#include <algorithm>
#include <cstdint>
#include <limits>
#include <suture/base/Errors.hpp>
#include <suture/mesh/HilbertOrder.hpp>
#include <utility>

namespace suture {
namespace {

constexpr std::uint32_t kCells = 1u << 16;  // cells of the square in x and in y; elements in the same one keep their order

// Place of a cell on the curve that starts in the lower left corner: quadrant by quadrant, each turned so that the curve goes on.
std::uint32_t placeOnCurve(std::uint32_t x, std::uint32_t y) {
  std::uint32_t place = 0;
  for (std::uint32_t half = kCells / 2; half > 0; half /= 2) {
    const bool right = x & half, upper = y & half;
    place = 4 * place + (upper ? (right ? 2 : 1) : (right ? 3 : 0));
    if (upper) continue;
    if (right) {
      x = kCells - 1 - x;
      y = kCells - 1 - y;
    }
    std::swap(x, y);
  }
  return place;
}

// The elements in their new order.
std::vector<int> alongCurve(const CellBlock& block) {
  double low[2], size = 0;
  for (int k = 0; k < 2; ++k) {
    double high = -std::numeric_limits<double>::infinity();
    low[k] = -high;
    for (int node = 0; node < block.nodes(); ++node) {
      const double x = block.coordinates[std::size_t(node) * 2 + k];
      low[k] = std::min(low[k], x);
      high = std::max(high, x);
    }
    size = std::max(size, high - low[k]);
  }
  const double cells = size > 0 ? (kCells - 1) / size : 0;
  std::vector<std::pair<std::uint32_t, int>> places;
  places.reserve(block.elements());
  for (int e = 0; e < block.elements(); ++e) {
    const auto nodes = block.nodesOf(e);
    std::uint32_t cell[2];
    for (int k = 0; k < 2; ++k) {
      double sum = 0;
      for (const int node : nodes) sum += block.coordinates[std::size_t(node) * 2 + k] - low[k];
      cell[k] = static_cast<std::uint32_t>(std::min<double>(kCells - 1, cells * sum / static_cast<double>(nodes.size())));
    }
    places.emplace_back(placeOnCurve(cell[0], cell[1]), e);
  }
  std::sort(places.begin(), places.end());
  std::vector<int> order;
  order.reserve(places.size());
  for (const auto& place : places) order.push_back(place.second);
  return order;
}

// Values of each element or node, if there are any, to their new places.
template <typename T>
void renumber(const std::vector<int>& newOf, std::size_t width, std::vector<T>& values) {
  const std::vector<T> old = values;
  for (std::size_t i = 0; i * width < old.size(); ++i) std::copy_n(old.data() + i * width, width, values.data() + newOf[i] * width);
}

}  // namespace

void numberAlongHilbertCurve(Mesh& mesh) {
  if (mesh.dimension != 2) throw InternalError("elements are numbered along a curve in the plane");
  const std::vector<int> order = alongCurve(mesh);
  std::vector<int> elementOf(mesh.elements()), nodeOf(mesh.nodes(), -1);  // old number -> new one
  std::vector<int> offsets{0}, connectivity;
  int nodes = 0;
  for (const int e : order) {
    elementOf[e] = static_cast<int>(offsets.size()) - 1;
    for (const int node : mesh.nodesOf(e)) {
      if (nodeOf[node] < 0) nodeOf[node] = nodes++;
      connectivity.push_back(nodeOf[node]);
    }
    offsets.push_back(static_cast<int>(connectivity.size()));
  }
  for (int& number : nodeOf)
    if (number < 0) number = nodes++;  // a node of no element: the check of the mesh reports it
  mesh.offsets = std::move(offsets);
  mesh.connectivity = std::move(connectivity);
  renumber(elementOf, 1, mesh.cells);
  renumber(elementOf, 1, mesh.regions);
  renumber(elementOf, 1, mesh.bodyOfElement);
  renumber(nodeOf, 1, mesh.bodyOfNode);
  renumber(nodeOf, mesh.dimension, mesh.coordinates);

  for (auto& group : mesh.elementGroups) {
    for (int& e : group.second) e = elementOf[e];
    std::sort(group.second.begin(), group.second.end());
  }
  for (auto& group : mesh.sideGroups) {
    for (Side& side : group.second) side.element = elementOf[side.element];
    std::sort(group.second.begin(), group.second.end(),
              [](const Side& a, const Side& b) { return std::make_pair(a.element, a.side) < std::make_pair(b.element, b.side); });
  }
}

}  // namespace suture
