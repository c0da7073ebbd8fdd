#include <suture/base/Errors.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>

#include <algorithm>
#include <functional>

namespace suture {

namespace {

/// A block of elements with the numbering that the loads need.
struct Loaded {
  const CellBlock& block;
  const SideGroups& groups;
  std::function<int(int element)> bodyOf;
  std::function<bool(int node)> counts;  ///< true if the block carries the forces on the node
  std::function<GlobalId(int node)> numberOf;
  std::function<int(int node)> bodyOfNode;
};

bool addElementLoad(const Loaded& on, const ElasticModel& model, const Load& load, Vector& forces) {
  std::vector<int> elements;
  for (int e = 0; e < on.block.elements(); ++e)
    if (load.actsOn(model.bodies[on.bodyOf(e)])) elements.push_back(e);
  if (elements.empty()) return false;
  const auto density = [&](int e) {
    const std::optional<double>& known = model.materialOf(on.block, e, on.bodyOf(e)).density;
    if (!known) throw InternalError("a " + nameOf(load.kind) + " on a material without density");
    return *known;
  };
  addBodyForce(on.block, elements, load, forces, density);
  return true;
}

void addGivenForces(const Loaded& on, const Load& load, Vector& forces) {
  const int dimension = on.block.dimension;
  for (int node = 0; node < on.block.nodes(); ++node) {
    const auto given = load.forces.find(on.numberOf(node));
    if (given == load.forces.end() || !on.counts(node)) continue;
    for (int k = 0; k < dimension; ++k) forces[Eigen::Index(node) * dimension + k] += load.factor * given->second[k];
  }
}

bool addNodeLoad(const Loaded& on, const ElasticModel& model, const Load& load, Vector& forces) {
  const int dimension = on.block.dimension;
  bool acts = false;
  for (int node = 0; node < on.block.nodes(); ++node) {
    if (!on.counts(node) || !load.actsOn(model.bodies[on.bodyOfNode(node)])) continue;
    for (int k = 0; k < dimension; ++k) forces[Eigen::Index(node) * dimension + k] += nodeForce(load, on.numberOf(node), k);
    acts = true;
  }
  return acts;
}

bool addSidesLoad(const Loaded& on, const Load& load, Vector& forces) {
  const std::vector<Side> sides = sidesOf(on.groups, load.groups);
  addSideLoad(on.block, sides, load, forces);
  return !sides.empty();
}

/// Adds the forces of one load; false if it does not act here, or is an initial state.
bool addLoad(const Loaded& on, const ElasticModel& model, const Load& load, Vector& forces) {
  if (load.isInitial()) return false;
  if (load.kind == Load::Kind::NodalForces) return addGivenForces(on, load, forces), true;
  if (load.onNodes()) return addNodeLoad(on, model, load, forces);
  return load.onElements() ? addElementLoad(on, model, load, forces) : addSidesLoad(on, load, forces);
}

Vector initialOn(const CellBlock& block, const std::function<int(int element)>& bodyOf, const ElasticModel& model, Vector* sizes) {
  const auto materialOf = [&](int e) -> const Material& { return model.materialOf(block, e, bodyOf(e)); };
  return initialForces(block, materialOf, model.plane, InitialState(model, bodyOf), sizes);
}

Vector loadsOn(const Loaded& on, const ElasticModel& model) {
  Vector forces = Vector::Zero(Eigen::Index(on.block.nodes()) * on.block.dimension);
  for (const Load& load : model.loads) addLoad(on, model, load, forces);
  const Vector initial = initialOn(on.block, on.bodyOf, model, nullptr);
  if (initial.size() > 0) forces += initial;
  return forces;
}

Loaded loadedOf(const SubdomainMesh& mesh) {
  const auto first = [&mesh](int node) {
    const auto others = mesh.others(node);
    return std::none_of(others.begin(), others.end(), [&](int other) { return other < mesh.id; });
  };
  const auto body = [&mesh](int) { return mesh.body; };
  return {mesh, mesh.sideGroups, body, first, [&mesh](int node) { return mesh.globalNodes[node]; }, body};
}

}  // namespace

Vector nodalLoads(const Mesh& mesh, const ElasticModel& model) {
  for (const Load& load : model.loads)
    for (const std::string& group : load.groups)
      if (!mesh.sideGroups.count(group)) throw InternalError("a load on the group '" + group + "', which the mesh does not have");
  return loadsOn({mesh, mesh.sideGroups, [&](int e) { return mesh.bodyOfElement[e]; }, [](int) { return true; },
                  [](int node) { return GlobalId(node); }, [&](int node) { return mesh.bodyOfNode[node]; }},
                 model);
}

Vector subdomainLoads(const SubdomainMesh& mesh, const ElasticModel& model) { return loadsOn(loadedOf(mesh), model); }

void forEachLoad(const SubdomainMesh& mesh, const ElasticModel& model, const std::function<void(int number, const Vector& forces)>& take) {
  const Loaded on = loadedOf(mesh);
  Vector forces = Vector::Zero(Eigen::Index(mesh.nodes()) * mesh.dimension);
  for (std::size_t number = 0; number < model.loads.size(); ++number) {
    if (!addLoad(on, model, model.loads[number], forces)) continue;
    take(static_cast<int>(number), forces);
    forces.setZero();
  }
}

Vector initialForces(const Mesh& mesh, const ElasticModel& model, Vector* sizes) {
  return initialOn(
      mesh, [&](int e) { return mesh.bodyOfElement[e]; }, model, sizes);
}

Vector initialForces(const SubdomainMesh& mesh, const ElasticModel& model, Vector* sizes) {
  return initialOn(
      mesh, [&](int) { return mesh.body; }, model, sizes);
}

}  // namespace suture
