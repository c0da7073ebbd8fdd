#include <suture/answer/values/NodalStresses.hpp>
#include <suture/answer/verdict/SeamExchange.hpp>
#include <suture/base/Collective.hpp>

namespace suture {

std::vector<Matrix> nodalStresses(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                  const std::vector<PatchRecovery>& recovered) {
  std::vector<Matrix> all;
  collectively(comm, "recovering stresses", [&] {
    for (const PatchRecovery& block : recovered) all.push_back(block.nodalSums());
  });
  // In a body of one material the stress at a node is the same on all subdomains.
  if (!model.materialOfRegion.empty()) SeamExchange(comm, meshes).sum(all);
  for (Matrix& sums : all) {
    const Eigen::Index components = sums.rows() - 1;
    // Outer nodes of coatings are in no element: zero.
    sums = (sums.topRows(components).array().rowwise() / sums.row(components).array().max(1.0)).matrix().transpose().eval();
  }
  return all;
}

}  // namespace suture
