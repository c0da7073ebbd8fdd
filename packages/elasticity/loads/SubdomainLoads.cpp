#include <suture/elasticity/loads/SubdomainLoads.hpp>

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

/// Adds the forces of one load; false if it does not act here.
bool addLoad(const SubdomainMesh& mesh, const ElasticModel& model, const Load& given, Vector& load) {
  if (!given.onBody()) {
    const std::vector<Side> sides = sidesOf(mesh.sideGroups, given.groups);
    addSideLoad(mesh, sides, given, load);
    return !sides.empty();
  }
  if (!given.actsOn(model.bodies[mesh.body])) return false;
  if (given.kind == Load::Kind::Random) {
    addRandomForces(mesh, given, load);
  } else {
    std::vector<int> all(mesh.elements());
    std::iota(all.begin(), all.end(), 0);
    addBodyForce(mesh, all, given, load);
  }
  return true;
}

}  // namespace

Vector subdomainLoads(const SubdomainMesh& mesh, const ElasticModel& model) {
  Vector load = Vector::Zero(Eigen::Index(mesh.nodes()) * mesh.dimension);
  for (const Load& given : model.loads) addLoad(mesh, model, given, load);
  return load;
}

void forEachLoad(const SubdomainMesh& mesh, const ElasticModel& model, const std::function<void(int number, const Vector& forces)>& take) {
  Vector load = Vector::Zero(Eigen::Index(mesh.nodes()) * mesh.dimension);
  for (std::size_t number = 0; number < model.loads.size(); ++number) {
    if (!addLoad(mesh, model, model.loads[number], load)) continue;
    take(static_cast<int>(number), load);
    load.setZero();
  }
}

}  // namespace suture
