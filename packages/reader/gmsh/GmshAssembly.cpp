#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/mesh/ShapeFunctions.hpp>
#include <suture/mesh/SideTable.hpp>
#include <suture/reader/gmsh/GmshAssembly.hpp>
#include <suture/reader/gmsh/GmshTypes.hpp>

#include <algorithm>
#include <array>
#include <climits>
#include <cmath>

namespace suture {

namespace {

using Numbers = std::vector<int>;

/// Node numbers of each cell under the reflection that exchanges the first two reference coordinates: the same shape, reversed.
const std::array<Numbers, kCells>& mirrored() {
  static const auto made = [] {
    std::array<Numbers, kCells> all;
    for (int number = 0; number < kCells; ++number) {
      const Cell cell = static_cast<Cell>(number);
      for (int i = 0; i < cellInfo(cell).nodes; ++i) {
        ReferencePoint place = referencePoint(cell, i);
        std::swap(place[0], place[1]);
        int other = 0;
        while (referencePoint(cell, other) != place) ++other;
        all[number].push_back(other);
      }
    }
    return all;
  }();
  return made;
}

void turnRound(Cell cell, int* nodes) {
  const Numbers& from = mirrored()[static_cast<std::size_t>(cell)];
  const Numbers old(nodes, nodes + from.size());
  for (std::size_t i = 0; i < from.size(); ++i) nodes[i] = old[static_cast<std::size_t>(from[i])];
}

/// Number of vertices among the nodes of an element or of a part of its boundary.
int verticesOf(const GmshType& type) { return type.dimension == 1 ? 2 : cellInfo(*type.cell).vertices; }

template <typename Less, typename T>
void makeSet(std::vector<T>& values, const Less& less) {
  if (!std::is_sorted(values.begin(), values.end(), less)) std::sort(values.begin(), values.end(), less);
  const auto same = [&](const T& a, const T& b) { return !less(a, b) && !less(b, a); };
  values.erase(std::unique(values.begin(), values.end(), same), values.end());
}

class Assembly {
 public:
  Assembly(GmshMesh gmsh, const std::string& file) : gmsh_(std::move(gmsh)), elementsOf_(gmsh_.blocks.size()) {
    mesh_.source = file;
    mesh_.dimension = 2;
    bool holdsElements = !gmsh_.foreign.empty();
    for (const GmshMesh::Block& block : gmsh_.blocks) {
      if (block.dimension == 3) mesh_.dimension = 3;
      holdsElements = holdsElements || block.dimension > 1;
    }
    for (const GmshMesh::Foreign& elements : gmsh_.foreign) mesh_.dimension = std::max(mesh_.dimension, elements.dimension);
    for (const std::string& problem : gmsh_.problems) report(problem);
    reportForeign();
    if (!holdsElements)
      report("contains no surface elements and no volume elements; does it define a Surface or a Volume, and is it meshed?");
  }

  Mesh mesh() {
    problems_.throwIfAny();
    numberNodes();
    addElements();
    orient();
    addElementGroups();
    addSideGroups();
    problems_.throwIfAny();
    return std::move(mesh_);
  }

 private:
  void report(const std::string& problem) { problems_.add(kMeshFile, mesh_.source + ": " + problem); }
  void reportForeign() {
    for (const GmshMesh::Foreign& elements : gmsh_.foreign) {
      std::string names;
      for (const auto& [name, parts] : gmsh_.groups[elements.dimension])
        if (std::find(parts.begin(), parts.end(), elements.part) != parts.end()) names += (names.empty() ? "'" : ", '") + name + "'";
      const GmshType* type = gmshType(elements.type);
      report(std::to_string(elements.count) + " elements of the kind '" +
             (type ? type->name : "Gmsh type " + std::to_string(elements.type)) + "' (" +
             (names.empty() ? "in no group" : "in the group " + names) + "); supported are " + knownGmshTypes() +
             ": mesh with elements of order 1 or 2 (-order 2)" +
             (mesh_.dimension == 2 ? "" : "; prisms and pyramids, which result from recombined surfaces, with order 1"));
    }
  }
  const double* place(int node) const { return &gmsh_.coordinates[3 * static_cast<std::size_t>(node)]; }

