#include <suture/base/Collective.hpp>
#include <suture/base/Progress.hpp>
#include <suture/condensed/CondensedProblem.hpp>
#include <suture/condensed/GroupPairs.hpp>
#include <suture/interface/SeamLayout.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <map>

namespace suture {

namespace {

/// Local problem that a subdomain belongs to: itself, or its contact group.
int problemOf(const Partition& partition, int subdomain) {
  return partition.groupOf[subdomain] < 0 ? subdomain : partition.subdomains() + partition.groupOf[subdomain];
}

/// Free unknowns of a subdomain at nodes shared with another local problem.
std::vector<int> boundaryDofs(const Subdomain& subdomain, const Partition& partition) {
  const SubdomainMesh& mesh = subdomain.mesh();
  const int own = problemOf(partition, mesh.id);
  std::vector<int> dofs;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const auto others = mesh.others(node);
    if (std::none_of(others.begin(), others.end(), [&](int other) { return problemOf(partition, other) != own; })) continue;
    for (int k = 0; k < subdomain.components(); ++k)
      if (subdomain.dof(node, k) >= 0) dofs.push_back(subdomain.dof(node, k));
  }
  return dofs;
}

double sumOver(const Comm& comm, double mine) {
  double all = 0.0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

int sumOver(const Comm& comm, int mine) {
  int all = 0;
  Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

int closedPairs(const std::vector<ContactState>& status) {
  return static_cast<int>(std::count_if(status.begin(), status.end(), [](const ContactState& s) { return s.closed(); }));
}

/// Adds tangential forces to the pairs of the group, which are the last ones in the list.
void addTangentialForces(const ContactGroup& group, const ContactGroup::Response& response, const Vector& moved,
                         std::vector<PairForce>& pairs) {
  const std::vector<PairForces> own = pairForces(group, response, moved);
  const std::size_t first = pairs.size() - own.size();
  for (std::size_t p = 0; p < own.size(); ++p)
    pairs[first + p].tangential =
        cartesian(group.pairs()[p], group.members().front().subdomain->components(), own[p].tangential(response.status[p]));
}

}  // namespace

CondensedProblem::CondensedProblem(CommPtr comm, const Partition& partition, const std::vector<std::unique_ptr<Subdomain>>& subdomains,
                                   const LocalSolverMaker& solver, const SchurMaker& schur, ContactLaws laws, const GroupMaker& make)
    : comm_(std::move(comm)), subdomains_(subdomains), laws_(std::move(laws)), subdomainCount_(partition.subdomains()) {
  InterfaceLayout layout;
  const double softest = softestStiffness(*comm_, subdomains);
  collectively(*comm_, "factoring subdomains and contact groups", [&] {
    std::map<int, std::vector<int>> members;
    for (std::size_t s = 0; s < subdomains.size(); ++s) {
      Progress::count("subdomains", static_cast<long>(subdomains.size()));
      const Subdomain& subdomain = *subdomains[s];
      const std::vector<int> boundary = boundaryDofs(subdomain, partition);
      addUnknowns(subdomain, boundary, layout);
      const int id = subdomain.mesh().id;
      if (partition.groupOf[id] >= 0) {
        members[partition.groupOf[id]].push_back(static_cast<int>(s));
        continue;
      }
      plainSubdomain_.push_back(static_cast<int>(s));
      plain_.push_back(std::make_shared<SubdomainProblem>(id, subdomain, boundary, solver, schur(), softest));
      layout.boundaries.push_back(plain_.back()->boundary());
      layout.locals.push_back(id);
    }
    for (const auto& [group, places] : members) {
      std::vector<ContactGroup::Member> all;
      std::vector<GlobalId> boundary;
      for (int s : places) {
        all.push_back({subdomains[s].get()});
        for (int dof : boundaryDofs(*subdomains[s], partition)) boundary.push_back(subdomains[s]->globalDof(dof));
      }
      if (all.size() != partition.groups[group].size()) throw InternalError("a contact group is spread over several ranks");
      std::sort(boundary.begin(), boundary.end());
      boundary.erase(std::unique(boundary.begin(), boundary.end()), boundary.end());
      const ContactGroup::Parts parts{group, std::move(all), boundary, solver, laws_};
      groups_.push_back(make ? make(parts) : Registry<ContactGroup>::instance().make("Exact", parts, Parameters()));
      groupMembers_.push_back(places);
      layout.boundaries.push_back(boundary);
      layout.locals.push_back(partition.subdomains() + group);
    }
    addSeams(
        subdomains, [&](int subdomain) { return problemOf(partition, subdomain); }, layout);
  });
  space_ = std::make_shared<InterfaceSpace>(comm_, layout);
  for (int line = 0; line < laws_.size(); ++line) allSeparate_ = allSeparate_ && laws_.of(line).separates();
  int mine = 0;
  for (const auto& group : groups_)
    for (const int line : group->rows().lines) mine += laws_.of(line).separates();
  pairs_ = sumOver(*comm_, mine);
  for (const auto& pieces : partition.piecesOf) pieces_ += static_cast<int>(pieces.size());
  linearised_.resize(groups_.size());
  if (pairs_ > 0) contact_ = std::make_unique<CondensedPairs>(*comm_, *this, subdomains_);
}

Vector CondensedProblem::movedRows(int group, const InterfaceState& state) const {
  return contact_ ? contact_->movedRows(group, state) : Vector();
}

std::shared_ptr<const LinearisedGroup> CondensedProblem::linearised(int group, const std::vector<ContactState>& status) const {
  auto& kept = linearised_[group];
  if (!kept || kept->status() != status)
    kept = std::make_shared<const LinearisedGroup>(subdomainCount_ + groups_[group]->id(), *groups_[group], status);
  return kept;
}

void CondensedProblem::rememberPath(const std::vector<BodyForces>& carried) {
  if (contact_) contact_->bodies().remember(carried);
}

double CondensedProblem::addPlain(const std::vector<Vector>& trace, Matrix& force) const {
  double energy = 0.0;
  collectively(*comm_, "applying the subdomains without contact", [&] {
    for (std::size_t i = 0; i < plain_.size(); ++i) {
      Matrix flux(trace[i].size(), 1);
      plain_[i]->applySchur(trace[i], flux);
      const Vector load = plain_[i]->condensedLoad();
      energy += plain_[i]->constantEnergy() + trace[i].dot(0.5 * flux.col(0) - load);
      space_->coupling(static_cast<int>(i)).addTransposed(load - flux.col(0), force);
    }
  });
  return energy;
}

double CondensedProblem::addLinear(const InterfaceState& state, const std::vector<Vector>& trace, Matrix& force,
                                   const EachGroup& each) const {
  double energy = addPlain(trace, force);
  collectively(*comm_, "solving the contact groups with given states of their pairs", [&] {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const int number = static_cast<int>(g), place = placeOfGroup(number);
      const Vector moved = movedRows(number, state);
      const auto group = linearised(number, state.status[place]);
      const ContactGroup::Response response = groups_[g]->respondLinear(trace[place], group->held(), moved);
      energy += response.energy;
      space_->coupling(place).addTransposed(-response.flux, force);
      if (each) each(number, response, moved);
    }
  });
  return energy;
}

void CondensedProblem::addPlainEnergies(const std::vector<Vector>& trace, const std::function<void(int, double)>& add) const {
  for (std::size_t i = 0; i < plain_.size(); ++i) {
    Matrix flux(trace[i].size(), 1);
    plain_[i]->applySchur(trace[i], flux);
    add(plainSubdomain_[i], trace[i].dot(flux.col(0)));
  }
}

InterfaceState CondensedProblem::initialState() const {
  InterfaceState state;
  state.trace = space_->vector();
  state.status.resize(plain_.size());
  for (const auto& group : groups_) state.status.push_back(group->rows().pressed);
  return state;
}

InterfaceState CondensedProblem::stateOf(const std::vector<Vector>& freeValues, const std::map<int, ContactState>& status) const {
  InterfaceState state = initialState();
  auto owned = localView(*state.trace);
  for (std::size_t s = 0; s < subdomains_.size(); ++s)
    for (int dof = 0; dof < subdomains_[s]->dofs(); ++dof) {
      const auto at = space_->map()->getLocalElement(subdomains_[s]->globalDof(dof));
      if (at >= 0) owned(at, 0) = freeValues[s](dof);
    }
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (int row = 0; row < groups_[g]->rows().size(); ++row)
      if (const auto found = status.find(groups_[g]->rows().pairIds[row]); found != status.end())
        state.status[plain_.size() + g][row] = found->second;
  return state;
}

std::vector<Vector> CondensedProblem::traces(const MultiVector& trace) const {
  Matrix overlap;
  space_->gather(trace, overlap);
  std::vector<Vector> all;
  for (int i = 0; i < space_->locals(); ++i) {
    Matrix local(space_->coupling(i).rows(), 1);
    space_->coupling(i).restrictTo(overlap, local);
    all.emplace_back(local.col(0));
  }
  return all;
}

std::vector<int> CondensedProblem::differing(const ContactStates& a, const ContactStates& b) const {
  std::vector<int> mine;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (int row = 0; row < groups_[g]->rows().size(); ++row)
      if (a[plain_.size() + g][row] != b[plain_.size() + g][row]) mine.push_back(groups_[g]->rows().pairIds[row]);
  return unionOverRanks(*comm_, mine);
}

InterfaceProblem::Evaluation CondensedProblem::evaluate(const InterfaceState& state, double) const {
  const std::vector<Vector> trace = traces(*state.trace);
  Matrix force = Matrix::Zero(static_cast<int>(space_->overlap()->getNodeNumElements()), 1);
  Evaluation result;
  result.next.resize(plain_.size());
  double energy = addPlain(trace, force);
  int changed = 0, active = 0;
  collectively(*comm_, "solving the local contact problems", [&] {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const std::size_t i = plain_.size() + g;
      ContactGroup::Response response = groups_[g]->respond(trace[i], state.status[i], movedRows(static_cast<int>(g), state));
      energy += response.energy;
      space_->coupling(static_cast<int>(i)).addTransposed(-response.flux, force);
      for (std::size_t p = 0; p < response.status.size(); ++p) changed += response.status[p] != state.status[i][p];
      active += closedPairs(response.status);
      result.next.push_back(std::move(response.status));
    }
  });
  result.residual = space_->vector();
  space_->scatterAdd(force, *result.residual);
  result.energy = sumOver(*comm_, energy) - (contact_ ? contact_->rigidWork(state) : 0.0);
  result.changed = sumOver(*comm_, changed);
  result.active = sumOver(*comm_, active);
  return result;
}

