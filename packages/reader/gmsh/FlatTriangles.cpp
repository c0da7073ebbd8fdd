#include <suture/mesh/CellBlock.hpp>
#include <suture/reader/gmsh/FlatTriangles.hpp>

#include <cmath>
#include <map>
#include <utility>

namespace suture {

namespace {

// Height over longest edge. Round-off in coordinates (1e-16 of the extent) over the smallest elements that a size plan requests (1e-7 of
// it) is 1e-9; no mesher makes a triangle of a height of 1e-6 on purpose.
constexpr double kFlat = 1e-6;
constexpr int kTriangle3 = 2, kTriangle6 = 9;  // Gmsh's numbers of types

/// The triangles of one surface.
class Swapping {
 public:
  Swapping(GmshMesh& mesh, GmshMesh::Block& block) : mesh_(mesh), block_(block), nodes_(block.type == kTriangle3 ? 3 : 6) {}

  int run() {
    int swapped = 0;
    // A swap may leave a flat triangle where several vertices are on one line: it has another longest edge then.
    for (int last = -1; last != swapped;) {
      last = swapped;
      std::map<SideKey, Flat> flat;
      for (int e = 0; e < count(); ++e)
        if (const int edge = longestOfFlat(e); edge >= 0) flat.emplace(sideKey(vertex(e, edge), vertex(e, edge + 1)), Flat{e, edge});
      for (int e = 0; e < count() && !flat.empty(); ++e)
        for (int edge = 0; edge < 3; ++edge) {
          const auto at = flat.find(sideKey(vertex(e, edge), vertex(e, edge + 1)));
          if (at == flat.end() || at->second.element == e || longestOfFlat(e) >= 0 || partOf(e) != partOf(at->second.element)) continue;
          swap(at->second, {e, edge});
          flat.erase(at);
          ++swapped;
          break;
        }
    }
    return swapped;
  }

 private:
  struct Flat {
    int element, edge;
  };

  int count() const { return static_cast<int>(block_.nodes.size()) / nodes_; }
  int partOf(int e) const { return block_.parts.empty() ? 0 : block_.parts[e]; }
  int& node(int e, int k) { return block_.nodes[static_cast<std::size_t>(e) * nodes_ + k]; }
  int vertex(int e, int k) { return node(e, k % 3); }
  double* place(int at) { return &mesh_.coordinates[3 * static_cast<std::size_t>(at)]; }

  /// Number of the longest edge of a flat triangle, or -1. Edge k connects the vertices k and k + 1.
  int longestOfFlat(int e) {
    double squares[3];
    for (int k = 0; k < 3; ++k) {
      const double *a = place(vertex(e, k)), *b = place(vertex(e, k + 1));
      squares[k] = (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]);
    }
    const int longest = squares[0] >= squares[1] && squares[0] >= squares[2] ? 0 : squares[1] >= squares[2] ? 1 : 2;
    const double *a = place(node(e, 0)), *b = place(node(e, 1)), *c = place(node(e, 2));
    const double twiceArea = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    return std::abs(twiceArea) < kFlat * squares[longest] ? longest : -1;
  }

  /// (a, b, c) with the edge (c, a), and (a, c, d) become (a, b, d) and (b, c, d). The order of (a, b, c) is unknown: Gmsh orders vertices
  /// by the sign of the area, which is round-off.
  void swap(const Flat& flat, const Flat& other) {
    const auto take = [&](const Flat& from, int(&corners)[3], int(&middles)[3]) {
      for (int k = 0; k < 3; ++k) {
        const int at = (from.edge + k) % 3;
        corners[k] = node(from.element, at);
        middles[k] = nodes_ == 6 ? node(from.element, 3 + at) : -1;
      }
    };
    int cab[3], cabMiddles[3], acd[3], acdMiddles[3];
    take(flat, cab, cabMiddles);
    take(other, acd, acdMiddles);
    if (cab[0] == acd[0]) std::swap(cabMiddles[1], cabMiddles[2]);
    const int a = acd[0], b = cab[2], c = acd[1], d = acd[2];
    const int ab = cabMiddles[1], bc = cabMiddles[2], cd = acdMiddles[1], da = acdMiddles[2], bd = acdMiddles[0];
    const auto put = [&](int e, const int(&corners)[3], const int(&middles)[3]) {
      for (int k = 0; k < 3; ++k) {
        node(e, k) = corners[k];
        if (nodes_ == 6) node(e, 3 + k) = middles[k];
      }
    };
    put(flat.element, {a, b, d}, {ab, bd, da});
    put(other.element, {b, c, d}, {bc, cd, bd});
    if (nodes_ == 6)
      for (int k = 0; k < 3; ++k) place(bd)[k] = 0.5 * (place(b)[k] + place(d)[k]);
  }

  GmshMesh& mesh_;
  GmshMesh::Block& block_;
  int nodes_;  ///< number of nodes of an element
};

}  // namespace

int swapFlatTriangles(GmshMesh& mesh) {
  for (const GmshMesh::Block& block : mesh.blocks)
    if (block.dimension == 3) return 0;
  int swapped = 0;
  for (GmshMesh::Block& block : mesh.blocks)
    if (block.type == kTriangle3 || block.type == kTriangle6) swapped += Swapping(mesh, block).run();
  return swapped;
}

}  // namespace suture