  /// Calls visit(number, block, type) for every block of a dimension.
  template <typename Visit>
  void forBlocks(int dimension, const Visit& visit) const {
    for (std::size_t b = 0; b < gmsh_.blocks.size(); ++b)
      if (gmsh_.blocks[b].dimension == dimension) visit(b, gmsh_.blocks[b], *gmshType(gmsh_.blocks[b].type));
  }
  /// Calls visit(number of a block, number in it, its type) for every element of some parts.
  template <typename Visit>
  void forMembers(int dimension, const Numbers& parts, const Visit& visit) const {
    const auto among = [&](int part) { return std::find(parts.begin(), parts.end(), part) != parts.end(); };
    forBlocks(dimension, [&](std::size_t b, const GmshMesh::Block& block, const GmshType& type) {
      if (block.parts.empty() && !among(block.tag)) return;
      const std::size_t count = block.nodes.size() / static_cast<std::size_t>(type.nodes);
      for (std::size_t e = 0; e < count; ++e)
        if (block.parts.empty() || among(block.parts[e])) visit(b, e, type);
    });
  }

  void numberNodes() {
    number_.assign(gmsh_.tags.size(), -1);
    forBlocks(mesh_.dimension, [&](std::size_t, const GmshMesh::Block& block, const GmshType& type) {
      entries_ += block.nodes.size();
      most_ += block.nodes.size() / static_cast<std::size_t>(type.nodes);
      for (const int node : block.nodes) number_[node] = 0;
    });
    if (entries_ > INT_MAX) throw InputError(kMeshFile, mesh_.source + ": more than " + std::to_string(INT_MAX) + " nodes of elements");
    double size = 0, away = 0;
    int count = 0;
    mesh_.coordinates.reserve(static_cast<std::size_t>(mesh_.dimension) * number_.size());
    for (std::size_t node = 0; node < number_.size(); ++node) {
      if (number_[node] < 0) continue;
      number_[node] = count++;
      const double* p = place(static_cast<int>(node));
      mesh_.coordinates.insert(mesh_.coordinates.end(), p, p + mesh_.dimension);
      size = std::max({size, std::abs(p[0]), std::abs(p[1])});
      away = std::max(away, std::abs(p[2]));
    }
    if (mesh_.dimension == 2 && away > 1e-9 * size)
      report("nodes up to " + std::to_string(away) + " away from the plane z = 0; expected a 2D mesh, or a mesh with volume elements");
  }

  // Elements with the same nodes are the same element. Elements with the same lowest node form a chain, nearly always a short one.
  void addElements() {
    const int nodes = mesh_.nodes();
    mesh_.cells.reserve(most_);
    mesh_.offsets.reserve(most_ + 1);
    mesh_.connectivity.reserve(entries_);
    Numbers head(static_cast<std::size_t>(nodes), -1), next;
    std::vector<long long> sums;  // sum of the node numbers of each element: differs for most other elements of a chain
    next.reserve(most_);
    sums.reserve(most_);
    forBlocks(mesh_.dimension, [&](std::size_t b, const GmshMesh::Block& block, const GmshType& type) {
      const auto each = static_cast<std::size_t>(type.nodes);
      Numbers& elements = elementsOf_[b];
      elements.reserve(block.nodes.size() / each);
      for (std::size_t first = 0; first < block.nodes.size(); first += each) {
        int mine[kMostCellNodes], least = nodes;
        long long sum = 0;
        for (std::size_t i = 0; i < each; ++i) {
          const std::size_t from = type.order.empty() ? i : static_cast<std::size_t>(type.order[i]);
          mine[i] = number_[block.nodes[first + from]];
          least = std::min(least, mine[i]);
          sum += mine[i];
        }
        int same = head[least];
        while (same >= 0 && !(sums[same] == sum && isOf(same, mine, type.nodes))) same = next[same];
        if (same < 0) {
          same = mesh_.elements();
          next.push_back(head[least]);
          head[least] = same;
          sums.push_back(sum);
          mesh_.cells.push_back(*type.cell);
          mesh_.connectivity.insert(mesh_.connectivity.end(), mine, mine + each);
          mesh_.offsets.push_back(static_cast<int>(mesh_.connectivity.size()));
        }
        elements.push_back(same);
      }
    });
  }
  bool isOf(int element, const int* nodes, int count) const {
    const Span<const int> own = mesh_.nodesOf(element);
    return own.size() == static_cast<std::size_t>(count) && std::is_permutation(own.begin(), own.end(), nodes);
  }

  // An entity meshed the wrong way round as a whole (a surface whose normal points down, a volume inside out) is valid and is reversed.
  // Single inverted elements are not valid, and are left unchanged.
  void orient() {
    const auto isInverted = [&](int element) { return signedSize(mesh_, element) < 0; };
    for (std::size_t first = 0, end = 0; first < elementsOf_.size(); first = end) {
      const GmshMesh::Block& block = gmsh_.blocks[first];
      bool all = block.dimension == mesh_.dimension;
      for (end = first; end < elementsOf_.size() && gmsh_.blocks[end].dimension == block.dimension && gmsh_.blocks[end].tag == block.tag;
           ++end)
        all = all && std::all_of(elementsOf_[end].begin(), elementsOf_[end].end(), isInverted);
      for (std::size_t b = first; all && b < end; ++b)
        for (const int element : elementsOf_[b])
          if (isInverted(element)) turnRound(mesh_.cells[element], &mesh_.connectivity[static_cast<std::size_t>(mesh_.offsets[element])]);
    }
  }