InterfaceProblem::Linearisation CondensedProblem::linearise(const InterfaceState& state) const {
  LocalProblems locals(plain_.begin(), plain_.end());
  collectively(*comm_, "linearising the contact groups", [&] {
    for (std::size_t g = 0; g < groups_.size(); ++g)
      locals.push_back(linearised(static_cast<int>(g), state.status[placeOfGroup(static_cast<int>(g))]));
  });
  Linearisation result;
  result.matrix = Teuchos::rcp(new InterfaceOperator(space_, locals));
  Matrix force = Matrix::Zero(space_->overlapSize(), 1);
  addLinear(state, traces(*state.trace), force);
  result.load = space_->vector();
  space_->scatterAdd(force, *result.load);
  return result;
}

Teuchos::RCP<InterfaceOperator> CondensedProblem::withoutContact() const {
  LocalProblems locals(plain_.begin(), plain_.end());
  locals.resize(plain_.size() + groups_.size());
  return Teuchos::rcp(new InterfaceOperator(space_, std::move(locals)));
}

void CondensedProblem::addGroup(int number, const ContactGroup::Response& response, const Vector& moved, std::vector<Vector>& freeValues,
                                std::vector<PairForce>& pairs) const {
  const ContactGroup& group = *groups_[number];
  for (std::size_t m = 0; m < group.members().size(); ++m) {
    Vector& values = freeValues[groupMembers_[number][m]];
    values = Vector(group.members()[m].subdomain->dofs());
    for (Eigen::Index k = 0; k < values.size(); ++k) values(k) = response.displacement(group.positionsOf(static_cast<int>(m))[k]);
  }
  for (std::size_t p = 0; p < group.pairs().size(); ++p) pairs.push_back({group.pairs()[p].id, response.status[p], response.force(p)});
  if (laws_.restrictSliding()) addTangentialForces(group, response, moved, pairs);
  for (const ContactPair& pair : group.idlePairs()) pairs.push_back({pair.id, PairStatus::Open, 0.0});
}

