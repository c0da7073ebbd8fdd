#include <suture/elasticity/ElasticSupports.hpp>
#include <suture/elasticity/NodalLoads.hpp>
#include <suture/quality/Findings.hpp>
#include <suture/quality/ModelForces.hpp>

namespace suture {

namespace {

void addSupports(const CellBlock& block, const SideGroups& groups, const ElasticModel& model, const Vector& displacement, OwnForces& all) {
  const ElasticSupports supports(block, groups, model);
  if (supports.empty()) return;
  const ElasticSupports::Forces forces = supports.forces(displacement);
  all.elements.internal += forces.nodal;
  all.elements.stiffness += forces.stiffness;
  all.supports = forces.onBody;
  all.supportMagnitudes = forces.magnitudes;
}

/// Initial states leave the rounding of their own forces, whatever the displacements are.
void addInitial(const Vector& forces, const Vector& sizes, int dimension, OwnForces& all) {
  for (Eigen::Index i = 0; i < forces.size(); ++i) {
    all.initial[i % dimension] += forces[i];
    all.elements.rounding[i / dimension] += unitRoundoff * sizes[i];
  }
}

}  // namespace

OwnForces modelForces(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement) {
  const auto materialOf = [&](int element) -> const Material& { return model.materialOf(mesh, element, mesh.body); };
  OwnForces all{elementForces(mesh, materialOf, model.plane, displacement), subdomainLoads(mesh, model)};
  addSupports(mesh, mesh.sideGroups, model, displacement, all);
  Vector sizes;
  addInitial(initialForces(mesh, model, &sizes), sizes, mesh.dimension, all);
  return all;
}

}  // namespace suture
