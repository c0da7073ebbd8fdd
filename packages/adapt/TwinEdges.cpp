#include <suture/adapt/TwinEdges.hpp>
#include <suture/base/Errors.hpp>
#include <suture/mesh/SideTable.hpp>

#include <algorithm>

namespace suture {

namespace {

/// Elements with a node that is marked.
std::vector<int> elementsAt(const Mesh& mesh, const std::vector<char>& nodes) {
  std::vector<int> found;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Span<const int> own = mesh.nodesOf(e);
    if (std::any_of(own.begin(), own.end(), [&](int node) { return nodes[node] != 0; })) found.push_back(e);
  }
  return found;
}

std::vector<int> verticesOf(const Mesh& mesh, const Side& side) {
  const CellInfo& cell = cellInfo(mesh.cells[side.element]);
  std::vector<int> vertices;
  for (const int local : cell.sideNodes[side.side])
    if (local < cell.vertices) vertices.push_back(mesh.nodesOf(side.element)[local]);
  return vertices;
}

}  // namespace

void Carrier::add(int vertex) {
  const auto end = vertices.begin() + count;
  const auto at = std::lower_bound(vertices.begin(), end, vertex);
  if (at != end && *at == vertex) return;
  if (count == 4) throw InternalError("an edge between vertices of two elements");
  std::move_backward(at, end, end + 1);
  *at = vertex;
  ++count;
}

Carrier Carrier::of(int vertex) {
  Carrier carrier;
  carrier.add(vertex);
  return carrier;
}

Carrier Carrier::ofBoth(const Carrier& a, const Carrier& b) {
  Carrier carrier = a;
  for (int k = 0; k < b.count; ++k) carrier.add(b.vertices[k]);
  return carrier;
}

TwinEdges::TwinEdges(const Mesh& mesh, const std::vector<NodePairs>& contacts) : contacts_(static_cast<int>(contacts.size())) {
  std::vector<char> paired(mesh.nodes(), 0), near(mesh.nodes(), 0);
  for (const NodePairs& pairs : contacts)
    for (const auto& [a, b] : pairs) paired[a] = paired[b] = 1;
  const std::vector<int> elements = elementsAt(mesh, paired);
  if (elements.empty()) return;
  for (const int e : elements)
    for (const int node : mesh.nodesOf(e)) near[node] = 1;
  const SideTable table(mesh, near);
  for (int c = 0; c < contacts_; ++c) {
    std::unordered_map<int, int> opposite;
    for (const auto& [a, b] : contacts[c]) opposite[a] = b;
    for (const int e : elements)
      forEachSide(mesh, e, [&](const SideKey& key, const Side& side) {
        std::vector<int> own = verticesOf(mesh, side), other;
        bool some = false;
        for (const int v : own) {
          const auto found = opposite.find(v);
          other.push_back(found == opposite.end() ? v : found->second);  // itself: the tip of a crack
          some = some || other.back() != v;
        }
        if (!some || table.of(key).size() != 1) return;
        const std::vector<Side> there = table.of(sideKey(other.data(), static_cast<int>(other.size())));
        if (there.size() != 1) return;
        for (std::size_t k = 0; k < own.size(); ++k) add(2 * c, own[k], other[k]);
        addSide(mesh, side, 2 * c);
        addSide(mesh, there.front(), 2 * c + 1);
      });
  }
}

void TwinEdges::addSide(const Mesh& mesh, const Side& side, int view) {
  const CellInfo& cell = cellInfo(mesh.cells[side.element]);
  const Span<const int> nodes = mesh.nodesOf(side.element);
  const std::vector<int> vertices = verticesOf(mesh, side);
  const auto put = [&](const SideKey& key) {
    std::vector<int>& views = views_[key];
    if (std::find(views.begin(), views.end(), view) == views.end()) views.push_back(view);
  };
  put(sideKey(vertices.data(), static_cast<int>(vertices.size())));
  for (std::size_t k = 0; k < cell.edges.size(); ++k) {
    const int p = nodes[cell.edges[k][0]], q = nodes[cell.edges[k][1]];
    if (std::count(vertices.begin(), vertices.end(), p) == 0 || std::count(vertices.begin(), vertices.end(), q) == 0) continue;
    put(sideKey(p, q));
    if (cell.order == 2) middles_[sideKey(p, q)] = nodes[cell.vertices + static_cast<int>(k)];
  }
}

// Keys of edges and of faces differ: the second number of a face exceeds 2^32.
SideKey TwinEdges::keyOf(const Carrier& carrier) {
  return carrier.count == 2 || carrier.count == 3 ? sideKey(carrier.vertices.data(), carrier.count) : SideKey{};
}

void TwinEdges::add(int view, int vertex, int twin) {
  twins_[static_cast<long long>(vertex) * 2 * contacts_ + view] = twin;
  twins_[static_cast<long long>(twin) * 2 * contacts_ + (view ^ 1)] = vertex;
}

int TwinEdges::twinOf(int vertex, int view) const { return twins_.at(static_cast<long long>(vertex) * 2 * contacts_ + view); }

int TwinEdges::middleOf(int p, int q) const {
  const auto found = middles_.find(sideKey(p, q));
  return found == middles_.end() ? -1 : found->second;
}

std::vector<NodePairs> TwinEdges::pairs() const {
  std::vector<NodePairs> all(static_cast<std::size_t>(contacts_));
  for (const auto& [key, twin] : twins_) {
    const int view = static_cast<int>(key % (2 * contacts_)), vertex = static_cast<int>(key / (2 * contacts_));
    if (view % 2 == 0 && vertex != twin) all[static_cast<std::size_t>(view) / 2].emplace_back(vertex, twin);
  }
  for (NodePairs& pairs : all) std::sort(pairs.begin(), pairs.end());
  return all;
}

}  // namespace suture
