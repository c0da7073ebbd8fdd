#include <suture/base/Collective.hpp>
#include <suture/base/Progress.hpp>
#include <suture/interface/ContactInterfaceProblem.hpp>
#include <suture/interface/SeamLayout.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <set>

namespace suture {

namespace {

/// Free unknowns of a subdomain at seams and in its contact rows; for bodies that move far at all nodes that may come into contact, which
/// have a rule for their axes.
std::vector<int> boundaryDofs(const Subdomain& subdomain) {
  const SubdomainMesh& mesh = subdomain.mesh();
  std::set<GlobalId> inContact;
  for (const ContactRow& row : mesh.contactRows)
    for (const ContactRow::Equation& equation : row.equations) inContact.insert(equation.dofs.begin(), equation.dofs.end());
  for (const NodeRule& rule : mesh.rules)
    for (int k = 0; !mesh.drawn.empty() && k < mesh.dimension; ++k)
      if (const int dof = subdomain.dof(rule.node, k); dof >= 0) inContact.insert(subdomain.globalDof(dof));
  std::vector<int> dofs;
  for (int dof = 0; dof < subdomain.dofs(); ++dof)
    if (!mesh.others(subdomain.nodeOf(dof)).empty() || inContact.count(subdomain.globalDof(dof))) dofs.push_back(dof);
  return dofs;
}

}  // namespace

ContactInterfaceProblem::ContactInterfaceProblem(CommPtr comm, const Partition& partition,
                                                 const std::vector<std::unique_ptr<Subdomain>>& subdomains, const LocalSolverMaker& solver,
                                                 const SchurMaker& schur, ContactLaws laws)
    : comm_(std::move(comm)), subdomains_(subdomains), laws_(std::move(laws)) {
  const double softest = softestStiffness(*comm_, subdomains);
  collectively(*comm_, "factoring the subdomains", [&] {
    for (const auto& subdomain : subdomains) {
      Progress::count("subdomains", static_cast<long>(subdomains.size()));
      boundaries_.push_back(boundaryDofs(*subdomain));
      locals_.push_back(std::make_shared<SubdomainProblem>(subdomain->mesh().id, *subdomain, boundaries_.back(), solver, schur(), softest));
    }
  });
  connect();
  for (const auto& piecesOfGroup : partition.piecesOf) pieces_ += static_cast<int>(piecesOfGroup.size());
}

/// The space of the local problems, and the contact rows in it.
void ContactInterfaceProblem::connect() {
  InterfaceLayout layout;
  collectively(*comm_, "connecting the subdomains", [&] {
    for (std::size_t s = 0; s < subdomains_.size(); ++s) {
      const std::unique_ptr<Subdomain>& subdomain = subdomains_[s];
      addUnknowns(*subdomain, boundaries_[s], layout);
      layout.locals.push_back(subdomain->mesh().id);
      layout.boundaries.push_back(locals_[s]->boundary());
      for (const ContactRow& row : subdomain->mesh().contactRows)
        for (const ContactRow::Equation& equation : row.equations)
          layout.partners.insert(layout.partners.end(), equation.dofs.begin(), equation.dofs.end());
    }
    addSeams(
        subdomains_, [](int subdomain) { return subdomain; }, layout);
  });
  contact_.reset(), tangents_.reset(), rows_.reset(), balance_.reset();
  space_ = std::make_shared<InterfaceSpace>(comm_, layout);
  balance_ = std::make_unique<InterfaceBalance>(space_, LocalProblems(locals_.begin(), locals_.end()));
  takeLoads();
  rows_ = std::make_unique<InterfaceRows>(subdomains_, laws_, space_, shearStiffness());
  int mine = 0;
  for (int i = 0; i < rows_->size(); ++i) {
    const ContactRow& row = rows_->row(i);
    mine += rows_->isOwned(i) && row.canChange() && laws_.of(row.pair.line).separates();
  }
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(pairs_));
  tangents_ = std::make_unique<PairTangents>(space_, subdomains_, rows_->all(), rows_->owned(), rows_->clusters(),
                                             laws_.restrictSliding() ? space_->dimension() : 1, restrictsSliding());
  findContact();
}

/// Diagonal of the shear stiffness on the overlap: contact deforms a surface by change of shape, even if the volume is constant.
Vector ContactInterfaceProblem::shearStiffness() const {
  Matrix stiffness = Matrix::Zero(space_->overlapSize(), 1);
  for (std::size_t i = 0; i < locals_.size(); ++i) {
    const Matrix& shear = locals_[i]->hint(Hint::kShearDiagonal);
    space_->coupling(static_cast<int>(i)).addTransposed(shear.cols() > 0 ? shear : Matrix(locals_[i]->stiffnessDiagonal()), stiffness);
  }
  space_->sum(stiffness);
  return stiffness.col(0);
}

