#include <suture/answer/error/ErrorNorms.hpp>
#include <suture/answer/error/ExactErrors.hpp>
#include <suture/answer/error/PressureField.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/motion/RigidMotionLifting.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>

#include <cmath>

namespace suture {

namespace {

BodyErrors errorsOf(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement) {
  return bodyErrors(
      mesh, model.exact.ofBody[mesh.body], [&](int e) -> const Material& { return model.materialOf(mesh, e, mesh.body); }, model.plane,
      displacement, InitialState(model, mesh.body));
}

SquaredNorms pressureErrors(const ContactSides& contacts, const std::vector<PairResult>& pairs, const Expression& exact) {
  SquaredNorms all;
  for (const auto& [contact, sides] : contacts.ofLine) {
    const std::map<GlobalId, double> field = pressureField(sides, contact, pairs, contacts.heldPairs);
    for (const ContactSide& side : sides) {
      Vector values = Vector::Zero(Eigen::Index(side.nodes.size()));
      for (std::size_t i = 0; i < side.nodes.size(); ++i)
        if (const auto found = field.find(side.nodes[i]); found != field.end()) values[Eigen::Index(i)] = found->second;
      all.add(sideErrors(side.points, side.dimension, values, exact, side.axisymmetric));
    }
  }
  return all;
}

void name(const std::string& what, double error, double exact, std::map<std::string, double>& errors) {
  errors[what] = std::sqrt(error);
  if (exact > 0.0) errors[what + "_relative"] = std::sqrt(error / exact);
}

}  // namespace

void checkExactSolution(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model, const Parameters& contact) {
  if (model.exact.empty()) return;
  collectively(comm, "checking the exact solution", [&] {
    for (const SubdomainMesh& mesh : meshes) errorsOf(mesh, model, Vector::Zero(Eigen::Index(mesh.coordinates.size())));
    if (!model.exact.pressure) return;
    for (const std::string& line : sublistNames(contact))
      for (const ContactSide& side : contactSidesHere(meshes, groupNames(contact.sublist(line), "Side A")))
        sideErrors(side.points, side.dimension, Vector::Zero(Eigen::Index(side.nodes.size())), *model.exact.pressure, side.axisymmetric);
  });
}

std::map<std::string, double> exactErrors(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                          const Parameters& contact, const std::vector<Vector>& displacement,
                                          const std::vector<PairResult>& pairs) {
  std::map<std::string, double> errors;
  if (model.exact.empty()) return errors;
  ContactSides lines;
  if (model.exact.pressure) lines = contactSides(comm, meshes, contact, pairs);
  BodyErrors bodies;
  SquaredNorms pressure;
  collectively(comm, "measuring the errors", [&] {
    for (std::size_t i = 0; i < meshes.size(); ++i) {
      const BodyErrors part = errorsOf(meshes[i], model, withLift(meshes[i], displacement[i]));
      bodies.displacement.add(part.displacement);
      bodies.energy.add(part.energy);
    }
    if (model.exact.pressure && comm.getRank() == 0) pressure = pressureErrors(lines, pairs, *model.exact.pressure);
  });

  const double mine[6] = {
      bodies.displacement.error, bodies.displacement.exact, bodies.energy.error, bodies.energy.exact, pressure.error, pressure.exact};
  double all[6];
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, 6, mine, all);
  if (model.exact.hasDisplacement()) name("displacement_l2", all[0], all[1], errors);
  if (model.exact.hasStress()) name("energy_norm", all[2], all[3], errors);
  if (model.exact.pressure) name("pressure_l2", all[4], all[5], errors);
  return errors;
}

}  // namespace suture
