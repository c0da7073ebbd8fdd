#include <suture/answer/verdict/Findings.hpp>
#include <suture/answer/verdict/NodalForces.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/elasticity/loads/ElasticSupports.hpp>
#include <suture/elasticity/loads/NodalLoads.hpp>

#include <Teuchos_CommHelpers.hpp>

#include <cmath>
#include <map>

namespace suture {

namespace {

using PairForces = std::map<int, PairForce>;

PairForces forcesOfPairs(const Comm& comm, const std::vector<PairResult>& pairs) {
  std::vector<PairForce> forces;
  for (const PairResult& pair : pairs) forces.push_back({pair.id, pair.state, pair.force, pair.tangential});
  broadcast(comm, forces);
  PairForces all;
  for (const PairForce& pair : forces) all[pair.id] = pair;
  return all;
}

void addContact(const SubdomainMesh& mesh, const PairForces& forces, Matrix& nodes, Balance& balance) {
  std::map<int, const ContactPair*> pairs;
  for (const ContactRow& row : mesh.contactRows) pairs[row.pair.id] = &row.pair;
  for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
    if (!counts(mesh, end.node)) continue;
    const ContactPair& pair = *pairs.at(end.pair);
    const auto found = forces.find(end.pair);
    if (found == forces.end()) continue;  // reported by verifyPairs()
    const PairForce& said = found->second;
    const double weight = pair.ends[end.end].weight;
    double* sum = nodes.col(end.node).data() + NodalRows{mesh.dimension}.contact();
    for (int k = 0; k < mesh.dimension; ++k) sum[k] -= said.force * weight * pair.normal[k] + weight * said.tangential[k];
    if (end.end == 0) balance.addPair(pair, plus(scaled(said.force, pair.normal), said.tangential));
  }
}

void addSupports(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement, OwnForces& all, Reactions& reactions) {
  const ElasticSupports supports(mesh, mesh.sideGroups, model);
  if (supports.empty()) return;
  const ElasticSupports::Forces forces = supports.forces(displacement);
  all.supports = -forces.nodal;
  all.elements.internal += forces.nodal;
  all.elements.stiffness += forces.stiffness;
  all.elements.rounding += forces.rounding;
  supports.forEachSupport(displacement, [&](int number, const Vector& own) { reactions.addSpring(mesh, number, own); });
}

/// Adds forces and round-off of initial states, which have round-off independent of the displacements.
void addInitial(const SubdomainMesh& mesh, const ElasticModel& model, OwnForces& all) {
  Vector sizes;
  const Vector forces = initialForces(mesh, model, &sizes);
  if (forces.size() == 0) return;
  all.load += forces;
  for (Eigen::Index i = 0; i < forces.size(); ++i) {
    all.initial[i % mesh.dimension] += forces[i];
    all.elements.rounding[i / mesh.dimension] += unitRoundoff * sizes[i];
  }
}

/// Forces of the model's materials, loads and supports, by loops over elements and sides.
OwnForces modelForces(const SubdomainMesh& mesh, const ElasticModel& model, const Vector& displacement, Reactions& reactions) {
  const auto materialOf = [&](int element) -> const Material& { return model.materialOf(mesh, element, mesh.body); };
  OwnForces all{elementForces(mesh, materialOf, model.plane, displacement), Vector::Zero(Eigen::Index(mesh.nodes()) * mesh.dimension)};
  forEachLoad(mesh, model, [&](int number, const Vector& forces) {
    all.load += forces;
    if (!model.loads[static_cast<std::size_t>(number)].isCorrection) reactions.addLoad(mesh, number, forces);
  });
  addSupports(mesh, model, displacement, all, reactions);
  addInitial(mesh, model, all);
  return all;
}

OwnForces forcesOf(const Answer& answer, int i, Reactions& reactions) {
  const SubdomainMesh& mesh = answer.meshes[i];
  if (std::optional<OwnForces> own = answer.own ? answer.own(i) : std::nullopt) {
    reactions.addOwn(mesh, own->load);
    return std::move(*own);
  }
  return modelForces(mesh, answer.model, answer.displacement[i], reactions);
}

/// Part of a subdomain in the sums at masters. \param nodes  NodalRows x nodes, of this subdomain alone
Matrix sumsAtMasters(const SubdomainMesh& mesh, const Matrix& nodes) {
  const NodalRows rows{mesh.dimension};
  const MasterRows sums{mesh.dimension};
  Matrix all = Matrix::Zero(sums.count(), mesh.nodes());
  const RigidGroupNodes rigid(mesh.rigidGroups, mesh.dimension);
  for (const RigidGroup& group : mesh.rigidGroups)
    for (const int node : group.nodes)
      for (int k = 0; k < mesh.dimension; ++k) {
        double rest = 0.0;
        for (int c = 0; c < mesh.dimension; ++c)
          rest += group.axes[static_cast<std::size_t>(k)][static_cast<std::size_t>(c)] *
                  (nodes(rows.applied() + c, node) + nodes(rows.contact() + c, node) - nodes(rows.internal() + c, node));
        rigid.forEachMaster(node, k, [&](int master, int component, double coefficient) {
          for (int c = 0; c < mesh.dimension; ++c)
            all(sums.rest() + c, master) += coefficient * rest * rigid.axis(master, component)[static_cast<std::size_t>(c)];
          all(sums.rounding(), master) += std::abs(coefficient) * nodes(rows.rounding(), node);
          all(sums.stiffness(), master) += coefficient * coefficient * nodes(rows.stiffness(), node);
        });
      }
  return all;
}

bool hasRigidGroups(const Comm& comm, const std::vector<SubdomainMesh>& meshes) {
  int mine = 0, all = 0;
  for (const SubdomainMesh& mesh : meshes) mine = mine || !mesh.rigidGroups.empty();
  Teuchos::reduceAll(comm, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  return all > 0;
}

}  // namespace

NodalForces nodalForces(const Comm& comm, const Answer& answer, const SeamExchange& seams) {
  const PairForces pairs = forcesOfPairs(comm, answer.pairs);
  NodalForces all;
  collectively(comm, "verifying the solution", [&] {
    for (std::size_t i = 0; i < answer.meshes.size(); ++i) {
      const SubdomainMesh& mesh = answer.meshes[i];
      const OwnForces forces = forcesOf(answer, static_cast<int>(i), all.reactions);
      const ElementForces& elements = forces.elements;
      const Vector& load = forces.load;
      all.balance.addSupports(forces.supports, mesh.dimension);
      all.balance.leaveOut(forces.initial);
      const int d = mesh.dimension;
      const NodalRows rows{d};
      Matrix& own = all.nodes.emplace_back(rows.count(), mesh.nodes());
      own.middleRows(rows.internal(), d) = Eigen::Map<const Matrix>(elements.internal.data(), d, mesh.nodes());
      own.middleRows(rows.applied(), d) = Eigen::Map<const Matrix>(load.data(), d, mesh.nodes());
      own.middleRows(rows.contact(), d).setZero();
      own.row(rows.rounding()) = elements.rounding.transpose();
      own.row(rows.stiffness()) = elements.stiffness.transpose();
      addContact(mesh, pairs, own, all.balance);
    }
  });
  all.hasRigidGroups = hasRigidGroups(comm, answer.meshes);
  if (all.hasRigidGroups) {
    for (std::size_t i = 0; i < answer.meshes.size(); ++i) all.masters.push_back(sumsAtMasters(answer.meshes[i], all.nodes[i]));
    seams.sum(all.masters);
  }
  seams.sum(all.nodes);
  for (std::size_t i = 0; i < answer.meshes.size(); ++i) {
    const NodalRows rows{answer.meshes[i].dimension};
    all.reactions.addSupports(answer.meshes[i], [&](int node) {
      const double* sums = all.nodes[i].col(node).data();
      Point force{0, 0, 0};
      for (int k = 0; k < rows.dimension; ++k) force[k] = sums[rows.internal() + k] - sums[rows.applied() + k] - sums[rows.contact() + k];
      return force;
    });
  }
  return all;
}

}  // namespace suture
