#include <suture/pairs/AxisPoints.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace suture {

namespace {

constexpr double kWeightless = 1e-2;  // relative to a neighbour's tributary area; a two-node side on the axis has a sixth of it

/// Means of r^2 over the circle with the shape functions of the two nodes next to the axis, whose sides are (0, 1, 2) and, if there are
/// enough nodes, (2, 3, 4).
std::array<double, 2> meansOfSquaredRadius(const std::vector<Point>& nodes) {
  constexpr double places[] = {-0.906179845938664, -0.538469310105683, 0.0, 0.538469310105683, 0.906179845938664};
  constexpr double weights[] = {0.236926885056189, 0.478628670499366, 0.568888888888889, 0.478628670499366, 0.236926885056189};
  std::array<double, 2> area{}, moment{};
  const std::size_t last = nodes.size() >= 5 ? 2 : 0;
  for (std::size_t first = 0; first <= last; first += 2)
    for (int g = 0; g < 5; ++g) {
      const double s = places[g];
      const double shape[] = {s * (s - 1) / 2, 1 - s * s, s * (s + 1) / 2}, slope[] = {s - 0.5, -2 * s, s + 0.5};
      double r = 0.0, along[2] = {0.0, 0.0};
      for (int i = 0; i < 3; ++i) {
        r += shape[i] * nodes[first + i][0];
        for (int k = 0; k < 2; ++k) along[k] += slope[i] * nodes[first + i][k];
      }
      const double ring = weights[g] * r * std::hypot(along[0], along[1]);
      for (int node = 0; node < 2; ++node) {
        const std::size_t i = static_cast<std::size_t>(node) + 1 - first;  // local number on the side
        if (i > 2) continue;
        area[node] += ring * shape[i];
        moment[node] += ring * shape[i] * r * r;
      }
    }
  return {moment[0] / area[0], moment[1] / area[1]};
}

/// Weights of two values in the value of a + b q at q = 0.
std::array<double, 2> weightsAtZero(double q0, double q1) { return {q1 / (q1 - q0), -q0 / (q1 - q0)}; }

/// \param way  ids of the pair on the axis and of the pairs after it, up to five in total
AxisPoint axisPoint(const PairedSurface& all, const std::vector<int>& way) {
  const ContactPair& end = all.pairs[way[0]];
  AxisPoint point;
  point.node = end.node();
  point.arc = end.arc;
  point.position = end.position;
  point.normal = end.normal;
  if (way.size() < 3) return point;
  std::vector<Point> nodes;
  for (const int id : way) nodes.push_back(all.pairs[id].position);
  const std::array<double, 2> means = meansOfSquaredRadius(nodes);
  point.pressure = weightsAtZero(means[0], means[1]);
  point.value = weightsAtZero(nodes[1][0] * nodes[1][0], nodes[2][0] * nodes[2][0]);
  return point;
}

/// Up to five successive pairs from the end of a line.
std::vector<int> wayFrom(int end, const std::vector<std::vector<int>>& beside) {
  std::vector<int> way{end};
  for (int next = beside[end].front(); next >= 0 && way.size() < 5;) {
    const int last = way.back();
    way.push_back(next);
    const std::vector<int>& following = beside[next];
    next = following.size() < 2 ? -1 : following[0] == last ? following[1] : following[0];
  }
  return way;
}

}  // namespace

PairedSurface withoutWeightless(const PairedSurface& all) {
  const int count = static_cast<int>(all.pairs.size());
  const std::vector<std::vector<int>> beside = neighbourPairs(all.cells, count);
  PairedSurface some;
  std::vector<int> numberOf(count, -1);
  for (int i = 0; i < count; ++i) {
    double largest = 0.0;
    for (const int other : beside[i]) largest = std::max(largest, all.pairs[other].length);
    if (std::abs(all.pairs[i].length) <= kWeightless * largest) continue;
    numberOf[i] = static_cast<int>(some.pairs.size());
    some.pairs.push_back(all.pairs[i]);
    some.pairs.back().id = numberOf[i];
    if (!all.gapDoubts.empty()) some.gapDoubts.push_back(all.gapDoubts[i]);
  }
  for (int i = 0; i < count; ++i) {
    if (numberOf[i] >= 0 || beside[i].size() != 1) continue;
    const std::vector<int> way = wayFrom(i, beside);
    some.onAxis.push_back(axisPoint(all, way));
    some.onAxis.back().pairs = {numberOf[way[1]], numberOf[way.size() < 3 ? way[1] : way[2]]};
  }
  for (std::vector<int> cell : all.cells) {
    for (int& id : cell) id = numberOf[id];
    if (std::count(cell.begin(), cell.end(), -1) == 0) some.cells.push_back(std::move(cell));
  }
  return some;
}

}  // namespace suture
