#include <suture/base/Collective.hpp>
#include <suture/base/Progress.hpp>
#include <suture/interface/ContactInterfaceProblem.hpp>
#include <suture/interface/PlainFlips.hpp>
#include <suture/interface/SeamLayout.hpp>
#include <suture/pairs/ContactRow.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace suture {

namespace {

/// Free unknowns of a subdomain at seams and in its contact rows.
std::vector<int> boundaryDofs(const Subdomain& subdomain) {
  const SubdomainMesh& mesh = subdomain.mesh();
  std::set<GlobalId> inContact;
  for (const ContactRow& row : mesh.contactRows)
    for (const ContactRow::Equation& equation : row.equations) inContact.insert(equation.dofs.begin(), equation.dofs.end());
  std::vector<int> dofs;
  for (int dof = 0; dof < subdomain.dofs(); ++dof)
    if (!mesh.others(subdomain.nodeOf(dof)).empty() || inContact.count(subdomain.globalDof(dof))) dofs.push_back(dof);
  return dofs;
}

double reduce(const Comm& comm, Teuchos::EReductionType how, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(comm, how, mine, Teuchos::outArg(all));
  return all;
}

double largest(const Vector& values) { return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0; }

}  // namespace

ContactInterfaceProblem::ContactInterfaceProblem(CommPtr comm, const Partition& partition,
                                                 const std::vector<std::unique_ptr<Subdomain>>& subdomains, const LocalSolverMaker& solver,
                                                 const SchurMaker& schur, ContactLaws laws)
    : comm_(std::move(comm)), subdomains_(subdomains), laws_(std::move(laws)) {
  InterfaceLayout layout;
  const double softest = softestStiffness(*comm_, subdomains);
  collectively(*comm_, "factoring the subdomains", [&] {
    for (const auto& subdomain : subdomains) {
      Progress::count("subdomains", static_cast<long>(subdomains.size()));
      const std::vector<int> boundary = boundaryDofs(*subdomain);
      addUnknowns(*subdomain, boundary, layout);
      locals_.push_back(std::make_shared<SubdomainProblem>(subdomain->mesh().id, *subdomain, boundary, solver, schur(), softest));
      layout.locals.push_back(subdomain->mesh().id);
      layout.boundaries.push_back(locals_.back()->boundary());
      for (const ContactRow& row : subdomain->mesh().contactRows)
        for (const ContactRow::Equation& equation : row.equations)
          layout.partners.insert(layout.partners.end(), equation.dofs.begin(), equation.dofs.end());
    }
    addSeams(
        subdomains, [](int subdomain) { return subdomain; }, layout);
  });
  space_ = std::make_shared<InterfaceSpace>(comm_, layout);
  apart_ = Teuchos::rcp(new InterfaceOperator(space_, LocalProblems(locals_.begin(), locals_.end())));

  takeLoads();
  Matrix stiffness = Matrix::Zero(space_->overlapSize(), 1);
  for (std::size_t i = 0; i < locals_.size(); ++i) {
    // Use the shear stiffness: contact deforms a surface by change of shape, even if the volume is constant.
    const Matrix& shear = locals_[i]->hint(Hint::kShearDiagonal);
    space_->coupling(static_cast<int>(i)).addTransposed(shear.cols() > 0 ? shear : Matrix(locals_[i]->stiffnessDiagonal()), stiffness);
  }
  space_->sum(stiffness);
  collectRows(stiffness);
  if (pairs_ > 0) findBodies();
  rubs_ = pairs_ > 0 && laws_.restrictSliding();
  tangents_ = std::make_unique<PairTangents>(space_, subdomains_, rows_, owned_, *clusters_,
                                             laws_.restrictSliding() ? space_->dimension() : 1, rubs_);
  if (rubs_) findSites();
  for (const auto& piecesOfGroup : partition.piecesOf) pieces_ += static_cast<int>(piecesOfGroup.size());
}

void ContactInterfaceProblem::takeLoads() {
  load_ = Matrix::Zero(space_->overlapSize(), 1);
  double energy = 0.0;
  for (std::size_t i = 0; i < locals_.size(); ++i) {
    space_->coupling(static_cast<int>(i)).addTransposed(locals_[i]->condensedLoad(), load_);
    energy += locals_[i]->constantEnergy();
  }
  space_->sum(load_);
  constantEnergy_ = reduce(*comm_, Teuchos::REDUCE_SUM, energy);
}

void ContactInterfaceProblem::reload() {
  collectively(*comm_, "loading the subdomains", [&] {
    for (const auto& local : locals_) local->reload();
  });
  takeLoads();
  std::map<int, const ContactRow*> byPair;
  for (const auto& subdomain : subdomains_)
    for (const ContactRow& row : subdomain->mesh().contactRows) byPair.emplace(row.pair.id, &row);
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
    rows_[i] = *byPair.at(rows_[i].pair.id);
    for (int component = 0; component < static_cast<int>(rows_[i].equations.size()); ++component)
      clusters_->setGap(clusters_->rowOf(i, component), rows_[i].equations[component].gap);
  }
  if (pairs_ > 0) findBodies();
  if (rubs_) findSites();
}

