#include <suture/adapt/SplitEdges.hpp>

namespace suture {

template <int D>
SplitEdges<D>::SplitEdges(const RefinableMesh& coarse, const std::vector<char>& marked)
    : coarse_(coarse),
      twins_(coarse.mesh, coarse.twins),
      middles_(coarse.mesh.nodes()),
      nodes_(coarse.mesh.nodes()),
      touched_(static_cast<std::size_t>(coarse.mesh.nodes()), 0),
      carrier_(static_cast<std::size_t>(coarse.mesh.nodes()), -1) {
  close(marked);
}

// An edge that is split concerns all elements that contain it: they have at least two of the vertices between which it lies. Those
// are noted with the number of the round, so that a round costs little where nothing happens.
template <int D>
void SplitEdges<D>::close(const std::vector<char>& marked) {
  for (int e = 0; e < coarse_.mesh.elements(); ++e)
    if (marked[e]) split(e, simplex(e), 0, D);
  for (std::size_t before = 0; before < middles_.size();) {
    before = middles_.size();
    ++round_;
    for (int e = 0; e < coarse_.mesh.elements(); ++e)
      if (touchedVertices(e, round_ - 1) >= 2) split(e, simplex(e), 0, 0);
  }
}

template <int D>
int SplitEdges<D>::touchedVertices(int element, int since) const {
  const int* nodes = coarse_.mesh.nodesOf(element).begin();
  int count = 0;
  for (int k = 0; k <= D; ++k) count += touched_[nodes[k]] >= since ? 1 : 0;
  return count;
}

template <int D>
bool SplitEdges<D>::isSplit(const MarkedSimplex<D>& part) const {
  for (int i = 0; i <= D; ++i)
    for (int j = i + 1; j <= D; ++j)
      if (middle(part.vertices[i], part.vertices[j]) >= 0) return true;
  return false;
}

template <int D>
void SplitEdges<D>::split(int element, const MarkedSimplex<D>& part, int depth, int required) {
  if (depth >= required && !isSplit(part)) return;
  const int p = part.vertices[0], q = part.vertices[1];
  int node = middle(p, q);
  if (node < 0) node = split(p, q, coarseMiddle(element, p, q));
  const auto [first, second] = bisected<D>(part, node);
  split(element, first, depth + 1, required);
  split(element, second, depth + 1, required);
}

/// \param known  mid-side node that becomes the vertex, or -1
template <int D>
int SplitEdges<D>::split(int p, int q, int known) {
  const int node = known >= 0 ? known : nodes_++;
  const Carrier carrier = Carrier::ofBoth(carrierOf(p), carrierOf(q));
  if (known < 0) {
    ends_.push_back({p, q});
    carrier_.push_back(-1);
  }
  carrier_[node] = static_cast<int>(carriers_.size());
  carriers_.push_back(carrier);
  middles_.add(p, q, node);
  touch(carrier);
  if (twins_.empty()) return node;
  std::vector<std::array<int, 3>> twins;
  twins_.forEachTwin(p, q, carrier, [&](int view, int a, int b) { twins.push_back({view, a, b}); });
  for (const auto& [view, a, b] : twins) {
    int twin = middle(a, b);
    if (twin < 0) twin = split(a, b, twins_.middleOf(a, b));
    twins_.add(view, node, twin);
  }
  return node;
}

/// Mid-side node of an edge of the element; -1 for other edges, and in meshes of first order.
template <int D>
int SplitEdges<D>::coarseMiddle(int element, int p, int q) const {
  const CellInfo& cell = cellInfo(coarse_.mesh.cells[element]);
  if (cell.order == 1) return -1;
  const Span<const int> nodes = coarse_.mesh.nodesOf(element);
  for (std::size_t k = 0; k < cell.edges.size(); ++k) {
    const int a = nodes[cell.edges[k][0]], b = nodes[cell.edges[k][1]];
    if ((a == p && b == q) || (a == q && b == p)) return nodes[cell.vertices + k];
  }
  return -1;
}

template <int D>
const Carrier SplitEdges<D>::carrierOf(int vertex) const {
  return carrier_[vertex] < 0 ? Carrier::of(vertex) : carriers_[carrier_[vertex]];
}

template <int D>
void SplitEdges<D>::touch(const Carrier& carrier) {
  for (int k = 0; k < carrier.count; ++k) touched_[carrier.vertices[k]] = round_;
}

template <int D>
MarkedSimplex<D> SplitEdges<D>::simplex(int element) const {
  MarkedSimplex<D> simplex;
  const int* nodes = coarse_.mesh.nodesOf(element).begin();
  for (int k = 0; k <= D; ++k) simplex.vertices[k] = nodes[k];
  if (!coarse_.marks.empty()) simplex.marks = coarse_.marks[element];
  return simplex;
}

template class SplitEdges<2>;
template class SplitEdges<3>;

}  // namespace suture