void ContactInterfaceProblem::takeLoads() {
  double energy = 0.0;
  for (const auto& local : locals_) energy += local->constantEnergy();
  balance_->takeLoads(energy);
}

void ContactInterfaceProblem::rearrange() {
  collectively(*comm_, "loading the subdomains", [&] {
    for (const auto& local : locals_) local->reload();
  });
  connect();
}

void ContactInterfaceProblem::findContact() {
  contact_.reset();
  if (pairs_ > 0) contact_ = std::make_unique<InterfaceContact>(comm_, subdomains_, *space_, laws_, *rows_, *balance_, *tangents_);
}

void ContactInterfaceProblem::reload() {
  collectively(*comm_, "loading the subdomains", [&] {
    for (const auto& local : locals_) local->reload();
  });
  takeLoads();
  rows_->reload(subdomains_);
  findContact();
}

InterfaceState ContactInterfaceProblem::initialState() const {
  InterfaceState state;
  state.trace = space_->vector();
  state.status = rows_->allPressed();
  state.memory = std::make_shared<Matrix>(balance_->ofNoTrace());
  state.applications = conform(state);  // gaps change the trace
  return state;
}

InterfaceState ContactInterfaceProblem::stateOf(const std::vector<Vector>& freeValues, const std::map<int, ContactState>& status) const {
  InterfaceState state;
  state.trace = space_->vector();
  state.status = rows_->allPressed();
  auto owned = localView(*state.trace);
  for (std::size_t s = 0; s < subdomains_.size(); ++s)
    for (int dof = 0; dof < subdomains_[s]->dofs(); ++dof) {
      const auto at = space_->map()->getLocalElement(subdomains_[s]->globalDof(dof));
      if (at >= 0) owned(at, 0) = freeValues[s](dof);
    }
  for (int i = 0; i < rows_->size(); ++i)
    if (const auto found = status.find(rows_->row(i).pair.id); found != status.end() && rows_->row(i).canChange())
      state.status[0][static_cast<std::size_t>(i)] = found->second;
  conform(state);
  return state;
}

int ContactInterfaceProblem::conform(InterfaceState& state) const {
  Matrix trace;
  space_->gather(*state.trace, trace);
  const Vector change = rows_->clusters().correction(state.status[0], trace.col(0), movedRows(state));
  double mine = change.size() > 0 ? change.cwiseAbs().maxCoeff() : 0.0, all = 0.0;
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MAX, mine, Teuchos::outArg(all));
  if (all == 0.0) return 0;
  const MultiVectorPtr step = space_->vector();
  auto owned = localView(*step);
  for (int place = 0; place < space_->overlapSize(); ++place)
    if (const int at = space_->ownedRow(place); at >= 0) owned(at, 0) = change(place);
  state.trace->update(1.0, *step, 1.0);
  if (!state.memory) return 0;
  state.memory = std::make_shared<Matrix>(*state.memory + balance_->forces(*step));
  return 1;
}

void ContactInterfaceProblem::update(InterfaceState& state, const MultiVector& step, double length, const Matrix* image) const {
  Matrix moved;
  tangents_->of(state.status).space->gather(step, moved);
  auto owned = localView(*state.trace);
  for (int place = 0; place < space_->overlapSize(); ++place)
    if (const int at = space_->ownedRow(place); at >= 0) owned(at, 0) += length * moved(place, 0);
  if (!image || !state.memory) {
    state.memory.reset();
    return;
  }
  Matrix flux = *image;
  space_->sum(flux);
  state.memory = std::make_shared<Matrix>(*state.memory + length * flux);
}

InterfaceProblem::Linearisation ContactInterfaceProblem::linearise(const InterfaceState& state) const {
  const PairTangent& tangent = tangents_->of(state.status);
  const std::shared_ptr<const InterfaceSpace>& space = tangent.space;
  Linearisation result;
  std::shared_ptr<const FrictionTangent> friction = tangent.friction;
  if (friction) {  // not null on a rank without subdomains either
    auto own = std::make_shared<FrictionTangent>(*friction);
    contact_->addSpringMotions(state.status, *space, *own);
    const int mine = own->symmetric;
    int all = 0;
    Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(all));
    own->symmetric = all != 0;
    friction = own;
  }
  result.matrix = Teuchos::rcp(new InterfaceOperator(space, balance_->locals(), friction));
  int applications = 0;
  Matrix out = balance_->of(state, applications);
  if (friction) {
    Matrix trace;
    space_->gather(*state.trace, trace);
    rows_->addSlipForces(state.status[0], rows_->gaps(trace, movedRows(state)), out);
  }
  result.load = balance_->residual(out, *space, friction.get());
  return result;
}

