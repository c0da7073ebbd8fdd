#include <suture/base/Gather.hpp>
#include <suture/report/Summary.hpp>
#include <suture/simulation/CoupledScene.hpp>
#include <suture/simulation/LoadControl.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>

namespace suture {

namespace {

Scene withoutSteps(Scene scene) {
  if (!scene.steps.empty()) throw InputError("Load Steps", "not available in a coupled scene: the coupling program controls the steps");
  if (scene.accuracy) throw InputError("Accuracy/Error", "not available in a coupled scene: its surfaces belong to one mesh");
  if (hasControlledLoads(scene))
    throw InputError("coupling",
                     "a coupled scene cannot have a Mean Displacement or a Preload: their amounts are found for one set of loads only");
  return scene;
}

}  // namespace

CoupledScene::CoupledScene(RunContext run, Scene scene) : partitioned_(cut(read(std::move(run), withoutSteps(std::move(scene))))) {
  parts_ = partitioned_->parts_.get();
  parts_->path = std::make_unique<LoadPath>(parts_->run.comm(), parts_->scene.steps, parts_->cut.whole.prescribed);
}

CouplingSurface CoupledScene::surface(const std::string& group) {
  if (!partitioned_) throw InternalError("surface() after solve()");
  CouplingSurface surface = couplingSurface(parts_->run.comm(), parts_->cut.meshes, group);
  std::vector<Load>& loads = parts_->scene.model.loads;
  const std::string name = "coupling " + group;
  const auto known = std::find_if(loads.begin(), loads.end(), [&](const Load& load) { return load.name == name; });
  surface.load = static_cast<std::size_t>(known - loads.begin());
  if (known == loads.end()) {
    loads.emplace_back();
    loads.back().kind = Load::Kind::NodalForces;
    loads.back().name = name;
  }
  return surface;
}

/// The forces on a surface, among the loads of the scene. \throws InternalError  the surface is not from surface() of this scene
Load& CoupledScene::loadOf(const CouplingSurface& surface, const std::string& function) {
  std::vector<Load>& loads = parts_->scene.model.loads;
  bool isOwn = surface.load < loads.size() && loads[surface.load].name == "coupling " + surface.group;
  for (const CouplingSurface::Place& place : surface.places)
    isOwn = isOwn && place.mesh < static_cast<int>(parts_->cut.meshes.size()) && place.node < parts_->cut.meshes[place.mesh].nodes();
  const int mine = isOwn;
  int all = 0;
  Teuchos::reduceAll(parts_->run.comm(), Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
  if (all == 0) throw InternalError(function + "(): the surface is not from surface() of this scene");
  return loads[surface.load];
}

void CoupledScene::setForces(const CouplingSurface& surface, const std::vector<double>& forces) {
  loadOf(surface, "setForces").forces = valuesByNode(parts_->run.comm(), surface, forces, "forces");
}

void CoupledScene::setTractions(const CouplingSurface& surface, const std::vector<double>& tractions) {
  loadOf(surface, "setTractions").forces = consistentForces(parts_->run.comm(), parts_->cut.meshes, surface.group,
                                                            valuesByNode(parts_->run.comm(), surface, tractions, "tractions"));
}

void CoupledScene::setDisplacements(const CouplingSurface& surface, const std::vector<double>& displacements) {
  loadOf(surface, "setDisplacements");
  const std::map<GlobalId, Point> values = valuesByNode(parts_->run.comm(), surface, displacements, "displacements");
  const std::string path = "coupling '" + surface.group + "'";
  const auto take = [&](NodeRule& rule, GlobalId node) {
    const auto given = values.find(node);
    if (given == values.end()) return;
    for (int k = 0; k < 3; ++k)
      if (rule.fixed[k]) rule.value[k] = dot(rule.axes[k], given->second);
  };
  collectively(parts_->run.comm(), "taking displacements", [&] {
    for (SubdomainMesh& mesh : parts_->cut.meshes) {
      std::vector<char> inContact(mesh.nodes(), 0);
      for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) inContact[end.node] = 1;
      const RigidGroupNodes rigid(mesh.rigidGroups, mesh.dimension);
      for (NodeRule& rule : mesh.rules) {
        if (rigid.contains(rule.node) && values.count(mesh.globalNodes[rule.node]))
          throw InputError(path, "displacements cannot be prescribed at nodes of a Rigid Group; expected a group without them");
        if (inContact[rule.node] && values.count(mesh.globalNodes[rule.node]))
          throw InputError(path, "displacements cannot be prescribed at nodes in a contact; expected a group without contact nodes");
        take(rule, mesh.globalNodes[rule.node]);
      }
    }
    for (NodeRule& rule : parts_->constraints.rules) take(rule, rule.node);
  });
}

void CoupledScene::prepareScene() {
  PreparedScene prepared = prepare(check(std::move(*partitioned_)));
  partitioned_.reset();
  prepared.remark();
  prepared.startFrom("");
  owned_ = std::move(prepared.parts_);
  solver_.emplace(*parts_, std::move(prepared.method_), std::move(prepared.start_));
}

void CoupledScene::mustBeSolved(const std::string& function) const {
  if (!isSolved_) throw InternalError(function + "() before solve()");
}

const Solution& CoupledScene::solve(bool verified) {
  const bool isFirst = partitioned_.has_value();
  if (!isFirst && !solver_) throw InternalError("solve() of a coupled scene that was refused");
  if (isFirst) prepareScene();
  parts_->path->setTime(0.0, parts_->scene.model, parts_->cut.meshes, parts_->constraints);
  solution_ = solver_->solve(isSolved_ && solution_.converged ? &solution_ : nullptr, isFirst);
  isSolved_ = true;
  isJudged_ = false;
  return verified ? verify() : solution_;
}

const Solution& CoupledScene::verify() {
  mustBeSolved("verify");
  if (!isJudged_) judgeSolution(*parts_, solver_->method().subdomains(), solution_);
  isJudged_ = true;
  return solution_;
}

void CoupledScene::advance() {
  mustBeSolved("advance");
  parts_->path->accept(solution_.pairs, solution_.verification.forces);
}

std::vector<double> CoupledScene::displacements(const CouplingSurface& surface) const {
  std::vector<double> all;
  for (const CouplingSurface::Place& place : surface.places)
    for (int k = 0; k < surface.dimension; ++k)
      all.push_back(isSolved_
                        ? meshes()[static_cast<std::size_t>(place.mesh)].total(solution_.displacement[static_cast<std::size_t>(place.mesh)],
                                                                               Eigen::Index(place.node) * surface.dimension + k)
                        : 0.0);
  return all;
}

std::string CoupledScene::summary(const Invocation& invocation) const {
  if (!isJudged_) throw InternalError("summary() before verify()");
  const Run run = runOf(*parts_, solution_, invocation);
  return summaryText(run, runFigures(run), ending());
}

}  // namespace suture
