#include <suture/base/Collective.hpp>
#include <suture/condensed/CondensedPairs.hpp>
#include <suture/condensed/CondensedProblem.hpp>
#include <suture/condensed/GroupPairs.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

CondensedPairs::CondensedPairs(const Comm& comm, const CondensedProblem& problem, const std::vector<std::unique_ptr<Subdomain>>& subdomains)
    : comm_(comm), problem_(problem) {
  std::map<int, double> stiffness;
  for (const auto& group : problem.groups()) {
    const Vector own = rowStiffness(*group);
    for (int row = 0; row < group->rows().size(); ++row) stiffness[group->rows().pairIds[row]] = own(row) > 0.0 ? own(row) : 1.0;
    for (const ContactPair& pair : group->idlePairs()) stiffness[pair.id] = 1.0;
  }
  bodies_ = std::make_unique<ContactBodies>(comm, subdomains, stiffness, problem.laws());
  const InterfaceSpace& space = *problem.space();
  partOfOwned_.assign(space.map()->getNodeNumElements(), 0);
  for (std::size_t s = 0; s < subdomains.size(); ++s)
    for (int dof = 0; dof < subdomains[s]->dofs(); ++dof)
      if (const auto at = space.map()->getLocalElement(subdomains[s]->globalDof(dof)); at >= 0)
        partOfOwned_[at] = bodies_->partOf(static_cast<int>(s));
  motions_ = std::make_unique<TraceMotions>(space, *bodies_, subdomains, partOfOwned_);
  rigid_ = &bodies_->rigid();
  sites_ = findSites();
}

std::vector<FrictionSite> CondensedPairs::findSites() const {
  Matrix mine = Matrix::Zero(rigid_->pairs(), kPairColumns);
  for (const auto& group : problem_.groups()) {
    const Vector rows = rowStiffness(*group);
    for (int i = 0; i < group->rows().size(); ++i) {
      std::array<double, 2> stiffness{0.0, 0.0};
      for (int component = 1; component <= 2; ++component)
        if (const int row = group->rows().rowOf(i, component); row >= 0) stiffness[static_cast<std::size_t>(component - 1)] = rows(row);
      putSite(group->pairs()[i], stiffness, mine, group->pairs()[i].id);
    }
  }
  return sitesFrom(everywhere(mine));
}

const ContactLaws& CondensedPairs::laws() const { return problem_.laws(); }

Matrix CondensedPairs::everywhere(const Matrix& mine) const {
  Matrix all = mine;
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

Vector CondensedPairs::ofGroup(int group, const Vector& ofPairs) const {
  const ContactRows& rows = problem_.groups()[group]->rows();
  Vector own(rows.size());
  for (int row = 0; row < rows.size(); ++row) own(row) = ofPairs(rows.pairIds[row]);
  return own;
}

ContactStates CondensedPairs::statusOf(const PairStates& pairs) const {
  ContactStates status(problem_.plain_.size());
  for (const auto& group : problem_.groups()) {
    const ContactRows& rows = group->rows();
    status.emplace_back();
    for (int i = 0; i < rows.size(); ++i)
      status.back().push_back(problem_.laws().of(rows.lines[i]).separates() ? pairs[rows.pairIds[i]] : rows.pressed[i]);
  }
  return status;
}

PairStates CondensedPairs::statesOf(const ContactStates& status) const {
  Matrix mine = Matrix::Zero(rigid_->pairs(), kPairColumns);
  for (std::size_t g = 0; g < problem_.groups().size(); ++g) {
    const std::vector<int>& ids = problem_.groups()[g]->rows().pairIds;
    for (std::size_t i = 0; i < ids.size(); ++i) putState(status[problem_.placeOfGroup(static_cast<int>(g))][i], mine, ids[i]);
  }
  return statesFrom(everywhere(mine));
}

PairValues CondensedPairs::valuesOf(const InterfaceState& state) const {
  Matrix out = Matrix::Zero(problem_.space()->overlapSize(), 1), mine = Matrix::Zero(rigid_->pairs(), kPairColumns);
  const double energy = problem_.addLinear(state, problem_.traces(*state.trace), out,
                                           [&](int group, const ContactGroup::Response& response, const Vector& moved) {
                                             const ContactGroup& own = *problem_.groups()[group];
                                             const std::vector<PairForces> pairs = pairForces(own, response, moved);
                                             for (std::size_t i = 0; i < pairs.size(); ++i)
                                               putPair(response.status[i], pairs[i], mine, own.rows().pairIds[i]);
                                           });
  const Matrix all = everywhere(mine);
  PairValues result;
  result.force = all.leftCols(3);
  result.jump = all.middleCols(3, 3);
  result.digits = all.col(6);
  result.residual = problem_.space()->vector();
  problem_.space()->scatterAdd(out, *result.residual);
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_SUM, energy, Teuchos::outArg(result.energy));
  result.energy -= rigidWork(state);
  return result;
}

