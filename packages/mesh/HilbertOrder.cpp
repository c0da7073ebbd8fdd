#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <suture/mesh/HilbertOrder.hpp>
#include <utility>

namespace suture {
namespace {

constexpr std::uint32_t kSteps = 1u << 16;  // squares or cubes in each direction; elements in the same cube keep their order

using Cube = std::array<std::uint32_t, 3>;  // steps along each axis; in 2D only two are used

// Position of a cube on the curve that starts in the lowest corner and ends at the far end of the x axis. From the largest cubes to the
// smallest, the part of the curve in a cube is mirrored and its axes are exchanged to make the curve continuous; the Gray code of the
// coordinates then gives the path from cube to cube (Skilling's AxesToTranspose).
std::uint64_t placeOnCurve(Cube x, int dimension) {
  for (std::uint32_t half = kSteps / 2; half > 1; half /= 2)
    for (int k = 0; k < dimension; ++k) {
      const std::uint32_t lower = half - 1, other = (x[0] ^ x[k]) & lower;
      if (x[k] & half) {
        x[0] ^= lower;
      } else {
        x[0] ^= other;
        x[k] ^= other;
      }
    }
  for (int k = 1; k < dimension; ++k) x[k] ^= x[k - 1];
  std::uint32_t turn = 0;
  for (std::uint32_t half = kSteps / 2; half > 1; half /= 2)
    if (x[dimension - 1] & half) turn ^= half - 1;
  std::uint64_t place = 0;
  for (std::uint32_t half = kSteps / 2; half > 0; half /= 2)
    for (int k = 0; k < dimension; ++k) place = 2 * place + (((x[k] ^ turn) & half) != 0);
  return place;
}

// Elements in their new order.
std::vector<int> alongCurve(const CellBlock& block) {
  const int dimension = block.dimension;
  double low[3], size = 0;
  for (int k = 0; k < dimension; ++k) {
    double high = -std::numeric_limits<double>::infinity();
    low[k] = -high;
    for (int node = 0; node < block.nodes(); ++node) {
      const double x = block.coordinates[std::size_t(node) * dimension + k];
      low[k] = std::min(low[k], x);
      high = std::max(high, x);
    }
    size = std::max(size, high - low[k]);
  }
  const double cells = size > 0 ? (kSteps - 1) / size : 0;
  std::vector<std::pair<std::uint64_t, int>> places;
  places.reserve(block.elements());
  for (int e = 0; e < block.elements(); ++e) {
    const auto nodes = block.nodesOf(e);
    Cube cube{};
    for (int k = 0; k < dimension; ++k) {
      double sum = 0;
      for (const int node : nodes) sum += block.coordinates[std::size_t(node) * dimension + k] - low[k];
      cube[k] = static_cast<std::uint32_t>(std::min<double>(kSteps - 1, cells * sum / static_cast<double>(nodes.size())));
    }
    places.emplace_back(placeOnCurve(cube, dimension), e);
  }
  std::sort(places.begin(), places.end());
  std::vector<int> order;
  order.reserve(places.size());
  for (const auto& place : places) order.push_back(place.second);
  return order;
}

// Moves the values of each element or node, if any, to their new places.
template <typename T>
void renumber(const std::vector<int>& newOf, std::size_t width, std::vector<T>& values) {
  const std::vector<T> old = values;
  for (std::size_t i = 0; i * width < old.size(); ++i) std::copy_n(old.data() + i * width, width, values.data() + newOf[i] * width);
}

}  // namespace

void numberAlongHilbertCurve(Mesh& mesh) {
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
    if (number < 0) number = nodes++;  // a node without elements: the check of the mesh reports it
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
