#include <suture/base/Collective.hpp>
#include <suture/condensed/CondensedProblem.hpp>
#include <suture/condensed/CondensedSets.hpp>
#include <suture/condensed/GroupPairs.hpp>
#include <suture/interface/PlainFlips.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>

namespace suture {

CondensedSets::CondensedSets(const Comm& comm, const CondensedProblem& problem, const std::vector<std::unique_ptr<Subdomain>>& subdomains)
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
}

Matrix CondensedSets::everywhere(const Matrix& mine) const {
  Matrix all = mine;
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

Vector CondensedSets::ofGroup(int group, const Vector& ofPairs) const {
  const ContactRows& rows = problem_.groups()[group]->rows();
  Vector own(rows.size());
  for (int row = 0; row < rows.size(); ++row) own(row) = ofPairs(rows.pairIds[row]);
  return own;
}

ContactStates CondensedSets::statusOf(const ClosedSet& closed) const {
  ContactStates status = problem_.initialState().status;
  for (std::size_t g = 0; g < problem_.groups().size(); ++g) {
    const ContactRows& rows = problem_.groups()[g]->rows();
    for (int row = 0; row < rows.size(); ++row)
      status[problem_.placeOfGroup(static_cast<int>(g))][row] =
          closed[rows.pairIds[row]] || !problem_.laws().of(rows.lines[row]).separates() ? rows.pressed[row] : ContactState();
  }
  return status;
}

ClosedSet CondensedSets::closedSet(const ContactStates& status) const {
  Matrix mine = Matrix::Zero(bodies_->rigid().pairs(), 1);
  for (std::size_t g = 0; g < problem_.groups().size(); ++g) {
    const ContactRows& rows = problem_.groups()[g]->rows();
    for (int row = 0; row < rows.size(); ++row)
      mine(rows.pairIds[row], 0) = status[problem_.placeOfGroup(static_cast<int>(g))][row].closed();
  }
  const Matrix all = everywhere(mine);
  ClosedSet set(all.rows(), 0);
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = all(static_cast<Eigen::Index>(i), 0) != 0.0;
  return set;
}

InterfaceEvaluation CondensedSets::evaluateSet(const InterfaceState& state, PairResolution resolution) const {
  const int pairs = bodies_->rigid().pairs();
  const std::vector<Vector> trace = problem_.traces(*state.trace);
  Matrix out = Matrix::Zero(problem_.space()->overlapSize(), 1);
  Matrix mine = Matrix::Zero(pairs, 3);  // forces, penetrations, round-off of penetrations
  InterfaceEvaluation result;
  const double energy = problem_.addLinear(state, trace, out, [&](int group, const ContactGroup::Response& response, const Vector& moved) {
    const ContactGroup& own = *problem_.groups()[group];
    const std::vector<PairForces> pairs = pairForces(own, response, moved);
    for (int row = 0; row < own.rows().size(); ++row) {
      const PairForces& pair = pairs[row];
      const bool closed = response.status[row].closed();
      const int id = own.rows().pairIds[row];
      mine(id, 0) = closed ? pair.normal : 0.0;
      mine(id, 1) = closed ? 0.0 : -pair.gap;
      mine(id, 2) = kGapDigits * pair.digits;
    }
  });
  const Matrix all = everywhere(mine);
  const RigidBodyModel& rigid = bodies_->rigid();
  const ClosedSet closed = closedSet(state.status);
  result.force = all.col(0);
  result.penetration = all.col(1);
  result.next = statusOf(plainFlips(rigid, problem_.laws(), closed, resolution, all.col(2), result));
  result.residual = problem_.space()->vector();
  problem_.space()->scatterAdd(out, *result.residual);
  double total = 0.0;
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_SUM, energy, Teuchos::outArg(total));
  result.energy = total - rigidWork(state);
  return result;
}

ClosedSet CondensedSets::proposal(const InterfaceState& state) const {
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
  return closedSet(next);
}

InterfaceState CondensedSets::padState() const {
  RigidBodyModel& rigid = bodies_->rigid();
  InterfaceState state;
  state.trace = problem_.space()->vector();
  state.status = statusOf(rigid.start());
  move(state, rigid.project(rigid.data().penetration).motion);
  return state;
}

void CondensedSets::move(InterfaceState& state, const Vector& motion) const {
  if (motion.size() == 0 || motion.isZero(0.0)) return;
  if (state.rigid.size() == 0) state.rigid = Vector::Zero(motion.size());
  state.rigid += motion;
}

void CondensedSets::separate(InterfaceState& state) const { move(state, motions_->takeOut(*state.trace)); }

Vector CondensedSets::movedRows(int group, const InterfaceState& state) const {
  if (state.rigid.size() == 0) return {};
  const RigidBodyModel::Pairs& data = bodies_->rigid().data();
  const ContactRows& rows = problem_.groups()[group]->rows();
  Vector moved = Vector::Zero(rows.rows.rows());
  for (std::size_t component = 0; component <= data.tangents.size(); ++component) {
    const Vector along = ofGroup(group, (component == 0 ? data.rows : data.tangents[component - 1]) * state.rigid);
    for (int pair = 0; pair < rows.size(); ++pair)
      if (const int row = rows.rowOf(pair, static_cast<int>(component)); row >= 0) moved(row) = along(pair);
  }
  return moved;
}

double CondensedSets::rigidWork(const InterfaceState& state) const {
  return state.rigid.size() > 0 ? bodies_->rigid().data().work.dot(state.rigid) : 0.0;
}

/// Stores the energies, because they need a solve in each group.
int CondensedSets::remember(InterfaceState& state) const {
  if (!state.memory) state.memory = std::make_shared<Matrix>(energies(state));
  return 0;
}

Vector CondensedSets::energies(const InterfaceState& state) const {
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