namespace {

/// Moves the carrying node's unknown with the largest coefficient to the front.
void carryingFirst(const ContactRow& from, const ContactRow::Equation& equation, int dimension, ContactClusters::Row& row) {
  std::size_t best = equation.dofs.size();
  for (std::size_t k = 0; k < equation.dofs.size(); ++k)
    if (equation.dofs[k] / dimension == from.pair.node() &&
        (best == equation.dofs.size() || std::abs(row.coefficients[k]) > std::abs(row.coefficients[best])))
      best = k;
  if (best == equation.dofs.size()) return;
  std::swap(row.places[0], row.places[best]);
  std::swap(row.coefficients[0], row.coefficients[best]);
}

}  // namespace

void ContactInterfaceProblem::collectRows(const Vector& stiffness) {
  std::map<int, const ContactRow*> byPair;
  std::set<int> mine;
  for (const auto& subdomain : subdomains_) {
    const SubdomainMesh& mesh = subdomain->mesh();
    for (const ContactRow& row : mesh.contactRows) byPair.emplace(row.pair.id, &row);
    for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
      const auto others = mesh.others(end.node);
      if (end.end == 0 && std::all_of(others.begin(), others.end(), [&](int other) { return other > mesh.id; })) mine.insert(end.pair);
    }
  }
  int able = 0;
  for (const auto& [id, row] : byPair) {
    owned_.push_back(mine.count(id) > 0);
    able += owned_.back() && row->canChange() && laws_.of(row->pair.line).separates();
    rows_.push_back(*row);
  }
  // Normal rows come first: their numbers are those of their pairs.
  std::vector<ContactClusters::Row> rows;
  for (std::size_t component = 0; component < 3; ++component)
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      if (component >= rows_[i].equations.size()) continue;
      const ContactRow::Equation& equation = rows_[i].equations[component];
      rows.push_back({{},
                      equation.coefficients,
                      equation.gap,
                      rows_[i].cluster,
                      static_cast<int>(i),
                      static_cast<int>(component),
                      rows_[i].pair.length});
      for (const GlobalId dof : equation.dofs) rows.back().places.push_back(space_->overlap()->getLocalElement(dof));
      if (rows_[i].pair.ends.size() > 2) carryingFirst(rows_[i], equation, space_->dimension(), rows.back());
    }
  clusters_ = std::make_unique<ContactClusters>(std::move(rows), stiffness);
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, able, Teuchos::outArg(pairs_));
}

ContactState ContactInterfaceProblem::pressed(const ContactRow& row) const { return pressedState(row, laws_.of(row.pair.line)); }

InterfaceState ContactInterfaceProblem::allClosed() const {
  InterfaceState state;
  state.trace = space_->vector();
  state.status.emplace_back();
  for (const ContactRow& row : rows_) state.status[0].push_back(pressed(row));
  return state;
}

InterfaceState ContactInterfaceProblem::initialState() const {
  InterfaceState state = allClosed();
  state.memory = std::make_shared<Matrix>(-load_);
  state.applications = conform(state);  // gaps change the trace
  return state;
}

InterfaceState ContactInterfaceProblem::stateOf(const std::vector<Vector>& freeValues, const std::map<int, ContactState>& status) const {
  InterfaceState state = allClosed();
  auto owned = localView(*state.trace);
  for (std::size_t s = 0; s < subdomains_.size(); ++s)
    for (int dof = 0; dof < subdomains_[s]->dofs(); ++dof) {
      const auto at = space_->map()->getLocalElement(subdomains_[s]->globalDof(dof));
      if (at >= 0) owned(at, 0) = freeValues[s](dof);
    }
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (const auto found = status.find(rows_[i].pair.id); found != status.end() && rows_[i].canChange()) state.status[0][i] = found->second;
  conform(state);
  return state;
}

Matrix ContactInterfaceProblem::imbalance(const MultiVector& trace) const {
  const MultiVectorPtr flux = space_->vector();
  apart_->apply(trace, *flux);
  Matrix overlap;
  space_->gather(*flux, overlap);
  return overlap - load_;
}

Matrix ContactInterfaceProblem::rememberedImbalance(const InterfaceState& state, int& applications) const {
  if (state.memory) return *state.memory;
  ++applications;
  return imbalance(*state.trace);
}

MultiVectorPtr ContactInterfaceProblem::residual(const Matrix& imbalance, const InterfaceSpace& space,
                                                 const FrictionTangent* friction) const {
  Matrix folded = -imbalance;
  space.fold(folded, friction && !friction->test.empty() ? &friction->test : nullptr);
  const MultiVectorPtr result = space_->vector();
  auto owned = localView(*result);
  for (int place = 0; place < space_->overlapSize(); ++place)
    if (const int at = space_->ownedRow(place); at >= 0) owned(at, 0) = folded(place, 0);
  return result;
}

