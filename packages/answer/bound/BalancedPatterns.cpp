#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <suture/algebra/DisjointSets.hpp>
#include <suture/answer/bound/BalancedPatterns.hpp>
#include <suture/base/Point.hpp>
#include <utility>

namespace suture {
namespace {

/// Barycentric coordinates of the projection of `at` into the line or plane of a side.
Vector barycentric(const PressedSides& sides, int side, const Point& at) {
  const int edges = sides.dimension - 1;
  const int* nodes = sides.nodesOf(side);
  const Point& origin = sides.places[std::size_t(nodes[0])];
  const auto column = [&](const Point& p) {
    const Point way = minus(p, origin);
    return Eigen::Vector3d(way[0], way[1], way[2]);
  };
  Matrix ways(3, edges);
  for (int i = 0; i < edges; ++i) ways.col(i) = column(sides.places[std::size_t(nodes[i + 1])]);
  Vector coordinates(edges + 1);
  coordinates.tail(edges) = ways.colPivHouseholderQr().solve(column(at));
  coordinates(0) = 1 - coordinates.tail(edges).sum();
  return coordinates;
}

BalancedPattern patternOf(const std::vector<int>& nodes, const Vector& amplitudes) {
  BalancedPattern pattern;
  pattern.size = static_cast<int>(nodes.size());
  const double largest = amplitudes.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    pattern.nodes[i] = nodes[i];
    pattern.amplitudes[i] = amplitudes(static_cast<int>(i)) / largest;
  }
  return pattern;
}

/// The vertices of `other` continue the affine function of `side`.
void addNeighbours(const PressedSides& sides, int side, int other, std::vector<BalancedPattern>& patterns) {
  const int vertices = sides.vertices();
  std::vector<int> nodes(sides.nodesOf(side), sides.nodesOf(side) + vertices);
  for (int i = 0; i < vertices; ++i) {
    const int vertex = sides.nodesOf(other)[i];
    if (std::find(nodes.begin(), nodes.begin() + vertices, vertex) != nodes.begin() + vertices) continue;
    Vector amplitudes(vertices + 1);
    amplitudes << -barycentric(sides, side, sides.places[std::size_t(vertex)]), 1.0;
    nodes.push_back(vertex);
    patterns.push_back(patternOf(nodes, amplitudes));
    nodes.pop_back();
  }
}

/// Lowest other common vertex of two sides at `vertex`; -1: none.
int secondCommonVertex(const PressedSides& sides, int side, int other, int vertex) {
  int common = -1;
  for (int i = 0; i < sides.vertices(); ++i)
    for (int j = 0; j < sides.vertices(); ++j) {
      const int node = sides.nodesOf(side)[i];
      if (node == sides.nodesOf(other)[j] && node != vertex && (common < 0 || node < common)) common = node;
    }
  return common;
}

/// Connects the sides around a vertex; an edge is connected at the lower of its two vertices.
void connectAround(const PressedSides& sides, int vertex, const std::vector<int>& around, std::vector<BalancedPattern>& patterns) {
  DisjointSets chains(static_cast<int>(around.size()));
  for (std::size_t a = 0; a < around.size(); ++a)
    for (std::size_t b = a + 1; b < around.size(); ++b) {
      const int second = secondCommonVertex(sides, around[a], around[b], vertex);
      if (second < 0) continue;
      chains.join(static_cast<int>(a), static_cast<int>(b));
      if (vertex < second) addNeighbours(sides, around[a], around[b], patterns);
    }
  for (std::size_t a = 1; a < around.size(); ++a)
    if (chains.lowest(static_cast<int>(a)) != chains.lowest(0)) {
      addNeighbours(sides, around[0], around[a], patterns);
      chains.join(0, static_cast<int>(a));
    }
}

}  // namespace

std::vector<BalancedPattern> balancedPatterns(const PressedSides& sides) {
  const int vertices = sides.vertices();
  std::vector<BalancedPattern> patterns;
  std::vector<std::vector<int>> around(sides.places.size());
  std::vector<char> isMiddle(sides.places.size(), 0);
  for (int side = 0; side < sides.sides(); ++side) {
    const int* nodes = sides.nodesOf(side);
    for (int i = 0; i < vertices; ++i) around[std::size_t(nodes[i])].push_back(side);
    for (int edge = 0; edge < sides.sideNodes() - vertices; ++edge) {
      const int middle = nodes[vertices + edge];
      if (std::exchange(isMiddle[std::size_t(middle)], 1)) continue;
      const auto [i, j] = edgeVertices(edge);
      patterns.push_back(patternOf({nodes[i], nodes[j], middle}, Eigen::Vector3d(-0.5, -0.5, 1)));
    }
  }
  for (std::size_t node = 0; node < around.size(); ++node) connectAround(sides, static_cast<int>(node), around[node], patterns);
  return patterns;
}

}  // namespace suture
