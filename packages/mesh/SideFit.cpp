#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/SideFit.hpp>

#include <algorithm>

namespace suture {

namespace {

using Vertices = std::array<int, kMostSideVertices>;  // ascending; the last of a triangle is kNone

constexpr int kNone = 2147483647;

struct VertexSide {
  Vertices vertices;
  Side side;
  bool isTriangle() const { return vertices[3] == kNone; }
  bool operator<(const VertexSide& other) const { return vertices < other.vertices; }
};

bool mayNotFit(const Mesh& mesh) {
  const auto isOther = [&](Cell cell) { return cell != mesh.cells[0]; };
  return mesh.dimension == 3 && mesh.elements() > 0 &&
         (mesh.cells[0] == Cell::Wedge6 || mesh.cells[0] == Cell::Pyramid5 || std::any_of(mesh.cells.begin(), mesh.cells.end(), isOther));
}

/// All sides, ordered so that sides with the same vertices are adjacent.
std::vector<VertexSide> sidesByVertices(const Mesh& mesh) {
  std::vector<VertexSide> all;
  for (int e = 0; e < mesh.elements(); ++e) {
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const Span<const int> nodes = mesh.nodesOf(e);
    for (int s = 0; s < static_cast<int>(cell.sideNodes.size()); ++s) {
      VertexSide entry{{kNone, kNone, kNone, kNone}, {e, s}};
      int count = 0;
      for (const int local : cell.sideNodes[s])
        if (local < cell.vertices) entry.vertices[count++] = nodes[local];
      std::sort(entry.vertices.begin(), entry.vertices.end());
      all.push_back(entry);
    }
  }
  std::sort(all.begin(), all.end());
  return all;
}

bool haveTheSameNodes(const Mesh& mesh, const Side& a, const Side& b) {
  const std::vector<int> one = mesh.nodesOf(a), other = mesh.nodesOf(b);
  return one.size() == other.size() && std::is_permutation(one.begin(), one.end(), other.begin());
}

std::string centreText(const Mesh& mesh, const VertexSide& side) {
  const int count = side.isTriangle() ? 3 : 4;
  Point centre{0, 0, 0};
  for (int k = 0; k < count; ++k) centre = plus(centre, scaled(1.0 / count, mesh.point(side.vertices[k])));
  return placeText(centre, mesh.dimension);
}

/// "element 7 (Wedge6)"
std::string elementText(const Mesh& mesh, const Side& side) {
  return "element " + std::to_string(side.element) + " (" + cellInfo(mesh.cells[side.element]).name + ")";
}

/// Two sides of different elements at the same place.
using Pair = std::pair<VertexSide, VertexSide>;

void report(const Mesh& mesh, const std::vector<Pair>& pairs, const std::string& what, const std::string& more, const std::string& expected,
            Problems& problems) {
  if (pairs.empty()) return;
  const auto& [one, other] = pairs.front();
  problems.add("Mesh", mesh.source + ": elements that do not fit: " + countAt(pairs.size(), what, centreText(mesh, one), more) +
                           ", there " + elementText(mesh, one.side) + " and " + elementText(mesh, other.side) + "; expected " + expected);
}

/// Triangles whose vertices are among those of a quadrilateral. Both lists contain only sides on the boundary of the mesh.
std::vector<Pair> trianglesOn(const std::vector<VertexSide>& quadrilaterals, const std::vector<VertexSide>& triangles) {
  std::vector<std::pair<Vertices, std::size_t>> corners;  // three vertices of a quadrilateral
  for (std::size_t q = 0; q < quadrilaterals.size(); ++q)
    for (int left = 0; left < 4; ++left) {
      Vertices three = quadrilaterals[q].vertices;
      std::rotate(three.begin() + left, three.begin() + left + 1, three.end());
      three[3] = kNone;
      corners.emplace_back(three, q);
    }
  std::sort(corners.begin(), corners.end());
  std::vector<Pair> pairs;
  for (const VertexSide& triangle : triangles) {
    const auto at = std::lower_bound(corners.begin(), corners.end(), std::make_pair(triangle.vertices, std::size_t(0)));
    if (at != corners.end() && at->first == triangle.vertices) pairs.emplace_back(triangle, quadrilaterals[at->second]);
  }
  return pairs;
}

}  // namespace

void checkSidesFit(const Mesh& mesh, Problems& problems) {
  if (!mayNotFit(mesh)) return;
  const std::vector<VertexSide> all = sidesByVertices(mesh);
  std::vector<Pair> unequal;
  std::vector<VertexSide> triangles, quadrilaterals;  // on the boundary
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    while (end < all.size() && all[end].vertices == all[first].vertices) ++end;
    if (end - first == 1) (all[first].isTriangle() ? triangles : quadrilaterals).push_back(all[first]);
    for (std::size_t k = first + 1; k < end; ++k)
      if (!haveTheSameNodes(mesh, all[first].side, all[k].side)) unequal.emplace_back(all[first], all[k]);
  }
  report(mesh, unequal, "common side", " with nodes that only one of two elements has", "the same order of both", problems);
  report(mesh, trianglesOn(quadrilaterals, triangles), "triangle", " on a quadrilateral",
         "a pyramid between them, or sides with the same vertices", problems);
}

}  // namespace suture
