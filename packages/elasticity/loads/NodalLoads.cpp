#include <suture/base/Errors.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>

namespace suture {

Vector nodalLoads(const Mesh& mesh, const ElasticModel& model) {
  Vector forces = Vector::Zero(Eigen::Index(mesh.nodes()) * mesh.dimension);
  for (const Load& load : model.loads) {
    if (load.kind == Load::Kind::Random) {
      for (int i = 0; i < mesh.nodes(); ++i)
        if (load.actsOn(mesh.bodies[mesh.bodyOfNode[i]]))
          for (int k = 0; k < mesh.dimension; ++k) forces[Eigen::Index(i) * mesh.dimension + k] += randomForce(load, i, k);
    } else if (load.kind == Load::Kind::BodyForce) {
      std::vector<int> elements;
      for (int e = 0; e < mesh.elements(); ++e)
        if (load.actsOn(mesh.bodies[mesh.bodyOfElement[e]])) elements.push_back(e);
      addBodyForce(mesh, elements, load, forces);
    } else {
      for (const std::string& group : load.groups)
        if (!mesh.sideGroups.count(group)) throw InternalError("a load on the group '" + group + "', which the mesh does not have");
      addSideLoad(mesh, sidesOf(mesh.sideGroups, load.groups), load, forces);
    }
  }
  return forces;
}

}  // namespace suture
