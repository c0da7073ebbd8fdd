#include <suture/algebra/CostModel.hpp>
#include <suture/base/Gather.hpp>
#include <suture/partition/cut/Costs.hpp>

#include <algorithm>

namespace suture {

namespace {

struct Size {
  int subdomain, nodes, interfaceNodes;
};

// Sizes of the subdomains that this rank cuts, without contact.
std::vector<Size> sizesOf(const MeshShare& share, int nodes) {
  std::vector<Size> sizes;
  std::vector<int> place;  // index of each subdomain in sizes
  for (int node = 0; node < nodes; ++node) {
    const auto holders = share.holders.of(node);
    for (const int s : holders) {
      if (s >= static_cast<int>(place.size())) place.resize(s + 1, -1);
      if (place[s] < 0) {
        place[s] = static_cast<int>(sizes.size());
        sizes.push_back({s, 0, 0});
      }
      ++sizes[place[s]].nodes;
      sizes[place[s]].interfaceNodes += holders.size() > 1;
    }
  }
  return sizes;
}

}  // namespace

std::vector<long long> expectedCosts(const Comm& comm, const CellBlock& mesh, const MeshShare& share, int subdomains,
                                     const NodeSubdomains& contactHolders) {
  const std::vector<Size> all = joinOnRoot(comm, sizesOf(share, share.block(mesh).nodes()));
  std::vector<long long> costs;
  collectivelyOnRoot(comm, "partition", [&] {
    const CostModel cost(mesh.dimension);
    std::vector<Size> sizes(subdomains, Size{0, 0, 0});
    for (const Size& size : all) sizes[size.subdomain] = size;
    for (std::size_t node = 0; node + 1 < contactHolders.offsets.size(); ++node)
      if (const auto holders = contactHolders.of(static_cast<int>(node)); holders.size() == 1) ++sizes[holders[0]].interfaceNodes;
    for (const Size& size : sizes) costs.push_back(cost.work(size.nodes, size.interfaceNodes));
  });
  return costs;
}

}  // namespace suture
