#include <suture/answer/values/ControlledLoads.hpp>
#include <suture/base/Collective.hpp>
#include <suture/elasticity/ElementStress.hpp>
#include <suture/elasticity/SideMap.hpp>
#include <suture/mesh/SideGroups.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <algorithm>

namespace suture {

namespace {

/// Integral over groups of the displacement along an axis, and their size.
struct Mean {
  double integral = 0.0, size = 0.0;
};

void addSides(const SubdomainMesh& mesh, const Vector& displacement, const Load& load, Mean& mean) {
  const Point axis = unit(load.axis);
  for (const Side& side : sidesOf(mesh.sideGroups, load.groups)) {
    const std::vector<int> nodes = mesh.nodesOf(side);
    std::vector<Point> points;
    for (const int node : nodes) points.push_back(mesh.point(node));
    SideMap map(points, mesh.dimension, Rule::Load, mesh.axisymmetric);
    const ReferenceElement& reference = map.reference();
    for (int q = 0; q < reference.points; ++q) {
      map.at(q);
      mean.size += map.measure();
      for (int a = 0; a < reference.nodes; ++a)
        for (int k = 0; k < mesh.dimension; ++k)
          mean.integral += map.measure() * reference.valuesAt(q)[a] * axis[k] * mesh.total(displacement, nodes[a] * mesh.dimension + k);
    }
  }
}

/// Integral of axis . stress . axis over the part of a mesh on which a load acts.
template <int D>
double axialStress(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement, const Load& load) {
  const InitialState initial(model, mesh.body);
  StressVector<D> along;  // every shear stress counts twice
  for (int k = 0; k < stressComponents<D>; ++k) {
    const auto [i, j] = kStressAxes[k];
    along[k] = (i == j ? 1.0 : 2.0) * load.axis[std::size_t(i)] * load.axis[std::size_t(j)];
  }
  double sum = 0.0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const HookesLaw<D> law(model.materialOf(mesh, e, mesh.body), model.plane);
    const ReferenceElement& reference = referenceElement(mesh.cells[e], stiffnessRule(mesh));
    ElementStress<D> element(mesh, e, reference, law, displacement, initial);
    for (int q = 0; q < reference.points; ++q) {
      element.at(q);
      if (load.covers(element.map().place())) sum += element.map().measure() * along.dot(element.stress());
    }
  }
  return sum;
}

double overRanks(const Comm& comm, Teuchos::EReductionType how, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(comm, how, mine, Teuchos::outArg(all));
  return all;
}

}  // namespace

double controlledValue(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                       const std::vector<Vector>& displacement, const Load& load) {
  Mean mean;
  double force = 0.0;
  collectively(comm, "measuring a controlled load", [&] {
    for (std::size_t i = 0; i < meshes.size(); ++i)
      if (load.control == Load::Control::MeanDisplacement)
        addSides(meshes[i], displacement[i], load, mean);
      else if (load.actsOn(model.bodies[meshes[i].body]))
        force += (meshes[i].dimension == 2 ? axialStress<2> : axialStress<3>)(meshes[i], model, displacement[i], load) / load.length;
  });
  if (load.control == Load::Control::SectionForce) return overRanks(comm, Teuchos::REDUCE_SUM, force);
  return overRanks(comm, Teuchos::REDUCE_SUM, mean.integral) / overRanks(comm, Teuchos::REDUCE_SUM, mean.size);
}

double controlledSlope(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Load& load) {
  std::vector<Vector> still;
  double young = 0.0;
  Point high{-1e300, -1e300, -1e300}, low = high;  // low: negated
  for (const SubdomainMesh& mesh : meshes) {
    still.push_back(Vector::Zero(Eigen::Index(mesh.nodes()) * mesh.dimension));
    for (int e = 0; e < mesh.elements(); ++e) young = std::max(young, model.materialOf(mesh, e, mesh.body).young);
    for (int node = 0; node < mesh.nodes(); ++node)
      for (int k = 0; k < 3; ++k) {
        high[k] = std::max(high[k], mesh.point(node)[k]);
        low[k] = std::max(low[k], -mesh.point(node)[k]);
      }
  }
  if (load.control == Load::Control::SectionForce) {
    ElasticModel alone = model;
    alone.loads = {load};
    alone.loads[0].setAmount(1.0);
    return controlledValue(comm, meshes, alone, still, load);
  }
  double extent = 0.0;
  for (int k = 0; k < 3; ++k)
    extent = std::max(extent, overRanks(comm, Teuchos::REDUCE_MAX, high[k]) + overRanks(comm, Teuchos::REDUCE_MAX, low[k]));
  const double thickness = model.axisymmetric || model.dimension == 3 ? extent : 1.0;
  return 1.0 / (overRanks(comm, Teuchos::REDUCE_MAX, young) * thickness);
}

}  // namespace suture
