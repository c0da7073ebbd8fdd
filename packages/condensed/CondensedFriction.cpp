#include <suture/condensed/CondensedFriction.hpp>
#include <suture/condensed/CondensedProblem.hpp>
#include <suture/condensed/GroupPairs.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_MultiVector.hpp>

namespace suture {

CondensedFriction::CondensedFriction(const Comm& comm, const CondensedProblem& problem, const CondensedSets& sets)
    : comm_(comm), problem_(problem), sets_(sets) {
  Matrix mine = Matrix::Zero(sets.bodies().rigid().pairs(), kPairColumns);
  for (const auto& group : problem.groups()) {
    const Vector rows = rowStiffness(*group);
    for (int i = 0; i < group->rows().size(); ++i) {
      std::array<double, 2> stiffness{0.0, 0.0};
      for (int component = 1; component <= 2; ++component)
        if (const int row = group->rows().rowOf(i, component); row >= 0) stiffness[component - 1] = rows(row);
      putSite(group->pairs()[i], stiffness, mine, group->pairs()[i].id);
    }
  }
  sites_ = sitesFrom(sets.everywhere(mine));
}

const ContactLaws& CondensedFriction::laws() const { return problem_.laws(); }

ContactStates CondensedFriction::statusOf(const PairStates& pairs) const {
  ContactStates status(problem_.plain_.size());
  for (const auto& group : problem_.groups()) {
    const ContactRows& rows = group->rows();
    status.emplace_back();
    for (int i = 0; i < rows.size(); ++i)
      status.back().push_back(problem_.laws().of(rows.lines[i]).separates() ? pairs[rows.pairIds[i]] : rows.pressed[i]);
  }
  return status;
}

PairStates CondensedFriction::statesOf(const ContactStates& status) const {
  Matrix mine = Matrix::Zero(static_cast<Eigen::Index>(sites_.size()), kPairColumns);
  for (std::size_t g = 0; g < problem_.groups().size(); ++g) {
    const std::vector<int>& ids = problem_.groups()[g]->rows().pairIds;
    for (std::size_t i = 0; i < ids.size(); ++i) putState(status[problem_.placeOfGroup(static_cast<int>(g))][i], mine, ids[i]);
  }
  return statesFrom(sets_.everywhere(mine));
}

InterfaceState CondensedFriction::stateWith(const PairStates& pairs) const {
  InterfaceState state;
  state.trace = problem_.space()->vector();
  state.status = statusOf(pairs);
  return state;
}

PairValues CondensedFriction::valuesOf(const InterfaceState& state) const {
  Matrix out = Matrix::Zero(problem_.space()->overlapSize(), 1),
         mine = Matrix::Zero(static_cast<Eigen::Index>(sites_.size()), kPairColumns);
  const double energy = problem_.addLinear(state, problem_.traces(*state.trace), out,
                                           [&](int group, const ContactGroup::Response& response, const Vector& moved) {
                                             const ContactGroup& own = *problem_.groups()[group];
                                             const std::vector<PairForces> pairs = pairForces(own, response, moved);
                                             for (std::size_t i = 0; i < pairs.size(); ++i)
                                               putPair(response.status[i], pairs[i], mine, own.rows().pairIds[i]);
                                           });
  const Matrix all = sets_.everywhere(mine);
  PairValues result;
  result.force = all.leftCols(3);
  result.jump = all.middleCols(3, 3);
  result.digits = all.col(6);
  result.residual = problem_.space()->vector();
  problem_.space()->scatterAdd(out, *result.residual);
  Teuchos::reduceAll(comm_, Teuchos::REDUCE_SUM, energy, Teuchos::outArg(result.energy));
  result.energy -= sets_.rigidWork(state);
  return result;
}

}  // namespace suture
