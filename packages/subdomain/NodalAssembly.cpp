#include <suture/subdomain/NodalAssembly.hpp>

#include <algorithm>
#include <numeric>

namespace suture {

namespace {

/// Where a node occurs: in which element, and as which of its nodes.
struct Occurrence {
  int element, place;
};

class Neighbourhoods {
 public:
  explicit Neighbourhoods(const CellBlock& mesh) : mesh_(mesh), first_(mesh.nodes() + 1, 0), seen_(mesh.nodes(), -1) {
    for (const int node : mesh.connectivity) ++first_[node + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    occurrences_.resize(mesh.connectivity.size());
    std::vector<int> next(first_.begin(), first_.end() - 1);
    for (int e = 0; e < mesh.elements(); ++e)
      for (std::size_t k = 0; k < mesh.nodesOf(e).size(); ++k) occurrences_[next[mesh.nodesOf(e)[k]]++] = {e, static_cast<int>(k)};
  }

  Span<const Occurrence> of(int node) const {
    return {occurrences_.data() + first_[node], static_cast<std::size_t>(first_[node + 1] - first_[node])};
  }
  /// Appends the nodes that share an element with this one, itself among them, in ascending order. Call it once a node.
  void addNeighbours(int node, std::vector<int>& all) {
    const auto begin = static_cast<std::ptrdiff_t>(all.size());
    for (const Occurrence& here : of(node))
      for (const int other : mesh_.nodesOf(here.element))
        if (seen_[other] != node) {
          seen_[other] = node;
          all.push_back(other);
        }
    std::sort(all.begin() + begin, all.end());
  }

 private:
  const CellBlock& mesh_;
  std::vector<int> first_, seen_;
  std::vector<Occurrence> occurrences_;
};

}  // namespace

SparseMatrix assembleNodal(const CellBlock& mesh, int components, const ElementMatrices& matrices) {
  std::vector<std::size_t> start(mesh.elements() + 1, 0);
  for (int e = 0; e < mesh.elements(); ++e) {
    const std::size_t size = mesh.nodesOf(e).size() * components;
    start[e + 1] = start[e] + size * size;
  }
  Neighbourhoods around(mesh);
  std::vector<int> neighbours, firstNeighbour{0};  // of all nodes, one after the other
  SparseMatrix sum(mesh.nodes() * components, mesh.nodes() * components);
  int* outer = sum.outerIndexPtr();
  for (int node = 0; node < mesh.nodes(); ++node) {
    around.addNeighbours(node, neighbours);
    const int rows = components * static_cast<int>(neighbours.size() - firstNeighbour.back());
    firstNeighbour.push_back(static_cast<int>(neighbours.size()));
    for (int c = node * components; c < (node + 1) * components; ++c) outer[c + 1] = outer[c] + rows;
  }
  sum.resizeNonZeros(outer[sum.cols()]);
  std::fill_n(sum.valuePtr(), sum.nonZeros(), 0.0);

  std::vector<int> slot(mesh.nodes());  // of a neighbour, within the columns of the node at hand
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Span<const int> here{neighbours.data() + firstNeighbour[node],
                               static_cast<std::size_t>(firstNeighbour[node + 1] - firstNeighbour[node])};
    for (std::size_t k = 0; k < here.size(); ++k) slot[here[k]] = static_cast<int>(k) * components;
    for (int c = 0; c < components; ++c) {
      int* rows = sum.innerIndexPtr() + outer[node * components + c];
      for (const int other : here)
        for (int r = 0; r < components; ++r) *rows++ = other * components + r;
      double* values = sum.valuePtr() + outer[node * components + c];
      for (const Occurrence& occurrence : around.of(node)) {
        const auto nodes = mesh.nodesOf(occurrence.element);
        const std::size_t column = occurrence.place * components + c;
        const double* entry = matrices.data() + start[occurrence.element] + column * nodes.size() * components;
        for (const int other : nodes)
          for (int r = 0; r < components; ++r) values[slot[other] + r] += *entry++;
      }
    }
  }
  return sum;
}

}  // namespace suture
