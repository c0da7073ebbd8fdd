#include <suture/adapt/InitialMarks.hpp>
#include <suture/adapt/MarkedSimplex.hpp>
#include <suture/adapt/SimplexSides.hpp>
#include <suture/adapt/TwinEdges.hpp>
#include <suture/base/Point.hpp>

#include <cmath>
#include <map>
#include <tuple>

namespace suture {

namespace {

/// Rank of an edge: of two edges of an element the one with the higher rank is bisected first.
struct EdgeRank {
  long long length = 0;  ///< logarithm of the length in steps of 1e-9
  Point middle{0, 0, 0};

  bool operator<(const EdgeRank& other) const { return std::tie(length, middle) < std::tie(other.length, other.middle); }
};

class Ranks {
 public:
  Ranks(const Mesh& mesh, const std::vector<NodePairs>& contacts) : mesh_(mesh) {
    if (mesh.dimension == 2) return;  // the closure of triangles ends with any marks on the two sides of a contact
    const TwinEdges twins(mesh, contacts);
    for (bool changes = true; changes;) {  // an edge may have opposites in several contacts
      changes = false;
      twins.forEachEdge([&](int, int p, int q, int a, int b) {
        const EdgeRank other = of(a, b);
        if (!(of(p, q) < other)) return;
        contact_[sideKey(p, q)] = other;
        changes = true;
      });
    }
  }

  EdgeRank of(int p, int q) const {
    if (!contact_.empty())
      if (const auto found = contact_.find(sideKey(p, q)); found != contact_.end()) return found->second;
    const Point a = mesh_.point(p), b = mesh_.point(q), d = minus(b, a);
    return {std::llround(0.5e9 * std::log(dot(d, d))), scaled(0.5, plus(a, b))};
  }

 private:
  const Mesh& mesh_;
  std::map<SideKey, EdgeRank> contact_;  ///< edges with an opposite edge of higher rank
};

using Edge = std::array<int, 2>;

/// The highest of the edges between some local vertices.
Edge highestEdge(const Ranks& ranks, const int* nodes, const std::vector<int>& vertices) {
  Edge best{-1, -1};
  EdgeRank highest;
  for (std::size_t i = 0; i < vertices.size(); ++i)
    for (std::size_t j = i + 1; j < vertices.size(); ++j) {
      const EdgeRank rank = ranks.of(nodes[vertices[i]], nodes[vertices[j]]);
      if (best[0] >= 0 && rank < highest) continue;
      best = {vertices[i], vertices[j]};
      highest = rank;
    }
  return best;
}

/// Local vertices in their new order.
using Order = std::array<int, 4>;

Order triangleOrder(const Ranks& ranks, const int* nodes) {
  const Edge edge = highestEdge(ranks, nodes, {0, 1, 2});
  const int opposite = 3 - edge[0] - edge[1];
  return {(opposite + 1) % 3, (opposite + 2) % 3, opposite, 3};
}

Order tetrahedronOrder(const Ranks& ranks, const int* nodes, unsigned char& marks) {
  const std::array<Edge, 4> faces{highestEdge(ranks, nodes, {1, 2, 3}), highestEdge(ranks, nodes, {0, 2, 3}),
                                  highestEdge(ranks, nodes, {0, 1, 3}), highestEdge(ranks, nodes, {0, 1, 2})};
  const MarkedSimplex<3> result = arranged({{0, 1, 2, 3}, {}, 0}, highestEdge(ranks, nodes, {0, 1, 2, 3}), faces, false);
  marks = result.marks;
  return result.vertices;
}

/// Gives the nodes of an element a new order. \param order  old local vertex of each new one
void reorder(Mesh& mesh, int element, const Order& order) {
  const CellInfo& cell = cellInfo(mesh.cells[element]);
  int* nodes = mesh.connectivity.data() + mesh.offsets[element];
  const std::vector<int> old(nodes, nodes + cell.nodes);
  for (int k = 0; k < cell.vertices; ++k) nodes[k] = old[order[k]];
  if (cell.order == 1) return;
  for (std::size_t k = 0; k < cell.edges.size(); ++k) {
    const int a = order[cell.edges[k][0]], b = order[cell.edges[k][1]];
    for (std::size_t j = 0; j < cell.edges.size(); ++j)
      if (cell.edges[j] == Edge{a, b} || cell.edges[j] == Edge{b, a}) nodes[cell.vertices + k] = old[cell.vertices + j];
  }
}

}  // namespace

std::vector<unsigned char> markLongestEdges(Mesh& mesh, const std::vector<NodePairs>& twins) {
  const Ranks ranks(mesh, twins);
  const int dimension = mesh.dimension;
  std::vector<unsigned char> marks(dimension == 3 ? mesh.elements() : 0, 0);
  std::vector<std::array<signed char, 4>> placeOfVertex(mesh.elements());
  for (int e = 0; e < mesh.elements(); ++e) {
    const int* nodes = mesh.nodesOf(e).begin();
    const Order order = dimension == 2 ? triangleOrder(ranks, nodes) : tetrahedronOrder(ranks, nodes, marks[e]);
    for (int k = 0; k < 4; ++k) placeOfVertex[e][order[k]] = static_cast<signed char>(k);
    reorder(mesh, e, order);
  }
  const auto vertexOpposite = vertexOppositeSide(dimension), sideOpposite = sideOppositeVertex(dimension);
  for (auto& [name, sides] : mesh.sideGroups)
    for (Side& side : sides) side.side = sideOpposite[placeOfVertex[side.element][vertexOpposite[side.side]]];
  return marks;
}

}  // namespace suture
