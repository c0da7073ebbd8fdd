#include <suture/base/Errors.hpp>
#include <suture/partition/Seams.hpp>

#include <algorithm>

namespace suture {

std::vector<SeamEntity> findSeams(const std::vector<const SubdomainMesh*>& subdomains) {
  EntityGraph graph;
  for (const SubdomainMesh* part : subdomains) {
    if (part->dimension != 2) throw InternalError("seams in dimension " + std::to_string(part->dimension));
    for (int node = 0; node < part->nodes(); ++node) {
      const Span<const int> others = part->others(node);
      if (others.empty()) continue;
      std::vector<int> sharers(others.begin(), others.end());
      sharers.push_back(part->id);
      std::sort(sharers.begin(), sharers.end());
      graph.addNode(part->globalNodes[node], std::move(sharers));
    }
  }
  for (const SubdomainMesh* part : subdomains)
    for (const SubdomainMesh::SeamSide& seam : part->seamSides) {
      std::vector<GlobalId> nodes;
      for (const int node : part->nodesOf(Side{seam.element, seam.side})) nodes.push_back(part->globalNodes[node]);
      graph.addSide(nodes, 2, {std::min(part->id, seam.neighbour), std::max(part->id, seam.neighbour)});
    }
  return graph.entities();
}

std::vector<SeamEntity> findSeams(const std::vector<SubdomainMesh>& subdomains) {
  std::vector<const SubdomainMesh*> pointers;
  for (const SubdomainMesh& part : subdomains) pointers.push_back(&part);
  return findSeams(pointers);
}

}  // namespace suture
