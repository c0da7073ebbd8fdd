#include <suture/answer/error/ErrorEstimate.hpp>
#include <suture/answer/error/PatchExchange.hpp>
#include <suture/base/Collective.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>

#include <cmath>

namespace suture {

std::vector<PatchRecovery> recoverStresses(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                           const std::vector<Vector>& displacement) {
  std::vector<PatchRecovery> blocks;
  for (std::size_t i = 0; i < meshes.size(); ++i) {
    const SubdomainMesh* mesh = &meshes[i];
    blocks.emplace_back(
        *mesh, [mesh, &model](int element) -> const Material& { return model.materialOf(*mesh, element, mesh->body); }, model.plane,
        displacement[i], InitialState(model, mesh->body));
  }
  std::vector<const VertexPatches*> patches;
  for (const PatchRecovery& block : blocks) patches.push_back(&block.vertices());
  recoverPatches(blocks, SubdomainExchange(comm, meshes, patches));
  return blocks;
}

DiscretisationError estimateError(const Comm& comm, const std::vector<PatchRecovery>& recovered) {
  DiscretisationError result;
  double squares[2] = {0.0, 0.0}, all[2];
  collectively(comm, "recovering stresses", [&] {
    for (const PatchRecovery& block : recovered) {
      const ElementErrors errors = block.errors();
      squares[0] += errors.error.sum();
      squares[1] += errors.norm.sum();
      result.ofElements.push_back(errors.error.cwiseSqrt());
    }
  });
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 2, squares, all);
  result.energyNorm = std::sqrt(all[0]);
  result.solutionNorm = std::sqrt(all[1]);
  return result;
}

DiscretisationError estimateError(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                  const std::vector<Vector>& displacement) {
  return estimateError(comm, recoverStresses(comm, meshes, model, displacement));
}

}  // namespace suture
