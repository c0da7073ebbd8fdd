#include <suture/base/Numbers.hpp>
#include <suture/solver/accuracy/RequestedAccuracy.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

bool refinesMesh(const Parameters& settings) {
  return settings.isSublist("Accuracy") && parseReal(settings.sublist("Accuracy").get<std::string>("Error"));
}

bool isAutomatic(const Parameters& scene) { return scene.sublist("Outer Solver").get<std::string>("Tolerance") == "Automatic"; }

double requestedAccuracy(const Parameters& scene, const Solution& solution) {
  if (!isAutomatic(scene)) return std::stod(scene.sublist("Outer Solver").get<std::string>("Tolerance"));
  if (!solution.discretisation) return AutomaticTolerance::kTightest;
  return AutomaticTolerance::toleranceFor(solution.discretisation->relative());
}

AutomaticTolerance::Estimate discretisationErrorOf(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                                   const Subdomains& subdomains) {
  double unknowns = 0.0, all = 0.0;
  int order = 1, highest = 1;
  for (const auto& subdomain : subdomains) unknowns += subdomain->dofs();
  for (const SubdomainMesh& mesh : meshes)
    for (const Cell cell : mesh.cells) order = std::max(order, cellInfo(cell).order);
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, unknowns, Teuchos::outArg(all));
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, order, Teuchos::outArg(highest));
  const auto of = [&](const std::vector<Vector>& freeValues) {
    std::vector<Vector> displacement;
    for (std::size_t i = 0; i < subdomains.size(); ++i) displacement.push_back(subdomains[i]->cartesian(freeValues[i]));
    return estimateError(comm, meshes, model, displacement);
  };
  const double nodes = std::max(all / model.dimension, 1.0), size = std::pow(nodes, -1.0 / model.dimension);
  return {of, highest == 1 ? 3.0 * size : 6.0 * size * size};
}

}  // namespace suture