std::optional<BrokenField> CondensedProblem::brokenField(const InterfaceState& state, const std::vector<Vector>& corrections) const {
  std::vector<Vector> trace = traces(*state.trace);
  for (std::size_t i = 0; i < corrections.size(); ++i) trace[i] += corrections[i];
  BrokenField result;
  result.freeValues.resize(subdomains_.size());
  Matrix force = Matrix::Zero(space_->overlapSize(), 1);
  double largest = 0.0;
  const auto add = [&](std::size_t place, const Vector& flux) {
    if (flux.size() > 0) largest = std::max(largest, flux.lpNorm<Eigen::Infinity>());
    space_->coupling(static_cast<int>(place)).addTransposed(-flux, force);
  };
  collectively(*comm_, "recovering the interiors", [&] {
    for (std::size_t i = 0; i < plain_.size(); ++i) {
      Vector& values = result.freeValues[plainSubdomain_[i]];
      values = plain_[i]->recover(trace[i]);
      add(i, plain_[i]->boundaryForces(values));
    }
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const int number = static_cast<int>(g), place = placeOfGroup(number);
      const Vector moved = movedRows(number, state);
      const ContactGroup::Response response =
          groups_[g]->respondLinear(trace[place], linearised(number, state.status[place])->held(), moved);
      addGroup(number, response, moved, result.freeValues, result.pairs);
      add(static_cast<std::size_t>(place), response.flux);
    }
  });
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MAX, largest, Teuchos::outArg(result.largestForce));
  result.residual = space_->vector();
  space_->scatterAdd(force, *result.residual);
  return result;
}