PairStates CondensedPairs::proposal(const InterfaceState& state) const {
  if (problem_.isGiven()) return {};
  const std::vector<Vector> trace = problem_.traces(*state.trace);
  ContactStates next = state.status;
  double found = 1.0, all = 0.0;
  for (std::size_t g = 0; g < problem_.groups().size(); ++g) {
    const int number = static_cast<int>(g), place = problem_.placeOfGroup(number);
    try {
      next[place] = problem_.groups()[g]->respond(trace[place], state.status[place], movedRows(number, state)).status;
    } catch (const NumericalError&) {
      found = 0.0;  // round-off, far from the solution: use plain flips
    }
  }
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_MIN, found, Teuchos::outArg(all));
  if (all == 0.0) return {};
  return statesOf(next);
}

InterfaceState CondensedPairs::stateWith(const PairStates& pairs) const {
  InterfaceState state;
  state.trace = problem_.space()->vector();
  state.status = statusOf(pairs);
  return state;
}

void CondensedPairs::separate(InterfaceState& state) const { move(state, motions_->takeOut(*state.trace)); }

Vector CondensedPairs::movedRows(int group, const InterfaceState& state) const {
  if (state.rigid.size() == 0) return {};
  const RigidBodyModel::Pairs& data = rigid_->data();
  const ContactRows& rows = problem_.groups()[group]->rows();
  Vector moved = Vector::Zero(rows.rows.rows());
  for (std::size_t component = 0; component <= data.tangents.size(); ++component) {
    const Vector along = ofGroup(group, (component == 0 ? data.rows : data.tangents[component - 1]) * state.rigid);
    for (int pair = 0; pair < rows.size(); ++pair)
      if (const int row = rows.rowOf(pair, static_cast<int>(component)); row >= 0) moved(row) = along(pair);
  }
  return moved;
}

double CondensedPairs::rigidWork(const InterfaceState& state) const {
  return state.rigid.size() > 0 ? rigid_->data().work.dot(state.rigid) : 0.0;
}

/// Stores the energies, because they need a solve in each group.
int CondensedPairs::remember(InterfaceState& state) const {
  if (!state.memory) state.memory = std::make_shared<Matrix>(energies(state));
  return 0;
}

Vector CondensedPairs::energies(const InterfaceState& state) const {
  if (state.memory) return state.memory->col(0);
  const std::vector<Vector> trace = problem_.traces(*state.trace);
  Matrix mine = Matrix::Zero(static_cast<Eigen::Index>(bodies_->parts().size()), 1);
  collectively(comm_, "summing the energies of the bodies", [&] {
    problem_.addPlainEnergies(trace, [&](int subdomain, double energy) { mine(bodies_->partOf(subdomain), 0) += energy; });
    for (std::size_t g = 0; g < problem_.groups().size(); ++g) {
      const ContactGroup& group = *problem_.groups()[g];
      const int number = static_cast<int>(g), place = problem_.placeOfGroup(number);
      const ContactGroup::Response response =
          group.respondLinear(trace[place], problem_.linearised(number, state.status[place])->held(), movedRows(number, state));
      for (std::size_t m = 0; m < group.members().size(); ++m) {
        const std::vector<int>& at = group.positionsOf(static_cast<int>(m));
        const Vector values = response.displacement(at);
        mine(bodies_->partOf(problem_.membersOf(number)[m]), 0) += values.dot(group.members()[m].subdomain->stiffness() * values);
      }
    }
  });
  return everywhere(mine).col(0);
}

}  // namespace suture
