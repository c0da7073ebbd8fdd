#include <suture/adapt/EdgeNodes.hpp>
#include <suture/adapt/PassOnGroups.hpp>
#include <suture/adapt/SimplexSides.hpp>
#include <suture/adapt/SimplicialMesh.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/SplitCell.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>

namespace suture {

namespace {

constexpr double kSound = 0.02;  // volume of a tetrahedron over that of its cell with which an order of the vertices is accepted at once
constexpr double kEqualPlaces = 1e-9;  // coordinates of vertices that count as equal, relative
constexpr double kFlat = 1e-6;         // volume of a tetrahedron over that of its cell below which it counts as inverted

/// Order of all vertices, by coordinates up to round-off. Opposite vertices of a contact have the coordinates of one of them.
class VertexOrder {
 public:
  VertexOrder(const Mesh& mesh, const std::vector<NodePairs>& contacts) : mesh_(mesh) {
    for (const NodePairs& pairs : contacts)
      for (const auto& [a, b] : pairs) {
        const int first = std::min(rootOf(a), rootOf(b)), second = std::max(rootOf(a), rootOf(b));
        if (first != second) root_[second] = first;
      }
    double extent = 0;
    for (const double x : mesh.coordinates) extent = std::max(extent, std::abs(x));
    step_ = extent > 0 ? kEqualPlaces * extent : 1;
  }

  /// Reverses the order along some coordinates. \param variant  0..7: one bit per coordinate
  void choose(int variant) { variant_ = variant; }

  bool isLower(int a, int b) const {
    const Point p = mesh_.point(rootOf(a)), q = mesh_.point(rootOf(b));
    for (int k = 0; k < mesh_.dimension; ++k) {
      const long long x = std::llround(p[k] / step_), y = std::llround(q[k] / step_);
      if (x != y) return (x < y) == ((variant_ >> k & 1) == 0);
    }
    return a < b;
  }

 private:
  int rootOf(int node) const {
    for (auto found = root_.find(node); found != root_.end(); found = root_.find(node)) node = found->second;
    return node;
  }

  const Mesh& mesh_;
  std::unordered_map<int, int> root_;
  double step_ = 1;
  int variant_ = 0;
};

class Cutter {
 public:
  Cutter(const Mesh& mesh, const VertexOrder& order) : mesh_(mesh), order_(order) {}

  std::vector<CellSimplex> cut(int e) const {
    return splitCell(mesh_, e, [this](int a, int b) { return order_.isLower(a, b); });
  }

  /// Smallest volume of the element's tetrahedra, over the element's volume.
  double quality(int e) const {
    const Span<const int> nodes = mesh_.nodesOf(e);
    const double whole = signedSize(mesh_, e);
    double least = std::numeric_limits<double>::infinity();
    for (const CellSimplex& part : cut(e)) {
      const Point a = mesh_.point(nodes[part[0]]), u = minus(mesh_.point(nodes[part[1]]), a), v = minus(mesh_.point(nodes[part[2]]), a);
      least = std::min(least, dot(cross(u, v), minus(mesh_.point(nodes[part[3]]), a)) / 6);
    }
    return least / whole;
  }

 private:
  const Mesh& mesh_;
  const VertexOrder& order_;
};

/// Chooses an order of the vertices with which no tetrahedron is inverted. \throws InputError  if there is none
void chooseOrder(const Mesh& mesh, VertexOrder& order) {
  if (mesh.dimension == 2) return;
  double best = -std::numeric_limits<double>::infinity();
  int bestVariant = 0;
  for (int variant = 0; variant < 8; ++variant) {
    order.choose(variant);
    const Cutter cutter(mesh, order);
    double least = std::numeric_limits<double>::infinity();
    for (int e = 0; e < mesh.elements() && least > best; ++e)
      if (!isSimplex(mesh.cells[e])) least = std::min(least, cutter.quality(e));
    if (least > best) best = least, bestVariant = variant;
    if (best > kSound) break;
  }
  order.choose(bestVariant);
  if (best > kFlat) return;
  const Cutter cutter(mesh, order);
  std::vector<int> bad;
  for (int e = 0; e < mesh.elements(); ++e)
    if (!isSimplex(mesh.cells[e]) && !(cutter.quality(e) > kFlat)) bad.push_back(e);
  throw InputError("Mesh", mesh.source + ": " + countAt(bad.size(), "element", placeText(centreOf(mesh, bad[0]), mesh.dimension)) +
                               " too warped to be cut into tetrahedra of positive volume; expected sides closer to planes");
}

template <int D>
class Builder {
 public:
  Builder(const Mesh& mesh, int order, const VertexOrder& vertexOrder)
      : old_(mesh), order_(order), cutter_(mesh, vertexOrder), middles_(mesh.nodes()) {}