int ContactInterfaceProblem::conform(InterfaceState& state) const {
  Matrix trace;
  space_->gather(*state.trace, trace);
  const Vector change = clusters_->correction(state.status[0], trace.col(0), movedRows(state));
  if (reduce(*comm_, Teuchos::REDUCE_MAX, largest(change)) == 0.0) return 0;
  const MultiVectorPtr step = space_->vector();
  auto owned = localView(*step);
  for (int place = 0; place < space_->overlapSize(); ++place)
    if (const int at = space_->ownedRow(place); at >= 0) owned(at, 0) = change(place);
  state.trace->update(1.0, *step, 1.0);
  if (!state.memory) return 0;
  const MultiVectorPtr flux = space_->vector();
  apart_->apply(*step, *flux);
  Matrix overlap;
  space_->gather(*flux, overlap);
  state.memory = std::make_shared<Matrix>(*state.memory + overlap);
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
    auto held = std::make_shared<FrictionTangent>(*friction);
    addSpringMotions(state.status, *space, *held);
    friction = held;
  }
  if (friction && reduce(*comm_, Teuchos::REDUCE_MAX, friction->symmetric ? 0.0 : 1.0) > 0.0 && friction->symmetric) {
    auto elsewhere = std::make_shared<FrictionTangent>(*friction);
    elsewhere->symmetric = false;
    friction = elsewhere;
  }
  result.matrix = Teuchos::rcp(new InterfaceOperator(space, LocalProblems(locals_.begin(), locals_.end()), friction));
  int applications = 0;
  if (!friction) {
    result.load = residual(rememberedImbalance(state, applications), *space);
    return result;
  }
  Matrix out = rememberedImbalance(state, applications), trace;
  space_->gather(*state.trace, trace);
  addSlipForces(state, trace, out);
  result.load = residual(out, *space, friction.get());
  return result;
}

InterfaceProblem::Evaluation ContactInterfaceProblem::evaluateSet(const InterfaceState& state, PairResolution resolution) const {
  Evaluation result;
  const Matrix out = rememberedImbalance(state, result.applications);
  Matrix trace;
  space_->gather(*state.trace, trace);
  const Vector force = clusters_->forces(state.status[0], out.col(0));
  const Vector moved = movedRows(state), gap = clusters_->gaps(trace.col(0), moved);

  result.next = state.status;
  if (bodies_) {
    const int pairs = static_cast<int>(rows_.size());
    Matrix values(pairs, 3);
    values << force.head(pairs), -gap.head(pairs), Vector::Zero(pairs);
    for (int i = 0; i < pairs; ++i) {
      if (!rows_[i].canChange()) continue;
      double digits = std::max(std::abs(clusters_->row(i).gap), moved.size() > 0 ? std::abs(moved(i)) : 0.0);
      for (const int place : clusters_->row(i).places) digits = std::max(digits, std::abs(trace(place, 0)));
      values(i, 2) = kGapDigits * digits;
    }
    const Matrix all = everywhere(values);
    const ClosedSet closed = closedSet(state.status);
    result.force = all.col(0);
    result.penetration = all.col(1);
    for (std::size_t i = 0; i < closed.size(); ++i)
      if (bodies_->rigid().isBound(i)) result.force(static_cast<Eigen::Index>(i)) = 0.0;  // it affects no decision
    for (std::size_t i = 0; i < closed.size(); ++i) (closed[i] ? result.penetration : result.force)(static_cast<Eigen::Index>(i)) = 0.0;
    result.next = statusOf(plainFlips(bodies_->rigid(), laws_, closed, resolution, all.col(2), result));
  }
  double work = 0.0, allWork = 0.0;
  for (int place = 0; place < space_->overlapSize(); ++place)
    if (space_->ownedRow(place) >= 0) work += 0.5 * trace(place, 0) * (out(place, 0) - load_(place, 0));
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, work, Teuchos::outArg(allWork));
  result.energy = constantEnergy_ + allWork - rigidWork(state);
  result.residual = residual(out, *tangents_->of(state.status).space);
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
      if (bodies_) bodies_->addMotion(static_cast<int>(i), *subdomains_[i], state.rigid, freeValues.back());
    }
  });
  return freeValues;
}

InterfaceProblem::Recovered ContactInterfaceProblem::recover(const InterfaceState& state) const {
  Matrix trace;
  space_->gather(*state.trace, trace);
  Matrix out = imbalance(*state.trace);
  if (rubs_) addSlipForces(state, trace, out);
  const Vector force = clusters_->forces(state.status[0], out.col(0));
  const Vector gaps = laws_.restrictSliding() ? clusters_->gaps(trace.col(0), movedRows(state)) : Vector();
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
      if (bodies_) bodies_->addMotion(static_cast<int>(i), subdomain, state.rigid, values);
    }
  });
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (owned_[i]) {
      result.pairs.push_back({rows_[i].pair.id, state.status[0][i], force(static_cast<int>(i))});
      if (rows_[i].restrictsSliding())
        result.pairs.back().tangential =
            cartesian(rows_[i].pair, space_->dimension(), pairForces(static_cast<int>(i), force, gaps).tangential(state.status[0][i]));
    }
  result.energy = reduce(*comm_, Teuchos::REDUCE_SUM, energy) - rigidWork(state);
  return result;
}

}  // namespace suture
