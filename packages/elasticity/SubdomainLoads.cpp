#include <suture/elasticity/SubdomainLoads.hpp>

#include <algorithm>
#include <numeric>

namespace suture {

namespace {

// The first subdomain that holds a node carries its force: the sum over all subdomains has it exactly once.
void addRandomForces(const SubdomainMesh& mesh, const Load& given, Vector& load) {
  for (int node = 0; node < mesh.nodes(); ++node) {
    const auto others = mesh.others(node);
    if (std::any_of(others.begin(), others.end(), [&](int other) { return other < mesh.id; })) continue;
    for (int k = 0; k < mesh.dimension; ++k) load(node * mesh.dimension + k) += randomForce(given, mesh.globalNodes[node], k);
  }
}

}  // namespace

Vector subdomainLoads(const SubdomainMesh& mesh, const ElasticModel& model) {
  Vector load = Vector::Zero(Eigen::Index(mesh.nodes()) * mesh.dimension);
  std::vector<int> all(mesh.elements());
  std::iota(all.begin(), all.end(), 0);
  for (const Load& given : model.loads) {
    if (given.onBody()) {
      if (!given.actsOn(model.bodies[mesh.body])) continue;
      if (given.kind == Load::Kind::Random)
        addRandomForces(mesh, given, load);
      else
        addBodyForce(mesh, all, given, load);
    } else {
      addSideLoad(mesh, sidesOf(mesh.sideGroups, given.groups), given, load);
    }
  }
  return load;
}

}  // namespace suture
