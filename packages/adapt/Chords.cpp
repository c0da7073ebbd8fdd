#include <suture/adapt/Chords.hpp>
#include <suture/base/Point.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace suture {

namespace {

constexpr double kStraightEdge = 1e-8;      // offset over the length of an edge that is round-off
constexpr double kNearlyStraight = 1e-6;    // likewise, of short edges far from the origin
constexpr double kLeastOfLength = 0.03125;  // least ratio of new and old lengths

bool isSecondOrderSimplex(Cell cell) { return cell == Cell::Triangle6 || cell == Cell::Tetrahedron10; }

std::array<int, 2> ordered(int a, int b) { return a < b ? std::array<int, 2>{a, b} : std::array<int, 2>{b, a}; }

/// Offsets of the edges of a side along its normal, zero for straight ones; by pairs of its vertices.
class Offsets {
 public:
  explicit Offsets(const std::vector<Chord>& chords) {
    for (const Chord& chord : chords) ofEdge_[chord.ends] = chord.offset;
  }
  std::vector<double> of(const Mesh& mesh, const std::vector<int>& vertices) const {
    std::vector<double> all;
    const Point normal = unitNormal(mesh, vertices);
    const std::size_t edges = vertices.size() == 2 ? 1 : vertices.size();
    for (std::size_t k = 0; k < edges; ++k) {
      const auto found = ofEdge_.find(ordered(vertices[k], vertices[(k + 1) % vertices.size()]));
      all.push_back(found == ofEdge_.end() ? 0.0 : std::abs(dot(found->second, normal)));
    }
    return all;
  }

 private:
  static Point unitNormal(const Mesh& mesh, const std::vector<int>& vertices) {
    const Point first = minus(mesh.point(vertices[1]), mesh.point(vertices[0]));
    const Point normal =
        vertices.size() == 2 ? Point{first[1], -first[0], 0} : cross(first, minus(mesh.point(vertices[2]), mesh.point(vertices[0])));
    return scaled(1 / norm(normal), normal);
  }

  std::map<std::array<int, 2>, Point> ofEdge_;
};

/// Body and region of an element: elements with the same numbers have the same material.
std::array<int, 2> materialOf(const Mesh& mesh, int element) {
  return {mesh.bodyOfElement[static_cast<std::size_t>(element)],
          mesh.regions.empty() ? -1 : mesh.regions[static_cast<std::size_t>(element)]};
}

double lengthOf(const Mesh& mesh, const std::vector<int>& vertices) {
  return norm(minus(mesh.point(vertices[1]), mesh.point(vertices[0])));
}

double sizeOf(const Mesh& mesh, const std::vector<int>& vertices) {
  const Point first = minus(mesh.point(vertices[1]), mesh.point(vertices[0]));
  return vertices.size() == 2 ? norm(first) : norm(cross(first, minus(mesh.point(vertices[2]), mesh.point(vertices[0])))) / 2;
}

}  // namespace

std::vector<Chord> straighten(Mesh& mesh, const std::vector<std::string>& kept) {
  std::vector<char> isKept(static_cast<std::size_t>(mesh.nodes()), 0);
  for (const Side& side : sidesOf(mesh.sideGroups, kept))
    for (const int node : mesh.nodesOf(side)) isKept[static_cast<std::size_t>(node)] = 1;
  std::map<std::array<int, 2>, Point> offsets;
  for (int e = 0; e < mesh.elements(); ++e) {
    if (!isSecondOrderSimplex(mesh.cells[e])) continue;
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const Span<const int> nodes = mesh.nodesOf(e);
    for (std::size_t k = 0; k < cell.edges.size(); ++k) {
      const int middle = nodes[static_cast<std::size_t>(cell.vertices) + k];
      const int a = nodes[cell.edges[k][0]], b = nodes[cell.edges[k][1]];
      const Point straight = scaled(0.5, plus(mesh.point(a), mesh.point(b)));
      const Point offset = minus(mesh.point(middle), straight);
      const double length = norm(minus(mesh.point(a), mesh.point(b)));
      if (isKept[static_cast<std::size_t>(middle)] && norm(offset) > kNearlyStraight * length) continue;
      if (norm(offset) > kStraightEdge * length) offsets[ordered(a, b)] = offset;
      std::copy_n(straight.begin(), mesh.dimension, mesh.coordinates.begin() + std::ptrdiff_t(middle) * mesh.dimension);
    }
  }
  std::vector<Chord> chords;
  for (const auto& [ends, offset] : offsets) chords.push_back({ends, offset});
  return chords;
}

std::vector<ChordSide> chordSides(const Mesh& mesh, const std::vector<Chord>& chords) {
  std::vector<ChordSide> sides;
  if (chords.empty()) return sides;
  const Offsets offsets(chords);
  std::map<SideKey, std::vector<Side>> curved;
  for (int e = 0; e < mesh.elements(); ++e)
    forEachSide(mesh, e, [&](const SideKey& key, const Side& side) {
      std::vector<int> vertices = mesh.nodesOf(side);
      vertices.resize(static_cast<std::size_t>(mesh.dimension));
      const std::vector<double> all = offsets.of(mesh, vertices);
      if (*std::max_element(all.begin(), all.end()) > kStraightEdge * lengthOf(mesh, vertices)) curved[key].push_back(side);
    });
  for (const auto& [key, both] : curved) {
    if (both.size() == 2 && materialOf(mesh, both[0].element) == materialOf(mesh, both[1].element)) continue;
    for (const Side& side : both) {
      ChordSide found;
      found.element = side.element;
      found.vertices = mesh.nodesOf(side);
      found.vertices.resize(static_cast<std::size_t>(mesh.dimension));
      double size = sizeOf(mesh, found.vertices);
      found.length = mesh.dimension == 2 ? size : std::sqrt(2 * size);
      if (mesh.axisymmetric) size *= circumference((mesh.point(found.vertices[0])[0] + mesh.point(found.vertices[1])[0]) / 2);
      const double share = mesh.dimension == 2 ? 2.0 / 3 : 1.0 / 3;
      for (const double offset : offsets.of(mesh, found.vertices)) {
        found.volume += share * offset * size;
        found.excess += 8.0 / 3 * offset * offset / (found.length * found.length) * size;
      }
      sides.push_back(std::move(found));
    }
  }
  return sides;
}

std::vector<double> sizesAlongCurves(const Mesh& mesh, const std::vector<ChordSide>& sides, const std::vector<double>& effects,
                                     double wanted) {
  std::vector<double> largest(static_cast<std::size_t>(mesh.nodes()), std::numeric_limits<double>::infinity());
  const double exponent = 1.0 / (mesh.dimension + 1);
  double sum = 0.0;
  for (const double effect : effects) sum += std::pow(effect, 1 - 2 * exponent);
  for (std::size_t s = 0; s < sides.size(); ++s) {
    if (!(effects[s] > 0)) continue;
    const double ratio = std::max(kLeastOfLength, std::sqrt(wanted / sum) * std::pow(effects[s], -exponent));
    for (const int node : sides[s].vertices)
      largest[static_cast<std::size_t>(node)] = std::min(largest[static_cast<std::size_t>(node)], ratio * sides[s].length);
  }
  return largest;
}

}  // namespace suture
