// Simulation coupled to another program: loads from outside, repeated solves.
#include <suture/base/Gather.hpp>
#include <suture/simulation/LoadControl.hpp>
#include <suture/simulation/Simulation.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>

namespace suture {

CouplingSurface Simulation::coupling(const std::string& group) {
  order_.require(StageOrder::Nothing, StageOrder::Checked, "coupling");
  if (!scene_.steps.empty()) throw InputError("Load Steps", "not available in a coupled scene: the coupling program controls the steps");
  if (hasControlledLoads(scene_))
    throw InputError("coupling '" + group + "'",
                     "a coupled scene cannot have a Mean Displacement or a Preload: their amounts are found for one set of loads only");
  if (!order_.has(StageOrder::Read)) read();
  if (!order_.has(StageOrder::Cut)) cut();
  CouplingSurface surface = couplingSurface(*comm_, cut_.meshes, group);
  std::vector<Load>& loads = scene_.model.loads;
  const std::string name = "coupling " + group;
  const auto known = std::find_if(loads.begin(), loads.end(), [&](const Load& load) { return load.name == name; });
  surface.load = static_cast<std::size_t>(known - loads.begin());
  if (known == loads.end()) {
    loads.emplace_back();
    loads.back().kind = Load::Kind::NodalForces;
    loads.back().name = name;
  }
  if (!path_) path_ = std::make_unique<LoadPath>(*comm_, scene_.steps, cut_.whole.prescribed);
  return surface;
}

/// The forces on a surface, among the loads of the scene. \throws InternalError  the surface is not from coupling() of this simulation
Load& Simulation::loadOf(const CouplingSurface& surface, const std::string& function) {
  std::vector<Load>& loads = scene_.model.loads;
  bool isOwn = surface.load < loads.size() && loads[surface.load].name == "coupling " + surface.group;
  for (const CouplingSurface::Place& place : surface.places)
    isOwn = isOwn && place.mesh < static_cast<int>(cut_.meshes.size()) && place.node < cut_.meshes[place.mesh].nodes();
  const int mine = isOwn;
  int all = 0;
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  if (all == 0) throw InternalError(function + "(): the surface is not from coupling() of this simulation");
  return loads[surface.load];
}

void Simulation::setForces(const CouplingSurface& surface, const std::vector<double>& forces) {
  loadOf(surface, "setForces").forces = valuesByNode(*comm_, surface, forces, "forces");
}

void Simulation::setTractions(const CouplingSurface& surface, const std::vector<double>& tractions) {
  loadOf(surface, "setTractions").forces =
      consistentForces(*comm_, cut_.meshes, surface.group, valuesByNode(*comm_, surface, tractions, "tractions"));
}

void Simulation::setDisplacements(const CouplingSurface& surface, const std::vector<double>& displacements) {
  loadOf(surface, "setDisplacements");
  const std::map<GlobalId, Point> values = valuesByNode(*comm_, surface, displacements, "displacements");
  const std::string path = "coupling '" + surface.group + "'";
  const auto take = [&](NodeRule& rule, GlobalId node) {
    const auto given = values.find(node);
    if (given == values.end()) return;
    for (int k = 0; k < 3; ++k)
      if (rule.fixed[k]) rule.value[k] = dot(rule.axes[k], given->second);
  };
  collectively(*comm_, "taking displacements", [&] {
    for (SubdomainMesh& mesh : cut_.meshes) {
      std::vector<char> inContact(mesh.nodes(), 0);
      for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) inContact[end.node] = 1;
      for (NodeRule& rule : mesh.rules) {
        if (inContact[rule.node] && values.count(mesh.globalNodes[rule.node]))
          throw InputError(path, "displacements cannot be prescribed at nodes in a contact; expected a group without contact nodes");
        take(rule, mesh.globalNodes[rule.node]);
      }
    }
    for (NodeRule& rule : constraints_.rules) take(rule, rule.node);
  });
}

const Solution& Simulation::solveAgain(bool verified) {
  if (!isCoupled()) throw InternalError("solveAgain() without coupling()");
  order_.require(StageOrder::Cut, StageOrder::Solved, "solveAgain");
  const bool isFirst = !order_.has(StageOrder::Prepared);
  if (isFirst) {
    if (!order_.has(StageOrder::Checked)) check();
    prepare();
    remark();
    start();
  }
  path_->setTime(0.0, scene_.model, cut_.meshes, constraints_);
  solution_ = solveFrom(order_.has(StageOrder::Solved) && solution_.converged ? &solution_ : nullptr, isFirst);
  order_.reach(StageOrder::Solved);
  isJudged_ = false;
  return verified ? verify() : solution_;
}

const Solution& Simulation::verify() {
  order_.require(StageOrder::Solved, StageOrder::Solved, "verify");
  if (!isJudged_) judge(solution_, method_->subdomains());
  isJudged_ = true;
  return solution_;
}

void Simulation::advance() {
  if (!isCoupled()) throw InternalError("advance() without coupling()");
  order_.require(StageOrder::Solved, StageOrder::Solved, "advance");
  path_->accept(solution_.pairs, solution_.verification.forces);
}

std::vector<double> Simulation::displacements(const CouplingSurface& surface) const {
  std::vector<double> all;
  const bool isSolved = order_.has(StageOrder::Solved);
  for (const CouplingSurface::Place& place : surface.places)
    for (int k = 0; k < surface.dimension; ++k)
      all.push_back(
          isSolved ? cut_.meshes[place.mesh].total(solution_.displacement[place.mesh], Eigen::Index(place.node) * surface.dimension + k)
                   : 0.0);
  return all;
}

}  // namespace suture