  SimplicialMesh build(Boundary boundary) {
    mesh().dimension = D;
    mesh().source = old_.source;
    mesh().notes = old_.notes;
    mesh().axisymmetric = old_.axisymmetric;
    mesh().bodies = old_.bodies;
    mesh().coordinates = old_.coordinates;
    mesh().bodyOfNode = old_.bodyOfNode;
    for (int e = 0; e < old_.elements(); ++e) {
      first_.push_back(mesh().elements());
      for (const CellSimplex& part : cutter_.cut(e)) append(e, part);
    }
    first_.push_back(mesh().elements());
    passOnGroups();
    if (boundary == Boundary::Round) placeMiddles();
    removeUnusedNodes();
    return std::move(result_);
  }

 private:
  Mesh& mesh() { return result_.mesh; }

  void append(int e, const CellSimplex& part) {
    const Cell linear = D == 2 ? Cell::Triangle3 : Cell::Tetrahedron4, quadratic = D == 2 ? Cell::Triangle6 : Cell::Tetrahedron10;
    const Span<const int> nodes = old_.nodesOf(e);
    mesh().cells.push_back(order_ == 1 ? linear : quadratic);
    for (int k = 0; k <= D; ++k) mesh().connectivity.push_back(nodes[part[k]]);
    if (order_ == 2)
      for (const auto& [i, j] : cellInfo(quadratic).edges) mesh().connectivity.push_back(middle(e, part[i], part[j]));
    mesh().offsets.push_back(static_cast<int>(mesh().connectivity.size()));
    result_.parent.push_back(e);
    if (!old_.bodyOfElement.empty()) mesh().bodyOfElement.push_back(old_.bodyOfElement[e]);
    if (!old_.regions.empty()) mesh().regions.push_back(old_.regions[e]);
    sides_.push_back(sidesOf(cellInfo(old_.cells[e]), part));
  }

  int middle(int e, int i, int j) {
    const Span<const int> nodes = old_.nodesOf(e);
    if (const int local = middleOf(old_.cells[e], i, j); local >= 0) return nodes[local];
    if (const int known = middles_.at(nodes[i], nodes[j]); known >= 0) return known;
    const int node = mesh().nodes();
    middles_.add(nodes[i], nodes[j], node);
    const Point a = referencePoint(old_.cells[e], i), b = referencePoint(old_.cells[e], j);
    NodeOrigin origin{e, {}};
    for (int k = 0; k < 3; ++k) origin.at[k] = static_cast<float>((a[k] + b[k]) / 2);
    const bool curved = cellInfo(old_.cells[e]).order == 2;
    const Point at = curved ? pointAt(old_, origin) : scaled(0.5, plus(old_.point(nodes[i]), old_.point(nodes[j])));
    mesh().coordinates.insert(mesh().coordinates.end(), at.begin(), at.begin() + D);
    if (!old_.bodyOfNode.empty()) mesh().bodyOfNode.push_back(old_.bodyOfNode[nodes[i]]);
    result_.origins.push_back(origin);
    return node;
  }

  /// Side of the cell on which the side opposite to each vertex of a simplex lies, or -1.
  static std::array<signed char, D + 1> sidesOf(const CellInfo& cell, const CellSimplex& part) {
    std::array<signed char, D + 1> found;
    found.fill(-1);
    for (int k = 0; k <= D; ++k)
      for (std::size_t s = 0; s < cell.sideNodes.size(); ++s) {
        int count = 0;
        for (int i = 0; i <= D; ++i)
          if (i != k && std::find(cell.sideNodes[s].begin(), cell.sideNodes[s].end(), part[i]) != cell.sideNodes[s].end()) ++count;
        if (count == D) found[k] = static_cast<signed char>(s);
      }
    return found;
  }

