#include <algorithm>
#include <cmath>
#include <numeric>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Point.hpp>
#include <suture/partition/cut/BisectionInSpace.hpp>

namespace suture {
namespace {

constexpr double kWindow = 0.1;      // fraction of the elements by which a plane may miss the wanted share, to lie between two layers
constexpr double kParallel = 0.99;   // cosine of the angle between directions that count as equal
constexpr double kPreferred = 1.05;  // a plane may cut this many times the sides of the other bisection: its parts have fewer neighbours

struct Halves {
  std::vector<char> second;
  int sides = 0;  // number of sides cut
};

int sidesCut(const ElementGraph& graph, const std::vector<char>& second) {
  int sides = 0;
  for (int e = 0; e < graph.elements(); ++e)
    for (const int other : graph.of(e)) sides += other < e && second[other] != second[e];
  return sides;
}

bool areConnected(const ElementGraph& graph, const std::vector<char>& second) {
  return components(graph, {second.begin(), second.end()}).count() == 2;
}

std::vector<Point> directions(const ElementGraph& graph) {
  std::vector<Point> found;
  const auto add = [&](const Point& direction) {
    const double length = norm(direction);
    if (length == 0.0) return;
    for (const Point& known : found)
      if (std::abs(suture::dot(known, direction)) > kParallel * length) return;
    found.push_back(scaled(1.0 / length, direction));
  };
  Point mean{0, 0, 0};
  for (const Point& centre : graph.centres) mean = plus(mean, scaled(1.0 / graph.elements(), centre));
  const auto distance = [&](int e) { return norm(minus(graph.centres[e], mean)); };
  int middle = 0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  for (int e = 0; e < graph.elements(); ++e) {
    const Point arm = minus(graph.centres[e], mean);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) inertia(i, j) += arm[i] * arm[j];
    if (distance(e) < distance(middle)) middle = e;
  }
  constexpr std::size_t sidesOfHexahedra = 6;
  if (graph.of(middle).size() == sidesOfHexahedra)
    for (const int other : graph.of(middle)) add(minus(graph.centres[other], graph.centres[middle]));
  add({1, 0, 0}), add({0, 1, 0}), add({0, 0, 1});
  const Matrix axes = symmetricEigenpairs(inertia).vectors;
  for (int k = 0; k < 3; ++k) add({axes(0, k), axes(1, k), axes(2, k)});
  return found;
}

/// Plane normal to a direction, near the wanted share, that cuts the fewest sides; at a tie the one nearest to the share.
Halves planeAcross(const ElementGraph& graph, const Point& direction, double share) {
  const int n = graph.elements();
  std::vector<double> height(n);
  for (int e = 0; e < n; ++e) height[e] = suture::dot(graph.centres[e], direction);
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  const auto below = [&](int a, int b) { return height[a] != height[b] ? height[a] < height[b] : a < b; };
  const int wanted = std::clamp(static_cast<int>(std::lround(share * n)), 1, n - 1);
  const int window = static_cast<int>(kWindow * n);
  const int from = std::max(1, wanted - window), to = std::min(n - 1, wanted + window);
  std::nth_element(order.begin(), order.begin() + from, order.end(), below);
  std::nth_element(order.begin() + from, order.begin() + to, order.end(), below);
  std::sort(order.begin() + from, order.begin() + to, below);
  Halves halves;
  halves.second.assign(n, 1);
  for (int k = 0; k < from; ++k) halves.second[order[k]] = 0;
  int sides = sidesCut(graph, halves.second), best = from;
  halves.sides = sides;
  for (int k = from; k < to; ++k) {
    halves.second[order[k]] = 0;
    for (const int other : graph.of(order[k])) sides += halves.second[other] ? 1 : -1;
    if (sides > halves.sides || (sides == halves.sides && std::abs(k + 1 - wanted) >= std::abs(best - wanted))) continue;
    halves.sides = sides;
    best = k + 1;
  }
  for (int k = best; k < to; ++k) halves.second[order[k]] = 1;
  return halves;
}

Halves halve(const ElementGraph& graph, double share, const Bisection& bisection) {
  Halves best;
  best.second = bisection(graph, share);
  best.sides = sidesCut(graph, best.second);
  const double most = kPreferred * best.sides;
  bool isPlane = false;
  for (const Point& direction : directions(graph)) {
    Halves plane = planeAcross(graph, direction, share);
    if (plane.sides > most || (isPlane && plane.sides >= best.sides) || !areConnected(graph, plane.second)) continue;
    best = std::move(plane);
    isPlane = true;
  }
  return best;
}

void divide(const ElementGraph& graph, const std::vector<int>& elements, int first, int parts, const Bisection& bisection,
            std::vector<int>& partOf) {
  if (parts == 1 || graph.elements() < 2) {
    for (const int e : elements) partOf[e] = first;
    return;
  }
  const int before = parts / 2;
  const Halves halves = halve(graph, static_cast<double>(before) / parts, bisection);
  const std::vector<ElementGraph> graphs = subgraphs(graph, {halves.second.begin(), halves.second.end()}, 2);
  std::vector<int> own[2];
  for (int e = 0; e < graph.elements(); ++e) own[halves.second[e] ? 1 : 0].push_back(elements[e]);
  divide(graphs[0], own[0], first, before, bisection, partOf);
  divide(graphs[1], own[1], first + before, parts - before, bisection, partOf);
}

}  // namespace

std::vector<int> bisectInSpace(const ElementGraph& graph, int parts, const Bisection& bisection) {
  std::vector<int> partOf(graph.elements(), 0), all(graph.elements());
  std::iota(all.begin(), all.end(), 0);
  divide(graph, all, 0, parts, bisection, partOf);
  return partOf;
}

}  // namespace suture