InterfaceProblem::Evaluation ContactInterfaceProblem::evaluate(const InterfaceState& state, double resolution) const {
  if (contact_) {
    const PairStates states = contact_->statesOf(state.status);
    const PairValues values = contact_->valuesOf(state);
    return evaluationOf(*contact_, states, values, answerOf(*contact_, states, values, {resolution}));
  }
  Evaluation result;
  const Matrix out = balance_->of(state, result.applications);
  Matrix trace;
  space_->gather(*state.trace, trace);
  result.next = state.status;
  result.energy = balance_->energy(trace, out);
  result.residual = balance_->residual(out, *tangents_->of(state.status).space);
  return result;
}

std::vector<Vector> ContactInterfaceProblem::interiors(const InterfaceState& state) const {
  Matrix trace;
  space_->gather(*state.trace, trace);
  std::vector<Vector> freeValues;
  collectively(*comm_, "recovering the interiors", [&] {
    for (std::size_t i = 0; i < locals_.size(); ++i) {
      Matrix own(locals_[i]->size(), 1);
      space_->coupling(static_cast<int>(i)).restrictTo(trace, own);
      freeValues.push_back(locals_[i]->recover(own.col(0)));
      if (contact_) contact_->bodies().addMotion(static_cast<int>(i), *subdomains_[i], state.rigid, freeValues.back());
    }
  });
  return freeValues;
}

/// \param force, gaps  of all rows
PairForce ContactInterfaceProblem::forceOf(int i, const InterfaceState& state, const Vector& force, const Vector& gaps) const {
  const ContactRow& row = rows_->row(i);
  const ContactState& own = state.status[0][static_cast<std::size_t>(i)];
  PairForce result{row.pair.id, own, force(i)};
  if (row.restrictsSliding())
    result.tangential = cartesian(row.pair, space_->dimension(), rows_->pairForces(i, force, gaps).tangential(own));
  return result;
}

std::optional<BrokenField> ContactInterfaceProblem::brokenField(const InterfaceState& state, const std::vector<Vector>& corrections) const {
  Matrix trace;
  space_->gather(*state.trace, trace);
  BrokenField result;
  Matrix out = Matrix::Zero(space_->overlapSize(), 1);
  double largest = 0.0;
  collectively(*comm_, "recovering the interiors", [&] {
    for (std::size_t i = 0; i < locals_.size(); ++i) {
      const Coupling& coupling = space_->coupling(static_cast<int>(i));
      Matrix own(locals_[i]->size(), 1);
      coupling.restrictTo(trace, own);
      if (!corrections.empty()) own += corrections[i];
      result.freeValues.push_back(locals_[i]->recover(own.col(0)));
      const Vector forces = locals_[i]->boundaryForces(result.freeValues.back());
      if (forces.size() > 0) largest = std::max(largest, forces.lpNorm<Eigen::Infinity>());
      coupling.addTransposed(forces, out);
    }
  });
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MAX, largest, Teuchos::outArg(result.largestForce));
  space_->sum(out);
  const Vector gaps = rows_->gaps(trace, movedRows(state));
  if (restrictsSliding()) rows_->addSlipForces(state.status[0], gaps, out);
  const PairTangent& tangent = tangents_->of(state.status);
  result.residual = balance_->residual(out, *tangent.space, tangent.friction.get());
  const Vector force = rows_->clusters().forces(state.status[0], out.col(0));
  for (int i = 0; i < rows_->size(); ++i) result.pairs.push_back(forceOf(i, state, force, gaps));
  return result;
}

InterfaceProblem::Recovered ContactInterfaceProblem::recover(const InterfaceState& state) const {
  Matrix trace;
  space_->gather(*state.trace, trace);
  InterfaceState afresh = state;
  afresh.memory.reset();
  int applications = 0;
  Matrix out = balance_->of(afresh, applications);
  const Vector gaps = rows_->gaps(trace, movedRows(state));
  if (restrictsSliding()) rows_->addSlipForces(state.status[0], gaps, out);
  const Vector force = rows_->clusters().forces(state.status[0], out.col(0));
  Recovered result;
  InterfaceState deformed = state;
  deformed.rigid = Vector();
  result.freeValues = interiors(deformed);
  double energy = 0.0;
  collectively(*comm_, "recovering the contact", [&] {
    for (std::size_t i = 0; i < locals_.size(); ++i) {
      Vector& values = result.freeValues[i];
      const Subdomain& subdomain = *subdomains_[i];
      energy += 0.5 * values.dot(subdomain.stiffness() * values) - values.dot(subdomain.load()) + subdomain.constantEnergy();
      if (contact_) contact_->bodies().addMotion(static_cast<int>(i), subdomain, state.rigid, values);
    }
  });
  for (int i = 0; i < rows_->size(); ++i)
    if (rows_->isOwned(i)) result.pairs.push_back(forceOf(i, state, force, gaps));
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, energy, Teuchos::outArg(result.energy));
  if (contact_) result.energy -= contact_->rigidWork(state);
  return result;
}

}  // namespace suture
