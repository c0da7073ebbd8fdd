#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/reader/gmsh/StraightSides.hpp>

#include <algorithm>
#include <set>
#include <vector>

namespace suture {

namespace {

// Smallest accepted determinant over that of the element with straight sides. At zero, stresses are unbounded and the stiffness is
// infinite; at this value the stiffness is about fifty times that of a sound element, which factorisations and preconditioners bear.
constexpr double kLeastDeterminant = 0.02;
constexpr double kStraight = 1e-8;  // distance of a mid-side node from the middle over the length of the edge that is round-off
constexpr int kSteps = 4;           // from the curved to the straight side

/// A mid-side node between its place on the curved side and the middle of the straight edge.
struct MidSide {
  Point curved{0, 0, 0}, straight{0, 0, 0};
  int steps = 0;
};

class Straightening {
 public:
  explicit Straightening(Mesh& mesh) : mesh_(mesh), at_(static_cast<std::size_t>(mesh.nodes()), -1) {
    for (int e = 0; e < mesh.elements(); ++e) {
      if (!isSecondOrderSimplex(e)) continue;
      bool curved = false;
      forEdges(e, [&](int a, int b, int middle) { curved = add(a, b, middle) || curved; });
      if (curved) curved_.push_back(e);
    }
  }

  Straightened run() {
    Straightened result;
    std::set<int> elements;
    // A moved node changes its other elements: all are tested again. Each node moves at most kSteps times.
    for (bool moved = true; moved;) {
      moved = false;
      for (const int e : curved_)
        if (isTangled(e) && step(e)) {
          elements.insert(e);
          moved = true;
        }
    }
    result.elements = static_cast<int>(elements.size());
    for (const MidSide& node : nodes_) {
      const double distance = node.steps * norm(minus(node.straight, node.curved)) / kSteps;
      if (distance <= result.distance) continue;
      result.distance = distance;
      result.place = node.curved;
    }
    return result;
  }

 private:
  bool isSecondOrderSimplex(int e) const { return mesh_.cells[e] == Cell::Tetrahedron10 || mesh_.cells[e] == Cell::Triangle6; }

  /// Calls visit(vertex, vertex, mid-side node) for all edges of an element.
  template <typename Visit>
  void forEdges(int e, const Visit& visit) const {
    const CellInfo& cell = cellInfo(mesh_.cells[e]);
    const Span<const int> nodes = mesh_.nodesOf(e);
    for (std::size_t k = 0; k < cell.edges.size(); ++k)
      visit(nodes[cell.edges[k][0]], nodes[cell.edges[k][1]], nodes[static_cast<std::size_t>(cell.vertices) + k]);
  }

  /// True if the side is curved; keeps its mid-side node.
  bool add(int a, int b, int middle) {
    if (at_[middle] >= 0) return true;
    const Point straight = scaled(0.5, plus(mesh_.point(a), mesh_.point(b))), place = mesh_.point(middle);
    if (norm(minus(place, straight)) <= kStraight * norm(minus(mesh_.point(a), mesh_.point(b)))) return false;
    at_[middle] = static_cast<int>(nodes_.size());
    nodes_.push_back({place, straight, 0});
    return true;
  }

  bool isTangled(int e) const {
    const double straight = signedSize(mesh_, e) * (mesh_.dimension == 3 ? 6 : 2);
    return straight > 0 && !(smallestJacobian(mesh_, e) > kLeastDeterminant * straight);
  }

  /// Moves the mid-side nodes of an element by one step; false if all its sides are straight.
  bool step(int e) {
    bool moved = false;
    forEdges(e, [&](int, int, int middle) {
      if (at_[middle] < 0 || nodes_[at_[middle]].steps == kSteps) return;
      MidSide& node = nodes_[at_[middle]];
      const double part = static_cast<double>(++node.steps) / kSteps;
      const Point place = plus(scaled(1 - part, node.curved), scaled(part, node.straight));
      for (int k = 0; k < mesh_.dimension; ++k) mesh_.coordinates[static_cast<std::size_t>(middle) * mesh_.dimension + k] = place[k];
      moved = true;
    });
    return moved;
  }

  Mesh& mesh_;
  std::vector<int> at_;  // number in nodes_ of each node of the mesh; -1: on a straight side, or a vertex
  std::vector<MidSide> nodes_;
  std::vector<int> curved_;  // elements with a curved side
};

}  // namespace

Straightened straightenTangled(Mesh& mesh) { return Straightening(mesh).run(); }

}  // namespace suture