  /// Sides of the simplices that make up a side of the given mesh.
  void addParts(const Side& side, std::vector<Side>& to) const {
    const auto opposite = sideOppositeVertex(D);
    for (int part = first_[side.element]; part < first_[side.element + 1]; ++part)
      for (int k = 0; k <= D; ++k)
        if (sides_[part][k] == side.side) to.push_back({part, opposite[k]});
  }

  void passOnGroups() {
    passOnElementGroups(old_, first_, mesh());
    for (const auto& [name, sides] : old_.sideGroups) {
      std::vector<Side>& own = mesh().sideGroups[name];
      for (const Side& side : sides) addParts(side, own);
    }
  }

  void placeMiddles() {
    if (result_.origins.empty()) return;
    RoundSides round = findRoundSides(old_);
    std::vector<std::pair<Side, int>> parts;
    for (const auto& [side, shape] : round.sides) {
      std::vector<Side> own;
      addParts(side, own);
      for (const Side& part : own) parts.emplace_back(part, shape);
    }
    round.sides = std::move(parts);
    placeOnShapes(mesh(), round, {}, old_.nodes());
  }

  /// Nodes of second order that no simplex of first order has.
  void removeUnusedNodes() {
    std::vector<int> number(static_cast<std::size_t>(mesh().nodes()), -1);
    for (const int node : mesh().connectivity) number[node] = 0;
    int next = 0;
    for (int node = 0; node < mesh().nodes(); ++node) {
      if (number[node] < 0) continue;
      number[node] = next;
      result_.nodeOfWhole.push_back(node < old_.nodes() ? node : -1);
      for (int k = 0; k < D; ++k) mesh().coordinates[std::size_t(next) * D + k] = mesh().coordinates[std::size_t(node) * D + k];
      if (!mesh().bodyOfNode.empty()) mesh().bodyOfNode[next] = mesh().bodyOfNode[node];
      ++next;
    }
    mesh().coordinates.resize(static_cast<std::size_t>(next) * D);
    if (!mesh().bodyOfNode.empty()) mesh().bodyOfNode.resize(static_cast<std::size_t>(next));
    for (int& node : mesh().connectivity) node = number[node];
  }

  const Mesh& old_;
  int order_;
  Cutter cutter_;
  EdgeNodes middles_;                                  ///< new nodes
  std::vector<int> first_;                             ///< first simplex of each element
  std::vector<std::array<signed char, D + 1>> sides_;  ///< sidesOf() each simplex
  SimplicialMesh result_;
};

}  // namespace

SimplicialMesh simplicialMesh(const Mesh& mesh, int order, const std::vector<NodePairs>& twins, Boundary boundary) {
  if (!mesh.coatings.empty()) throw InternalError("simplices of a mesh with coatings");
  if (order == 0) order = std::any_of(mesh.cells.begin(), mesh.cells.end(), [](Cell cell) { return cellInfo(cell).order == 2; }) ? 2 : 1;
  if (order != 1 && order != 2) throw InternalError("simplices of order " + std::to_string(order));
  VertexOrder vertexOrder(mesh, twins);
  chooseOrder(mesh, vertexOrder);
  if (mesh.dimension == 2) return Builder<2>(mesh, order, vertexOrder).build(boundary);
  return Builder<3>(mesh, order, vertexOrder).build(boundary);
}

void straightenEdges(Mesh& mesh) {
  for (int e = 0; e < mesh.elements(); ++e) {
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const Span<const int> nodes = mesh.nodesOf(e);
    for (std::size_t k = 0; cell.order == 2 && k < cell.edges.size(); ++k) {
      const Point middle = scaled(0.5, plus(mesh.point(nodes[cell.edges[k][0]]), mesh.point(nodes[cell.edges[k][1]])));
      for (int d = 0; d < mesh.dimension; ++d)
        mesh.coordinates[static_cast<std::size_t>(nodes[cell.vertices + k]) * mesh.dimension + d] = middle[d];
    }
  }
}

}  // namespace suture
