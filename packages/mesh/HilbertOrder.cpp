#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <suture/mesh/HilbertOrder.hpp>
#include <tuple>
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

// Box of points as a row of cubes along its longest axis. Each cube is stretched so that the row fills the box.
struct CubeRow {
  std::array<int, 3> axes{0, 1, 2};  // longest extent first
  Point low{};
  std::array<double, 3> sides{};  // edges of a cube, in the order of `axes`
  int cubes = 1, directions;      // cubes in the row; axes that a cube has

  CubeRow(const std::vector<Point>& points, int dimension) : directions(dimension) {
    constexpr double kThin = 1.0 / 3.0;  // smallest extent of the third axis compared with the second
    std::array<double, 3> extent{};
    for (int k = 0; k < dimension; ++k) {
      const auto [least, most] =
          std::minmax_element(points.begin(), points.end(), [k](const Point& a, const Point& b) { return a[k] < b[k]; });
      low[k] = (*least)[k];
      extent[k] = (*most)[k] - low[k];
    }
    // Points are centres: the box extends beyond them by half of their distance.
    const double distance = distanceOf(points.size(), extent, dimension);
    for (int k = 0; k < dimension; ++k) {
      low[k] -= 0.5 * distance;
      extent[k] += distance;
    }
    // Almost equal extents keep the order of the axes.
    std::stable_sort(axes.begin(), axes.begin() + dimension, [&](int a, int b) { return extent[a] > (1 + 1e-6) * extent[b]; });
    if (dimension == 3 && extent[axes[2]] < kThin * extent[axes[1]]) directions = 2;
    if (extent[axes[1]] > 0.0) cubes = std::max(1, static_cast<int>(std::lround(extent[axes[0]] / extent[axes[1]])));
    for (int k = 0; k < 3; ++k) sides[k] = extent[axes[k]] / (k == 0 ? cubes : 1);
  }

  // Distance of the points of a regular grid with this number of points and these extents.
  static double distanceOf(std::size_t points, const std::array<double, 3>& extent, int dimension) {
    constexpr int kIterations = 50;  // the error of each is at most 0.7 times that of the last one
    double distance = *std::max_element(extent.begin(), extent.end());
    for (int step = 0; step < kIterations; ++step) {
      double volume = 1.0 / static_cast<double>(points);
      for (int k = 0; k < dimension; ++k) volume *= extent[k] + distance;
      distance = std::pow(volume, 1.0 / dimension);
    }
    return distance;
  }

  // Cube and position on its curve.
  std::pair<int, std::uint64_t> placeOf(const Point& point) const {
    constexpr double kOffGrid = 0.25;  // halves, quarters, ... of a box are not at a step, where round-off would decide
    std::array<double, 3> at{};
    for (int k = 0; k < directions; ++k) at[k] = sides[k] > 0.0 ? (point[axes[k]] - low[axes[k]]) / sides[k] + kOffGrid / kSteps : 0.0;
    const int cube = std::min(static_cast<int>(at[0]), cubes - 1);
    at[0] -= cube;
    Cube steps{};
    for (int k = 0; k < directions; ++k) steps[k] = static_cast<std::uint32_t>(std::min<double>(kSteps - 1, at[k] * kSteps));
    return {cube, placeOnCurve(steps, directions)};
  }
};

}  // namespace

std::vector<int> orderAlongHilbertCurve(const std::vector<Point>& points, int dimension) {
  if (points.empty()) return {};
  const CubeRow row(points, dimension);
  std::vector<std::tuple<int, std::uint64_t, double, int>> places;  // cube, position, coordinate along the shortest axis, number
  places.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto [cube, place] = row.placeOf(points[i]);
    places.emplace_back(cube, place, dimension == 3 && row.directions == 2 ? points[i][row.axes[2]] : 0.0, static_cast<int>(i));
  }
  std::sort(places.begin(), places.end());
  std::vector<int> order;
  order.reserve(places.size());
  for (const auto& place : places) order.push_back(std::get<3>(place));
  return order;
}

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
