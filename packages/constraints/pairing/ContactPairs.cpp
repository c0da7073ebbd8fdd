#include <suture/constraints/pairing/ContactPairs.hpp>
#include <suture/constraints/pairing/MatchingPairs.hpp>
#include <suture/constraints/pairing/MortarPairs.hpp>
#include <suture/constraints/pairing/ObstaclePairs.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace suture {

namespace {

constexpr double kWeightless = 1e-2;  // part of a neighbour's tributary area; on the axis a two-node side has a sixth of it

/// Means of r^2 over the circle with the shape functions of the first two nodes beside the axis, whose sides are (0, 1, 2) and, where there
/// are as many, (2, 3, 4).
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
        const std::size_t i = static_cast<std::size_t>(node) + 1 - first;  // its place on the side
        if (i > 2) continue;
        area[node] += ring * shape[i];
        moment[node] += ring * shape[i] * r * r;
      }
    }
  return {moment[0] / area[0], moment[1] / area[1]};
}

/// Weights of two values for that of a + b q at q = 0.
std::array<double, 2> weightsAtZero(double q0, double q1) { return {q1 / (q1 - q0), -q0 / (q1 - q0)}; }

/// \param at  position in `all` of the node on the axis;  \param step  1 or -1, away from it along the chain of `count` pairs
AxisPoint axisPoint(const PairedLine& all, int at, int step, int count) {
  const ContactPair& end = all.pairs[at];
  AxisPoint point;
  point.node = end.node();
  point.arc = end.arc;
  point.position = end.position;
  point.normal = end.normal;
  std::vector<Point> nodes;
  for (int i = 0; i < std::min(count, 5); ++i) nodes.push_back(all.pairs[at + i * step].position);
  if (nodes.size() < 3) return point;
  const std::array<double, 2> means = meansOfSquaredRadius(nodes);
  point.pressure = weightsAtZero(means[0], means[1]);
  point.value = weightsAtZero(nodes[1][0] * nodes[1][0], nodes[2][0] * nodes[2][0]);
  return point;
}

/// Leaves out pairs without a tributary area. The end of a second-order side on the axis is one: the integral of its hat function over the
/// circle is zero, or nearly so if the side is curved: no pressure has a force there, and no force decides whether it is closed.
PairedLine withoutWeightless(const PairedLine& all) {
  PairedLine some;
  for (const PairedLine::Chain& chain : all.chains) {
    PairedLine::Chain rest{static_cast<int>(some.pairs.size()), 0, chain.closed};
    for (int i = 0; i < chain.count; ++i) {
      const int at = chain.first + i;
      const double before = i > 0 ? all.pairs[at - 1].length : 0.0, after = i + 1 < chain.count ? all.pairs[at + 1].length : 0.0;
      if (std::abs(all.pairs[at].length) <= kWeightless * std::max(before, after)) {
        const int step = i == 0 ? 1 : i + 1 == chain.count ? -1 : 0, next = static_cast<int>(some.pairs.size());
        if (step == 0 || chain.count < 2) continue;
        some.onAxis.push_back(axisPoint(all, at, step, chain.count));
        // Ids in `some`: those that follow, or those that are there.
        some.onAxis.back().pairs = step > 0 ? std::array<int, 2>{next, next + 1} : std::array<int, 2>{next - 1, next - 2};
        if (chain.count < 3) some.onAxis.back().pairs[1] = some.onAxis.back().pairs[0];
        continue;
      }
      some.pairs.push_back(all.pairs[at]);
      some.pairs.back().id = static_cast<int>(some.pairs.size()) - 1;
      if (!all.gapDoubts.empty()) some.gapDoubts.push_back(all.gapDoubts[at]);
      ++rest.count;
    }
    if (rest.count > 0) some.chains.push_back(rest);
  }
  return some;
}

PairedLine pairsOf(const Mesh& mesh, const ContactLine& line, Problems& problems, std::vector<std::string>& notes) {
  using Coupling = ContactLine::Coupling;
  if (line.obstacle) return obstacleLine(mesh, line, problems, notes);
  if (line.coupling == Coupling::Mortar) return mortarLine(mesh, line, problems, notes);
  const bool must = line.coupling == Coupling::MatchingNodes;
  if (auto matched = matchingLine(mesh, line, must ? &problems : nullptr)) return *std::move(matched);
  if (must) return {};
  PairedLine mortar = mortarLine(mesh, line, problems, notes);
  if (!mortar.pairs.empty())
    notes.push_back("contact '" + line.name + "': the nodes of its sides do not match; mortar, carried by '" +
                    (mesh.bodyOfNode[mortar.pairs.front().node()] == line.bodyA ? line.groupA : line.groupB) + "'");
  return mortar;
}

}  // namespace

PairedLine pairLine(const Mesh& mesh, const ContactLine& line, Problems& problems, std::vector<std::string>& notes) {
  PairedLine all = pairsOf(mesh, line, problems, notes);
  return mesh.axisymmetric ? withoutWeightless(all) : all;
}

}  // namespace suture
