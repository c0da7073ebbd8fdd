#include <suture/interface/InterfaceContact.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <cmath>
#include <map>

namespace suture {

InterfaceContact::InterfaceContact(const CommPtr& comm, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
                                   const InterfaceSpace& space, const ContactLaws& laws, const InterfaceRows& rows,
                                   const InterfaceBalance& balance, PairTangents& tangents)
    : comm_(comm), space_(space), laws_(laws), rows_(rows), balance_(balance), tangents_(tangents) {
  std::map<int, double> stiffness;
  for (int i = 0; i < rows.size(); ++i)
    if (rows.isOwned(i)) stiffness[rows.row(i).pair.id] = !rows.row(i).canChange() ? 1.0 : rows.clusters().stiffness()(i);
  bodies_ = std::make_unique<ContactBodies>(*comm, subdomains, stiffness, laws);
  rigid_ = &bodies_->rigid();
  partOfOwned_.assign(space.map()->getNodeNumElements(), 0);
  for (int s = 0; s < static_cast<int>(subdomains.size()); ++s)
    for (const int place : space.coupling(s).columns())
      if (const int at = space.ownedRow(place); at >= 0) partOfOwned_[static_cast<std::size_t>(at)] = bodies_->partOf(s);
  motions_ = std::make_unique<TraceMotions>(space, *bodies_, subdomains, partOfOwned_);
  supports_ = std::make_unique<SupportEnergy>(space, *bodies_, subdomains, partOfOwned_);
  sites_ = findSites();
}

std::vector<FrictionSite> InterfaceContact::findSites() const {
  Matrix values = Matrix::Zero(rows_.size(), kPairColumns);
  for (int i = 0; i < rows_.size(); ++i) {
    std::array<double, 2> stiffness{0.0, 0.0};
    for (int component = 1; component <= 2; ++component)
      if (const int row = rows_.clusters().rowOf(i, component); row >= 0 && !rows_.clusters().row(row).places.empty())
        stiffness[static_cast<std::size_t>(component - 1)] = rows_.clusters().stiffness()(row);
    putSite(rows_.row(i).pair, stiffness, values, i);
  }
  return sitesFrom(everywhere(values));
}

ContactStates InterfaceContact::statusOf(const PairStates& pairs) const {
  ContactStates status(1);
  for (int i = 0; i < rows_.size(); ++i) {
    const int id = rows_.row(i).pair.id;
    const bool isGiven = rows_.row(i).canChange() && !rigid_->isBound(static_cast<std::size_t>(id));
    status[0].push_back(isGiven ? pairs[static_cast<std::size_t>(id)] : rows_.pressed(i));
  }
  return status;
}

PairStates InterfaceContact::statesOf(const ContactStates& status) const {
  Matrix values(rows_.size(), kPairColumns);
  for (int i = 0; i < rows_.size(); ++i) putState(status[0][static_cast<std::size_t>(i)], values, i);
  return statesFrom(everywhere(values));
}

InterfaceState InterfaceContact::stateWith(const PairStates& pairs) const {
  InterfaceState state;
  state.trace = space_.vector();
  state.status = statusOf(pairs);
  state.memory = std::make_shared<Matrix>(balance_.ofNoTrace());
  return state;
}

PairValues InterfaceContact::valuesOf(const InterfaceState& state) const {
  PairValues result;
  Matrix out = balance_.of(state, result.applications), trace;
  space_.gather(*state.trace, trace);
  result.energy = balance_.energy(trace, out) - rigidWork(state);
  const Vector moved = movedRows(state), gaps = rows_.gaps(trace, moved);
  rows_.addSlipForces(state.status[0], gaps, out);
  const Vector force = rows_.clusters().forces(state.status[0], out.col(0));
  Matrix values = Matrix::Zero(rows_.size(), kPairColumns);
  for (int i = 0; i < rows_.size(); ++i) {
    if (!rows_.row(i).canChange()) continue;
    PairForces pair = rows_.pairForces(i, force, gaps);
    pair.digits = rows_.digits(i, trace, moved);
    putPair(state.status[0][static_cast<std::size_t>(i)], pair, values, i);
  }
  const Matrix all = everywhere(values);
  result.force = all.leftCols(3);
  result.jump = all.middleCols(3, 3);
  result.digits = all.col(6);
  const PairTangent& tangent = tangents_.of(state.status);
  result.residual = balance_.residual(out, *tangent.space, tangent.friction.get());
  return result;
}

void InterfaceContact::separate(InterfaceState& state) const { move(state, motions_->takeOut(*state.trace)); }

int InterfaceContact::remember(InterfaceState& state) const {
  int applications = 0;
  if (!state.memory) state.memory = std::make_shared<Matrix>(balance_.of(state, applications));
  return applications;
}

Vector InterfaceContact::energies(const InterfaceState& state) const {
  int applications = 0;
  const Vector forces = balance_.forces(balance_.of(state, applications));
  const auto owned = localView(static_cast<const MultiVector&>(*state.trace));
  Vector mine = Vector::Zero(static_cast<Eigen::Index>(bodies_->parts().size())), all = mine;
  for (Eigen::Index at = 0; at < forces.size(); ++at) mine(partOfOwned_[static_cast<std::size_t>(at)]) += owned(at, 0) * forces(at);
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return (all - supports_->of(forces)).cwiseMax(0.0);
}

Vector InterfaceContact::movedRows(const InterfaceState& state) const {
  if (state.rigid.size() == 0) return {};
  const RigidBodyModel::Pairs& data = rigid_->data();
  const Vector all = data.rows * state.rigid;
  Vector mine = Vector::Zero(rows_.clusters().size());
  for (int i = 0; i < rows_.size(); ++i) mine(i) = all(rows_.row(i).pair.id);
  for (std::size_t t = 0; t < data.tangents.size(); ++t) {
    const Vector along = data.tangents[t] * state.rigid;
    for (int i = 0; i < rows_.size(); ++i)
      if (const int row = rows_.clusters().rowOf(i, static_cast<int>(t) + 1); row >= 0) mine(row) = along(rows_.row(i).pair.id);
  }
  return mine;
}

double InterfaceContact::rigidWork(const InterfaceState& state) const {
  return state.rigid.size() > 0 ? rigid_->data().work.dot(state.rigid) : 0.0;
}

void InterfaceContact::addSpringMotions(const ContactStates& status, const InterfaceSpace& space, FrictionTangent& tangent) const {
  const RigidBodyModel::Pairs& data = rigid_->data();
  if (data.tangents.empty() || rigid_->motions() == 0) return;
  PairStates states = statesOf(status);
  std::vector<Eigen::Triplet<double, int>> entries;
  int count = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (!(states[i].transverseStiffness > 0.0)) continue;
    const Point across = acrossSlip(states[i]);
    for (std::size_t k = 0; k < data.tangents.size(); ++k)
      for (SparseRows::InnerIterator entry(data.tangents[k], static_cast<Eigen::Index>(i)); entry; ++entry)
        entries.emplace_back(count, static_cast<int>(entry.col()),
                             std::sqrt(states[i].transverseStiffness) * across[k + 1] * entry.value());
    ++count;
    states[i].transverseStiffness = 0.0;
  }
  if (count == 0) return;
  const Matrix loose = rigid_->loose(states);
  if (loose.cols() == 0) return;
  SparseMatrix springs(count, rigid_->motions());
  springs.setFromTriplets(entries.begin(), entries.end());
  const Matrix held = springs * loose;
  tangent.motionEnergy = held.transpose() * held;
  tangent.motions = space.vector(static_cast<int>(loose.cols()));
  auto owned = localView(*tangent.motions);
  for (int place = 0; place < space.overlapSize(); ++place) {
    const int at = space.ownedRow(place);
    if (at < 0 || space.relation(place)) continue;
    const int part = partOfOwned_[static_cast<std::size_t>(at)];
    const RigidPart& own = bodies_->parts()[static_cast<std::size_t>(part)];
    if (own.free.cols() == 0) continue;
    for (Eigen::Index k = 0; k < loose.cols(); ++k)
      owned(at, k) =
          dot(space.direction(place), own.displacement(space.point(place), bodies_->amplitudes(part, loose.col(k)), bodies_->dimension()));
  }
}

}  // namespace suture
