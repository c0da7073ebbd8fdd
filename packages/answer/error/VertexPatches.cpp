#include <suture/answer/error/VertexPatches.hpp>

namespace suture {

VertexPatches::VertexPatches(const CellBlock& block, const std::function<const Material&(int element)>& materialOf) {
  std::vector<int> lastAt(block.nodes(), -1), before;  // patches of a node form a chain, nearly always of one link
  first.reserve(block.elements() + 1);
  for (int e = 0; e < block.elements(); ++e) {
    const Material& material = materialOf(e);
    const Span<const int> nodes = block.nodesOf(e);
    for (int v = 0; v < cellInfo(block.cells[e]).vertices; ++v) {
      int patch = lastAt[nodes[v]];
      const auto ofAnother = [&](const Patch& p) {
        return p.young != material.young || p.poisson != material.poisson || p.material != material.number;
      };
      while (patch >= 0 && ofAnother(all[patch])) patch = before[patch];
      if (patch < 0) {
        patch = count();
        all.push_back({nodes[v], material.young, material.poisson, material.number});
        before.push_back(lastAt[nodes[v]]);
        lastAt[nodes[v]] = patch;
      }
      ofVertices.push_back(patch);
    }
    first.push_back(static_cast<int>(ofVertices.size()));
  }
}

}  // namespace suture