  void addElementGroups() {
    for (const auto& [name, parts] : gmsh_.groups[mesh_.dimension]) {
      Numbers& members = mesh_.elementGroups[name];
      forMembers(mesh_.dimension, parts, [&](std::size_t b, std::size_t e, const GmshType&) { members.push_back(elementsOf_[b][e]); });
      makeSet(members, std::less<int>());
    }
  }

  void addSideGroups() {
    const int dimension = mesh_.dimension - 1;
    std::vector<char> among(static_cast<std::size_t>(mesh_.nodes()), 0);  // vertices of curve elements (2D) or surface elements (3D)
    forBlocks(dimension, [&](std::size_t, const GmshMesh::Block& block, const GmshType&) {
      for (const int node : block.nodes)
        if (number_[node] >= 0) among[number_[node]] = 1;
    });
    const SideTable table(mesh_, among);
    for (const auto& [name, parts] : gmsh_.groups[dimension]) {
      std::vector<Side> sides;
      std::vector<Point> outside, inside;  // centres of elements that are not boundary sides
      forMembers(dimension, parts, [&](std::size_t b, std::size_t e, const GmshType& type) {
        const int* nodes = &gmsh_.blocks[b].nodes[e * static_cast<std::size_t>(type.nodes)];
        const int count = verticesOf(type);
        const std::vector<Side> here = sidesAt(table, nodes, count);
        if (here.size() == 1) {
          sides.push_back(here[0]);
          return;
        }
        Point sum{0, 0, 0};
        for (int i = 0; i < count; ++i)
          for (int k = 0; k < 3; ++k) sum[k] += place(nodes[i])[k];
        (here.empty() ? outside : inside).push_back(scaled(1.0 / count, sum));
      });
      if (gmsh_.isUnnamed(name) && !(outside.empty() && inside.empty())) continue;
      reportSides(name, outside, mesh_.dimension == 2 ? "are not sides of any surface element" : "are not sides of any volume element");
      reportSides(
          name, inside,
          "lie inside the material, between two elements; if two bodies meet there, each must be a separate shape, never fragmented "
          "with the other");
      makeSet(sides, [](const Side& x, const Side& y) { return std::make_pair(x.element, x.side) < std::make_pair(y.element, y.side); });
      mesh_.sideGroups[name] = std::move(sides);
    }
  }
  /// Sides of the mesh with these vertices, given as positions in gmsh_.
  std::vector<Side> sidesAt(const SideTable& table, const int* nodes, int count) const {
    int vertices[kMostSideVertices];
    for (int i = 0; i < count; ++i) {
      vertices[i] = number_[nodes[i]];
      if (vertices[i] < 0) return {};  // no element has this vertex
    }
    std::vector<Side> found = table.of(sideKey(vertices, count));
    const auto isOther = [&](const Side& side) {  // a key holds all vertices of a triangle, but only three of a quadrilateral
      const CellInfo& cell = cellInfo(mesh_.cells[side.element]);
      int own[kMostSideVertices], ownCount = 0;
      for (const int local : cell.sideNodes[side.side])
        if (local < cell.vertices) own[ownCount++] = mesh_.nodesOf(side.element)[local];
      return ownCount != count || !std::is_permutation(own, own + count, vertices);
    };
    found.erase(std::remove_if(found.begin(), found.end(), isOther), found.end());
    return found;
  }
  void reportSides(const std::string& group, const std::vector<Point>& middles, const std::string& what) {
    if (!middles.empty())
      report(mesh_.sideGroupKind() + " '" + group + "': " + std::to_string(middles.size()) + " of its elements " + what +
             " (the first at " + placeText(middles[0], mesh_.dimension) + ")");
  }

  GmshMesh gmsh_;
  Mesh mesh_;
  Problems problems_;
  std::size_t entries_ = 0, most_ = 0;  // nodes of all elements; number of elements, including repeated ones
  Numbers number_;                      // number of each Gmsh node; -1: no element has it
  std::vector<Numbers> elementsOf_;     // by block; empty if the block holds sides
};

}  // namespace

Mesh assembleGmsh(GmshMesh gmsh, const std::string& file) { return Assembly(std::move(gmsh), file).mesh(); }

}  // namespace suture
