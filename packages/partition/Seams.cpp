#include <suture/mesh/SideGeometry.hpp>
#include <suture/partition/Seams.hpp>

#include <algorithm>
#include <set>

namespace suture {

std::vector<SeamEntity> findSeams(const std::vector<const SubdomainMesh*>& subdomains) {
  EntityGraph graph;
  for (const SubdomainMesh* part : subdomains) {
    std::set<int> masters;  // their unknowns move many nodes: no part of an edge or face
    for (const RigidGroup& group : part->rigidGroups) masters.insert(group.masterNodes.begin(), group.masterNodes.end());
    for (int node = 0; node < part->nodes(); ++node) {
      const Span<const int> others = part->others(node);
      if (others.empty()) continue;
      std::vector<int> sharers(others.begin(), others.end());
      sharers.push_back(part->id);
      std::sort(sharers.begin(), sharers.end());
      graph.addNode(part->globalNodes[node], std::move(sharers), masters.count(node) > 0);
    }
  }
  for (const SubdomainMesh* part : subdomains) {
    for (const SubdomainMesh::SeamSide& seam : part->seamSides) {
      std::vector<GlobalId> nodes;
      for (const int node : part->nodesOf(Side{seam.element, seam.side})) nodes.push_back(part->globalNodes[node]);
      graph.addSide(nodes, sideVertices(static_cast<int>(nodes.size()), part->dimension),
                    {std::min(part->id, seam.neighbour), std::max(part->id, seam.neighbour)});
    }
    for (const SubdomainMesh::SeamEdge& edge : part->seamEdges) {
      std::vector<GlobalId> nodes{part->globalNodes[edge.vertices[0]], part->globalNodes[edge.vertices[1]]};
      if (edge.middle >= 0) nodes.push_back(part->globalNodes[edge.middle]);
      graph.addSide(nodes, 2, edge.sharers);
    }
  }
  std::vector<SeamEntity> all = graph.entities();
  // In 3D an edge is held by faces: it needs no points where it ends at the surface of the body.
  if (!subdomains.empty() && subdomains.front()->dimension == 3)
    for (SeamEntity& entity : all) entity.ends.clear();
  return all;
}

std::vector<SeamEntity> findSeams(const std::vector<SubdomainMesh>& subdomains) {
  std::vector<const SubdomainMesh*> pointers;
  for (const SubdomainMesh& part : subdomains) pointers.push_back(&part);
  return findSeams(pointers);
}

}  // namespace suture