InterfaceProblem::Recovered CondensedProblem::recover(const InterfaceState& state) const {
  const std::vector<Vector> trace = traces(*state.trace);
  Recovered result;
  result.freeValues.resize(subdomains_.size());
  double energy = 0.0;
  collectively(*comm_, "recovering the interiors", [&] {
    for (std::size_t i = 0; i < plain_.size(); ++i) {
      Vector& values = result.freeValues[plainSubdomain_[i]];
      values = plain_[i]->recover(trace[i]);
      const Subdomain& subdomain = plain_[i]->subdomain();
      energy += 0.5 * values.dot(subdomain.stiffness() * values) - values.dot(subdomain.load()) + subdomain.constantEnergy();
      if (contact_) contact_->bodies().addMotion(plainSubdomain_[i], subdomain, state.rigid, values);
    }
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const ContactGroup& group = *groups_[g];
      const std::size_t i = plain_.size() + g;
      const int number = static_cast<int>(g);
      const Vector moved = movedRows(number, state);
      const ContactGroup::Response response = isGiven() ? group.respondLinear(trace[i], linearised(number, state.status[i])->held(), moved)
                                                        : group.respond(trace[i], state.status[i], moved);
      energy += response.energy;
      addGroup(number, response, moved, result.freeValues, result.pairs);
      if (!contact_) continue;
      for (std::size_t m = 0; m < group.members().size(); ++m) {
        const int place = groupMembers_[g][m];
        contact_->bodies().addMotion(place, *group.members()[m].subdomain, state.rigid, result.freeValues[place]);
      }
    }
  });
  result.energy = sumOver(*comm_, energy) - (contact_ ? contact_->rigidWork(state) : 0.0);
  return result;
}

}  // namespace suture
