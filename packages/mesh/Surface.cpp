#include <suture/algebra/DisjointSets.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/SideGeometry.hpp>
#include <suture/mesh/Surface.hpp>

#include <algorithm>
#include <tuple>

namespace suture {

namespace {

void sortUnique(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

}  // namespace

Surface::Surface(const CellBlock& block, const std::vector<Side>& sides) : dimension_(block.dimension) {
  for (const Side& side : sides) {
    sides_.push_back(block.nodesOf(side));
    std::vector<Point> points;
    for (const int node : sides_.back()) points.push_back(block.point(node));
    addSide(points, block.axisymmetric, sides_.back());
    for (const int node : sides_.back()) nodes_.at(node).drawn = block.drawnPoint(node);
  }
  findNeighbours();
}

Surface::Surface(int dimension, const std::vector<Point>& points, const std::vector<std::vector<int>>& sides)
    : dimension_(dimension), sides_(sides) {
  for (const std::vector<int>& side : sides_) {
    std::vector<Point> own;
    for (const int node : side) own.push_back(points[node]);
    addSide(own, false, side);
  }
  findNeighbours();
}

void Surface::renumber(const std::map<int, int>& to) {
  const auto change = [&](std::vector<int>& numbers) {
    for (int& node : numbers) node = to.at(node);
  };
  for (std::vector<int>& side : sides_) change(side);
  change(branchings_);
  std::map<int, Node> nodes;
  for (auto& [node, data] : nodes_) {
    change(data.beside);
    nodes.emplace(to.at(node), std::move(data));
  }
  nodes_ = std::move(nodes);
}

Point Surface::normal(int node) const { return unit(at(node).weightedNormal); }

void Surface::addSide(const std::vector<Point>& points, bool axisymmetric, const std::vector<int>& nodes) {
  const int count = static_cast<int>(nodes.size());
  const std::vector<NodeNormal> normals = nodeNormals(points, dimension_);
  std::vector<Node*> own;
  std::vector<double> sizes;
  for (int i = 0; i < count; ++i) {
    own.push_back(&nodes_[nodes[i]]);
    Node& node = *own.back();
    node.position = node.drawn = points[i];
    for (int k = 0; k < 3; ++k) node.weightedNormal[k] += normals[i].weight * normals[i].density[k];
    node.sideNormals.push_back(unit(normals[i].density));
    sizes.push_back(node.tributary);
  }
  addTributarySizes(points, dimension_, axisymmetric, sizes);
  for (int i = 0; i < count; ++i) own[i]->tributary = sizes[i];
  for (const auto& [from, to] : sideSteps(count, dimension_)) {
    const double length = norm(minus(points[to], points[from]));
    for (const auto& [one, other] : {std::make_pair(from, to), std::make_pair(to, from)}) {
      own[one]->spacing = std::min(own[one]->spacing, length);
      own[one]->beside.push_back(nodes[other]);
    }
  }
}

void Surface::findNeighbours() {
  for (auto& entry : nodes_) sortUnique(entry.second.beside);
  // Facets by their vertices, the lower one first; in 2D there is one vertex.
  struct Entry {
    int low, high;
    bool forwards;  // 2D: begins a side; 3D: runs from the lower to the higher vertex
    Facet facet;
    bool operator<(const Entry& other) const {
      return std::tie(low, high, facet.side, facet.facet) < std::tie(other.low, other.high, other.facet.side, other.facet.facet);
    }
  };
  std::vector<Entry> entries;
  for (int side = 0; side < sides(); ++side) {
    const std::vector<int>& nodes = sides_[side];
    const int vertices = sideVertices(static_cast<int>(nodes.size()), dimension_);
    neighbours_.emplace_back(vertices);
    for (int k = 0; k < vertices; ++k) {
      const int from = nodes[k], to = dimension_ == 2 ? from : nodes[(k + 1) % vertices];
      entries.push_back({std::min(from, to), std::max(from, to), dimension_ == 2 ? k == 0 : from < to, {side, k}});
    }
  }
  std::sort(entries.begin(), entries.end());
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    const Entry& first = entries[begin];
    while (end < entries.size() && entries[end].low == first.low && entries[end].high == first.high) ++end;
    if (end - begin == 1) continue;
    const Entry& second = entries[begin + 1];
    if (end - begin > 2 || first.forwards == second.forwards) {
      branchings_.insert(branchings_.end(), {first.low, first.high});
      continue;
    }
    neighbours_[first.facet.side][first.facet.facet] = second.facet;
    neighbours_[second.facet.side][second.facet.facet] = first.facet;
  }
  sortUnique(branchings_);
}

std::vector<int> Surface::parts() const {
  DisjointSets sets(sides());
  for (int side = 0; side < sides(); ++side)
    for (const Facet& neighbour : neighbours_[side])
      if (neighbour.side >= 0) sets.join(side, neighbour.side);
  std::map<int, int> lowestNode;  // lowest node of the part whose lowest side this is
  for (int side = 0; side < sides(); ++side) {
    const int lowest = *std::min_element(sides_[side].begin(), sides_[side].end());
    const auto [at, isNew] = lowestNode.emplace(sets.lowest(side), lowest);
    if (!isNew) at->second = std::min(at->second, lowest);
  }
  std::vector<std::pair<int, int>> order;  // lowest node, lowest side
  for (const auto& [side, node] : lowestNode) order.push_back({node, side});
  std::sort(order.begin(), order.end());
  std::map<int, int> numberOf;
  for (std::size_t part = 0; part < order.size(); ++part) numberOf[order[part].second] = static_cast<int>(part);
  std::vector<int> part(sides_.size());
  for (int side = 0; side < sides(); ++side) part[side] = numberOf.at(sets.lowest(side));
  return part;
}

std::vector<int> Surface::nodesNear(int node) const {
  std::vector<int> near{node};
  for (const int first : at(node).beside) {
    near.push_back(first);
    for (const int second : at(first).beside) near.push_back(second);
  }
  sortUnique(near);
  return near;
}

}  // namespace suture
