#include <suture/interface/SeamLayout.hpp>
#include <suture/partition/Seams.hpp>

#include <algorithm>

namespace suture {

namespace {

/// Free unknowns at a node of the mesh, from the first subdomain of this rank that contains the node.
std::vector<GlobalId> unknownsAt(GlobalId node, const std::vector<const Subdomain*>& holders) {
  std::vector<GlobalId> ids;
  for (const Subdomain* subdomain : holders) {
    const auto& nodes = subdomain->mesh().globalNodes;
    const auto found = std::lower_bound(nodes.begin(), nodes.end(), node);
    if (found == nodes.end() || *found != node) continue;
    const int local = static_cast<int>(found - nodes.begin());
    for (int k = 0; k < subdomain->components(); ++k)
      if (const int dof = subdomain->dof(local, k); dof >= 0) ids.push_back(subdomain->globalDof(dof));
    return ids;
  }
  return ids;
}

}  // namespace

void addSeams(const std::vector<std::unique_ptr<Subdomain>>& subdomains, const std::function<int(int subdomain)>& problemOf,
              InterfaceLayout& layout) {
  std::vector<const Subdomain*> byId;
  std::vector<const SubdomainMesh*> meshes;
  for (const auto& subdomain : subdomains) {
    byId.push_back(subdomain.get());
    meshes.push_back(&subdomain->mesh());
  }
  const auto find = [&](int id) -> const Subdomain* {
    const auto found = std::lower_bound(byId.begin(), byId.end(), id, [](const Subdomain* s, int i) { return s->mesh().id < i; });
    return found != byId.end() && (*found)->mesh().id == id ? *found : nullptr;
  };
  for (const SeamEntity& entity : findSeams(meshes)) {
    std::vector<const Subdomain*> holders;
    InterfaceLayout::Entity own{entity.kind, {}, {}, {}};
    for (const int id : entity.sharers) {
      if (const Subdomain* subdomain = find(id)) holders.push_back(subdomain);
      own.sharers.push_back(problemOf(id));
    }
    std::sort(own.sharers.begin(), own.sharers.end());
    own.sharers.erase(std::unique(own.sharers.begin(), own.sharers.end()), own.sharers.end());
    if (own.sharers.size() < 2) continue;
    const auto addUnknowns = [&](const std::vector<GlobalId>& nodes, std::vector<GlobalId>& unknowns) {
      for (const GlobalId node : nodes) {
        const std::vector<GlobalId> ids = unknownsAt(node, holders);
        unknowns.insert(unknowns.end(), ids.begin(), ids.end());
      }
    };
    addUnknowns(entity.nodes, own.unknowns);
    addUnknowns(entity.ends, own.ends);
    layout.entities.push_back(std::move(own));
  }
}

void addUnknowns(const Subdomain& subdomain, const std::vector<int>& dofs, InterfaceLayout& layout) {
  layout.dimension = subdomain.mesh().dimension;
  const Hint flux = subdomain.hint(Hint::kSeamFlux);
  for (const int dof : dofs)
    layout.unknowns.push_back({subdomain.globalDof(dof),
                               subdomain.mesh().point(subdomain.nodeOf(dof)),
                               subdomain.direction(dof),
                               {0, 0, 0},
                               flux.empty() ? 0.0 : flux.values(dof, 0)});
}

}  // namespace suture
