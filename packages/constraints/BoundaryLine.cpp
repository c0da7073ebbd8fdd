#include <suture/constraints/BoundaryLine.hpp>
#include <suture/mesh/SideShape.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace suture {

Point turned(const Point& a) { return {-a[1], a[0], 0}; }

BoundaryLine::BoundaryLine(const CellBlock& block, const std::vector<Side>& sides) {
  for (const Side& side : sides) addSide(block, block.nodesOf(side));
  std::sort(branchings_.begin(), branchings_.end());
  branchings_.erase(std::unique(branchings_.begin(), branchings_.end()), branchings_.end());
  if (branchings_.empty()) makeChains(block);
}

Point BoundaryLine::normal(int node) const { return unit(at(node).weightedNormal); }

// Lengths and normals by the quadrature whose points are the nodes: exact for straight sides, and each node's weight is the integral of its
// hat function. Trapezoidal rule for two nodes, Simpson's for three.
void BoundaryLine::addSide(const CellBlock& block, const std::vector<int>& nodes) {
  const Point a = block.point(nodes[0]), b = block.point(nodes[1]);
  const bool quadratic = nodes.size() == 3;
  std::vector<Point> tangents(nodes.size(), minus(b, a));  // d x / d xi, xi from -1 to 1
  for (Point& t : tangents) t = {t[0] / 2, t[1] / 2, 0};
  std::vector<double> weights(nodes.size(), 1.0);
  if (quadratic) {
    const Point m = block.point(nodes[2]);
    const Point bow{a[0] + b[0] - 2 * m[0], a[1] + b[1] - 2 * m[1], 0};  // second derivative
    for (int k = 0; k < 2; ++k) tangents[0][k] -= bow[k], tangents[1][k] += bow[k];
    weights = {1.0 / 3, 1.0 / 3, 4.0 / 3};
  }
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Node& node = nodes_[nodes[i]];
    const Point outward{tangents[i][1], -tangents[i][0], 0};  // the body is on the left
    for (int k = 0; k < 2; ++k) node.weightedNormal[k] += weights[i] * outward[k];
    if (!block.axisymmetric) node.tributary += weights[i] * norm(outward);
    node.sideNormals.push_back(unit(outward));
  }
  if (block.axisymmetric) addTributaryAreas(block, nodes);
  const std::vector<int> way = quadratic ? std::vector<int>{nodes[0], nodes[2], nodes[1]} : nodes;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const double length = norm(minus(block.point(way[i + 1]), block.point(way[i])));
    for (const int node : {way[i], way[i + 1]}) nodes_[node].spacing = std::min(nodes_[node].spacing, length);
    if (!next_.emplace(way[i], way[i + 1]).second) branchings_.push_back(way[i]);
    if (!previous_.emplace(way[i + 1], way[i]).second) branchings_.push_back(way[i + 1]);
  }
}

// The radius is one factor more than nodes as points can integrate: a node on the axis has an area, too. Exact for straight sides.
void BoundaryLine::addTributaryAreas(const CellBlock& block, const std::vector<int>& nodes) {
  static const LineRule rule = gaussRule(5);
  for (int q = 0; q < rule.points.size(); ++q) {
    const SideShape shape = sideShape(static_cast<int>(nodes.size()), rule.points(q));
    double radius = 0, dx = 0, dy = 0;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Point p = block.point(nodes[i]);
      radius += shape.value[i] * p[0], dx += shape.slope[i] * p[0], dy += shape.slope[i] * p[1];
    }
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nodes_[nodes[i]].tributary += rule.weights(q) * circumference(radius) * std::hypot(dx, dy) * shape.value[i];
  }
}

void BoundaryLine::makeChains(const CellBlock& block) {
  std::set<int> seen;
  for (const auto& entry : nodes_) {
    const int lowest = entry.first;
    if (seen.count(lowest)) continue;
    int first = lowest;
    for (auto at = previous_.find(first); at != previous_.end() && at->second != lowest; at = previous_.find(first)) first = at->second;
    Chain chain;
    chain.closed = previous_.count(first) > 0;  // only a ring leads back to where the walk began
    if (chain.closed) first = lowest;
    double arc = 0;
    for (int node = first;;) {
      seen.insert(node);
      chain.nodes.push_back(node);
      chain.arc.push_back(arc);
      const auto next = next_.find(node);
      if (next == next_.end() || next->second == first) break;
      arc += norm(minus(block.point(next->second), block.point(node)));
      node = next->second;
    }
    chains_.push_back(std::move(chain));
  }
}

}  // namespace suture
