// ContactInterfaceProblem in terms of sets of closed pairs (ContactSets), with rigid motions kept apart from the trace.
#include <suture/base/Collective.hpp>
#include <suture/interface/ContactInterfaceProblem.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

namespace suture {

void ContactInterfaceProblem::findBodies() {
  std::map<int, double> stiffness;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (owned_[i]) stiffness[rows_[i].pair.id] = !rows_[i].canChange() ? 1.0 : clusters_->stiffness()(static_cast<Eigen::Index>(i));
  bodies_ = std::make_unique<ContactBodies>(*comm_, subdomains_, stiffness, laws_);
  partOfOwned_.assign(space_->map()->getNodeNumElements(), 0);
  for (std::size_t s = 0; s < locals_.size(); ++s)
    for (const int place : space_->coupling(static_cast<int>(s)).columns())
      if (const int at = space_->ownedRow(place); at >= 0) partOfOwned_[at] = bodies_->partOf(static_cast<int>(s));
  motions_ = std::make_unique<TraceMotions>(*space_, *bodies_, subdomains_, partOfOwned_);
  supports_ = std::make_unique<SupportEnergy>(*space_, *bodies_, subdomains_, partOfOwned_);
}

void ContactInterfaceProblem::separate(InterfaceState& state) const { move(state, motions_->takeOut(*state.trace)); }

Matrix ContactInterfaceProblem::everywhere(const Matrix& ofRows) const {
  Matrix mine = Matrix::Zero(bodies_->rigid().pairs(), ofRows.cols()), all = mine;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (owned_[i]) mine.row(rows_[i].pair.id) = ofRows.row(static_cast<Eigen::Index>(i));
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

ContactStates ContactInterfaceProblem::statusOf(const ClosedSet& closed) const {
  ContactStates status(1);
  for (const ContactRow& row : rows_) status[0].push_back(closed[row.pair.id] || row.separates == false ? pressed(row) : ContactState());
  return status;
}

ClosedSet ContactInterfaceProblem::closedSet(const ContactStates& status) const {
  Matrix closed(rows_.size(), 1);
  for (std::size_t i = 0; i < rows_.size(); ++i) closed(static_cast<Eigen::Index>(i), 0) = status[0][i].closed();
  const Matrix all = everywhere(closed);
  ClosedSet set(all.rows(), 0);
  for (std::size_t i = 0; i < set.size(); ++i) set[i] = all(static_cast<Eigen::Index>(i), 0) != 0.0;
  return set;
}

InterfaceState ContactInterfaceProblem::padState() const {
  InterfaceState state;
  state.trace = space_->vector();
  state.status = statusOf(bodies_->rigid().start());
  state.memory = std::make_shared<Matrix>(-load_);
  move(state, bodies_->rigid().project(bodies_->rigid().data().penetration).motion);
  return state;
}

void ContactInterfaceProblem::move(InterfaceState& state, const Vector& motion) const {
  if (motion.size() == 0 || motion.isZero(0.0)) return;
  if (state.rigid.size() == 0) state.rigid = Vector::Zero(motion.size());
  state.rigid += motion;
}

Vector ContactInterfaceProblem::movedRows(const InterfaceState& state) const {
  if (state.rigid.size() == 0) return {};
  const RigidBodyModel::Pairs& data = bodies_->rigid().data();
  const Vector all = data.rows * state.rigid;
  Vector mine = Vector::Zero(clusters_->size());
  for (std::size_t i = 0; i < rows_.size(); ++i) mine(static_cast<Eigen::Index>(i)) = all(rows_[i].pair.id);
  for (std::size_t t = 0; t < data.tangents.size(); ++t) {
    const Vector along = data.tangents[t] * state.rigid;
    for (std::size_t i = 0; i < rows_.size(); ++i)
      if (const int row = clusters_->rowOf(static_cast<int>(i), static_cast<int>(t) + 1); row >= 0) mine(row) = along(rows_[i].pair.id);
  }
  return mine;
}

double ContactInterfaceProblem::rigidWork(const InterfaceState& state) const {
  return state.rigid.size() > 0 ? bodies_->rigid().data().work.dot(state.rigid) : 0.0;
}

int ContactInterfaceProblem::remember(InterfaceState& state) const {
  if (state.memory) return 0;
  state.memory = std::make_shared<Matrix>(imbalance(*state.trace));
  return 1;
}

Vector ContactInterfaceProblem::energies(const InterfaceState& state) const {
  int applications = 0;
  const Matrix out = rememberedImbalance(state, applications);
  const auto owned = localView(static_cast<const MultiVector&>(*state.trace));
  Vector mine = Vector::Zero(static_cast<Eigen::Index>(bodies_->parts().size())), all = mine, forces = Vector::Zero(owned.rows());
  for (int place = 0; place < space_->overlapSize(); ++place)
    if (const int at = space_->ownedRow(place); at >= 0) {
      forces(at) = out(place, 0) + load_(place, 0);
      mine(partOfOwned_[at]) += owned(at, 0) * forces(at);
    }
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return (all - supports_->of(forces)).cwiseMax(0.0);
}

std::vector<int> ContactInterfaceProblem::differing(const ContactStates& a, const ContactStates& b) const {
  std::vector<int> mine;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (a[0][i] != b[0][i]) mine.push_back(rows_[i].pair.id);
  return unionOverRanks(*comm_, mine);
}

}  // namespace suture
