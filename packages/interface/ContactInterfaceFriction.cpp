// ContactInterfaceProblem in terms of pair states with friction (FrictionStates).
#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/interface/ContactInterfaceProblem.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <cmath>

namespace suture {

void ContactInterfaceProblem::findSites() {
  Matrix values = Matrix::Zero(static_cast<Eigen::Index>(rows_.size()), kPairColumns);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    std::array<double, 2> stiffness{0.0, 0.0};
    for (int component = 1; component <= 2; ++component)
      if (const int row = clusters_->rowOf(static_cast<int>(i), component); row >= 0 && !clusters_->row(row).places.empty())
        stiffness[component - 1] = clusters_->stiffness()(row);
    putSite(rows_[i].pair, stiffness, values, static_cast<Eigen::Index>(i));
  }
  sites_ = sitesFrom(everywhere(values));
}

ContactStates ContactInterfaceProblem::statusOf(const PairStates& pairs) const {
  ContactStates status(1);
  for (const ContactRow& row : rows_)
    status[0].push_back(!row.canChange() || bodies_->rigid().isBound(row.pair.id) ? pressed(row) : pairs[row.pair.id]);
  return status;
}

PairStates ContactInterfaceProblem::statesOf(const ContactStates& status) const {
  Matrix values(static_cast<Eigen::Index>(rows_.size()), kPairColumns);
  for (std::size_t i = 0; i < rows_.size(); ++i) putState(status[0][i], values, static_cast<Eigen::Index>(i));
  return statesFrom(everywhere(values));
}

InterfaceState ContactInterfaceProblem::stateWith(const PairStates& pairs) const {
  InterfaceState state;
  state.trace = space_->vector();
  state.status = statusOf(pairs);
  state.memory = std::make_shared<Matrix>(-load_);
  return state;
}

Point ContactInterfaceProblem::slipOf(int row, const Vector& gaps) const {
  Point slip{0, 0, 0};
  for (int component = 1; component <= 2; ++component)
    if (const int tangent = clusters_->rowOf(row, component); tangent >= 0) slip[component] = -gaps(tangent);
  return slip;
}

void ContactInterfaceProblem::addSlipForces(const InterfaceState& state, const Matrix& trace, Matrix& imbalance) const {
  const Vector gaps = clusters_->gaps(trace.col(0), movedRows(state));
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
    const ContactState& own = state.status[0][i];
    if (own.status == PairStatus::Stick || (own.bound == 0.0 && own.transverseStiffness == 0.0)) continue;
    const Point across = acrossSlip(own);
    const double spring = own.transverseStiffness * dot(across, slipOf(i, gaps));
    for (int component = 1; component <= 2; ++component) {
      const int tangent = clusters_->rowOf(i, component);
      if (tangent < 0) continue;
      const ContactClusters::Row& row = clusters_->row(tangent);
      const double force = (own.closed() ? own.bound * own.direction[component] : 0.0) + spring * across[component];
      for (std::size_t k = 0; k < row.places.size(); ++k) imbalance(row.places[k], 0) += row.coefficients[k] * force;
    }
  }
}

void ContactInterfaceProblem::addSpringMotions(const ContactStates& status, const InterfaceSpace& space, FrictionTangent& tangent) const {
  const RigidBodyModel::Pairs& data = bodies_->rigid().data();
  if (data.tangents.empty() || bodies_->rigid().motions() == 0) return;
  PairStates states = statesOf(status);
  std::vector<Eigen::Triplet<double, int>> entries;
  int count = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!(states[i].transverseStiffness > 0.0)) continue;
    const Point across = acrossSlip(states[i]);
    const auto at = static_cast<Eigen::Index>(i);
    for (std::size_t k = 0; k < data.tangents.size(); ++k)
      for (SparseRows::InnerIterator entry(data.tangents[k], at); entry; ++entry)
        entries.emplace_back(count, static_cast<int>(entry.col()),
                             std::sqrt(states[i].transverseStiffness) * across[k + 1] * entry.value());
    ++count;
    states[i].transverseStiffness = 0.0;
  }
  if (count == 0) return;
  const Matrix loose = bodies_->rigid().loose(states);
  if (loose.cols() == 0) return;
  SparseMatrix springs(count, bodies_->rigid().motions());
  springs.setFromTriplets(entries.begin(), entries.end());
  const Matrix held = springs * loose;
  tangent.motionEnergy = held.transpose() * held;
  tangent.motions = space.vector(static_cast<int>(loose.cols()));
  auto owned = localView(*tangent.motions);
  for (int place = 0; place < space.overlapSize(); ++place) {
    const int at = space.ownedRow(place);
    if (at < 0 || space.relation(place)) continue;
    const int part = partOfOwned_[at];
    if (bodies_->parts()[part].free.cols() == 0) continue;
    for (Eigen::Index k = 0; k < loose.cols(); ++k)
      owned(at, k) = dot(space.direction(place), bodies_->parts()[part].displacement(
                                                     space.point(place), bodies_->amplitudes(part, loose.col(k)), bodies_->dimension()));
  }
}

PairValues ContactInterfaceProblem::valuesOf(const InterfaceState& state) const {
  PairValues result;
  Matrix out = rememberedImbalance(state, result.applications), trace;
  space_->gather(*state.trace, trace);
  double work = 0.0;
  for (int place = 0; place < space_->overlapSize(); ++place)
    if (space_->ownedRow(place) >= 0) work += 0.5 * trace(place, 0) * (out(place, 0) - load_(place, 0));
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, work, Teuchos::outArg(result.energy));
  result.energy += constantEnergy_ - rigidWork(state);

  addSlipForces(state, trace, out);
  const Vector force = clusters_->forces(state.status[0], out.col(0)), moved = movedRows(state),
               gaps = clusters_->gaps(trace.col(0), moved);
  Matrix values = Matrix::Zero(static_cast<Eigen::Index>(rows_.size()), kPairColumns);
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
    if (!rows_[i].canChange()) continue;
    PairForces pair = pairForces(i, force, gaps);
    pair.digits = std::max(std::abs(clusters_->row(i).gap), moved.size() > 0 ? std::abs(moved(i)) : 0.0);
    for (const int place : clusters_->row(i).places) pair.digits = std::max(pair.digits, std::abs(trace(place, 0)));
    putPair(state.status[0][i], pair, values, i);
  }
  const Matrix all = everywhere(values);
  result.force = all.leftCols(3);
  result.jump = all.middleCols(3, 3);
  result.digits = all.col(6);
  const PairTangent& tangent = tangents_->of(state.status);
  result.residual = residual(out, *tangent.space, tangent.friction.get());
  return result;
}

PairForces ContactInterfaceProblem::pairForces(int row, const Vector& force, const Vector& gaps) const {
  PairForces pair;
  pair.normal = force(row);
  pair.gap = gaps(row);
  pair.slip = slipOf(row, gaps);
  for (int component = 1; component <= 2; ++component)
    if (const int tangent = clusters_->rowOf(row, component); tangent >= 0) {
      pair.held[component] = force(tangent);
      pair.isPrescribed[static_cast<std::size_t>(component)] = clusters_->row(tangent).places.empty();
    }
  return pair;
}

}  // namespace suture
