#include <suture/algebra/RigidAssembly.hpp>
#include <suture/condensed/ContactGroup.hpp>
#include <suture/subdomain/SchurComplement.hpp>

#include <algorithm>
#include <map>

namespace suture {

ContactGroup::ContactGroup(const Parts& parts) : id_(parts.id), members_(parts.members), solver_(parts.solver), boundary_(parts.boundary) {
  number(boundary_);
  assemble();
  collectRows(parts.laws);

  std::vector<int> interiorNodes;
  for (int i : interiorPositions_) interiorNodes.push_back(nodeOf_[i]);
  const Matrix kernel = rowsAt(rigidKernel(true), interiorPositions_);
  heldInverse_ = std::make_unique<GeneralisedInverse>(block(stiffness_, interiorPositions_, interiorPositions_), kernel, interiorNodes,
                                                      solver_, "contact group " + std::to_string(id_ + 1) + ", boundary held");
  held_ = std::make_unique<ContactCompliance>(*heldInverse_, interiorRows_);
}

int ContactGroup::placeOf(GlobalId dof) const {
  const auto found = std::lower_bound(globalDofs_.begin(), globalDofs_.end(), dof);
  if (found == globalDofs_.end() || *found != dof)
    throw InternalError("an unknown of a contact group's boundary or of its pairs belongs to none of its members");
  return static_cast<int>(found - globalDofs_.begin());
}

void ContactGroup::number(const std::vector<GlobalId>& boundary) {
  for (const Member& member : members_)
    for (int i = 0; i < member.subdomain->dofs(); ++i) globalDofs_.push_back(member.subdomain->globalDof(i));
  std::sort(globalDofs_.begin(), globalDofs_.end());
  globalDofs_.erase(std::unique(globalDofs_.begin(), globalDofs_.end()), globalDofs_.end());
  nodeOf_.resize(globalDofs_.size());
  for (const Member& member : members_) {
    positions_.emplace_back();
    for (int i = 0; i < member.subdomain->dofs(); ++i) {
      positions_.back().push_back(placeOf(member.subdomain->globalDof(i)));
      nodeOf_[positions_.back().back()] = static_cast<int>(globalDofs_[positions_.back().back()] / member.subdomain->components());
    }
  }
  for (GlobalId dof : boundary) boundaryPositions_.push_back(placeOf(dof));
  interiorPositions_ = complement(dofs(), boundaryPositions_);
}

void ContactGroup::assemble() {
  std::vector<Eigen::Triplet<double>> entries;
  load_ = Vector::Zero(dofs());
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const Subdomain& subdomain = *members_[m].subdomain;
    const std::vector<int>& at = positions_[m];
    const SparseMatrix stiffness = subdomain.stiffness().full();
    for (int j = 0; j < subdomain.dofs(); ++j) {
      load_(at[j]) += subdomain.load()(j);
      for (SparseMatrix::InnerIterator it(stiffness, j); it; ++it) entries.emplace_back(at[it.row()], at[j], it.value());
    }
    constantEnergy_ += subdomain.constantEnergy();
  }
  stiffness_.resize(dofs(), dofs());
  stiffness_.setFromTriplets(entries.begin(), entries.end());
  ib_ = block(stiffness_, interiorPositions_, boundaryPositions_);
  bb_ = block(stiffness_, boundaryPositions_, boundaryPositions_);
}

void ContactGroup::collectRows(const ContactLaws& laws) {
  std::map<int, const ContactRow*> found;  // by pair, so that the order does not depend on the partition
  for (const Member& member : members_) {
    rows_.surfaces = member.subdomain->mesh().dimension == 3;
    for (const ContactRow& row : member.subdomain->mesh().contactRows) found.emplace(row.pair.id, &row);
  }

  std::vector<Eigen::Triplet<double>> entries;
  std::vector<double> gaps;
  const auto add = [&](const ContactRow::Equation& equation) {
    for (std::size_t i = 0; i < equation.dofs.size(); ++i)
      entries.emplace_back(static_cast<int>(gaps.size()), placeOf(equation.dofs[i]), equation.coefficients[i]);
    gaps.push_back(equation.gap);
    return static_cast<int>(gaps.size()) - 1;
  };
  std::vector<const ContactRow*> able;
  for (const auto& [id, row] : found) {
    const ContactLaw& law = laws.of(row->pair.line);
    if (!row->canChange() && law.separates()) {
      idlePairs_.push_back(row->pair);
      continue;
    }
    add(row->normal());
    able.push_back(row);
    pairs_.push_back(row->pair);
    rows_.pairIds.push_back(id);
    rows_.lines.push_back(row->pair.line);
    rows_.pressed.push_back(pressedState(*row, law));
  }
  if (std::any_of(able.begin(), able.end(), [](const ContactRow* row) { return row->restrictsSliding(); }))
    rows_.tangents.assign(able.size(), {-1, -1});
  for (std::size_t i = 0; i < able.size(); ++i)
    for (std::size_t k = 1; k < able[i]->equations.size(); ++k) rows_.tangents[i][k - 1] = add(able[i]->equations[k]);
  rows_.rows.resize(static_cast<int>(gaps.size()), dofs());
  rows_.rows.setFromTriplets(entries.begin(), entries.end());
  rows_.gap = Eigen::Map<const Vector>(gaps.data(), static_cast<int>(gaps.size()));

  interiorRows_ = rows_;
  std::vector<int> all(gaps.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<int>(i);
  interiorRows_.rows = block(rows_.rows, all, interiorPositions_);
  if (interiorRows_.rows.nonZeros() != rows_.rows.nonZeros()) throw InternalError("a contact node lies on the boundary of its group");
}

Matrix ContactGroup::rigidKernel(bool boundaryHeld) const {
  std::vector<char> isHeld(dofs(), 0);
  if (boundaryHeld)
    for (int i : boundaryPositions_) isHeld[i] = 1;
  std::vector<RigidMember> parts;
  for (std::size_t m = 0; m < members_.size(); ++m) {
    const Subdomain& subdomain = *members_[m].subdomain;
    std::vector<int> onBoundary;
    for (int i = 0; i < subdomain.dofs(); ++i)
      if (isHeld[positions_[m][i]]) onBoundary.push_back(i);
    RigidMember part;
    part.dofs.assign(positions_[m].begin(), positions_[m].end());
    part.modes = subdomain.rigidModes();
    part.held.resize(subdomain.heldModes().rows() + static_cast<int>(onBoundary.size()), part.modes.cols());
    part.held.topRows(subdomain.heldModes().rows()) = subdomain.heldModes();
    part.held.bottomRows(static_cast<int>(onBoundary.size())) = rowsAt(part.modes, onBoundary);
    parts.push_back(std::move(part));
  }
  const Matrix coefficients = commonRigidMotions(parts);

  Matrix kernel = Matrix::Zero(dofs(), coefficients.cols());
  Eigen::Index first = 0;
  for (std::size_t m = 0; m < parts.size(); ++m) {
    const Matrix motion = parts[m].modes * coefficients.middleRows(first, parts[m].modes.cols());
    for (std::size_t i = 0; i < positions_[m].size(); ++i) kernel.row(positions_[m][i]) = motion.row(static_cast<Eigen::Index>(i));
    first += parts[m].modes.cols();
  }
  return kernel;
}

const ContactCompliance& ContactGroup::floating() const {
  if (!floating_) {
    floatingInverse_ = std::make_unique<GeneralisedInverse>(stiffness_, rigidKernel(false), nodeOf_, solver_,
                                                            "contact group " + std::to_string(id_ + 1) + ", boundary free");
    floating_ = std::make_unique<ContactCompliance>(*floatingInverse_, rows_);
  }
  return *floating_;
}

void ContactGroup::flux(ConstLocalView trace, ConstLocalView interior, LocalView flux) const {
  flux.setZero();
  flux.noalias() += bb_ * trace;
  flux.noalias() += ib_.transpose() * interior;
}

void ContactGroup::interiorLoad(ConstLocalView trace, LocalView load) const {
  load.setZero();
  load.noalias() -= ib_ * trace;
}

Matrix ContactGroup::heldLoad(const Vector& trace) const {
  Matrix load(static_cast<int>(interiorPositions_.size()), 1);
  interiorLoad(trace, load);
  return load + rowsAt(load_, interiorPositions_);
}

ContactGroup::Response ContactGroup::respond(const Vector& trace, const std::vector<ContactState>& start, const Vector& moved) const {
  Matrix v = heldLoad(trace);
  ContactCompliance::State state = doSolve(v, start, moved);
  if (state.status.size() != pairs_.size() || state.force.size() != Eigen::Index(pairs_.size()))
    throw InternalError("a contact group returned " + std::to_string(state.status.size()) + " statuses and " +
                        std::to_string(state.force.size()) + " forces for " + std::to_string(pairs_.size()) + " pairs");
  Response response;
  response.status = std::move(state.status);
  response.force = std::move(state.force);
  return finish(trace, v.col(0), std::move(response));
}

ContactGroup::Response ContactGroup::respondLinear(const Vector& trace, const ContactCompliance::Closed& closed,
                                                   const Vector& moved) const {
  Matrix v = heldLoad(trace);
  Response response;
  Matrix force;
  closed.solve(v, 1.0, &force, moved);
  response.status = closed.status();
  response.force = force.col(0);
  return finish(trace, v.col(0), std::move(response));
}

void ContactGroup::place(const Vector& trace, const Vector& interior, Response& response) const {
  response.displacement = Vector(dofs());
  for (std::size_t i = 0; i < interiorPositions_.size(); ++i) response.displacement(interiorPositions_[i]) = interior(i);
  for (std::size_t i = 0; i < boundaryPositions_.size(); ++i) response.displacement(boundaryPositions_[i]) = trace(i);
}

ContactGroup::Response ContactGroup::finish(const Vector& trace, const Vector& interior, Response response) const {
  place(trace, interior, response);
  Matrix own(trace.size(), 1);
  flux(trace, interior, own);
  response.flux = own - rowsAt(load_, boundaryPositions_);
  response.energy =
      constantEnergy_ + 0.5 * response.displacement.dot(stiffness_ * response.displacement) - response.displacement.dot(load_);
  return response;
}

namespace {

/// Solved by StateSearch.
class ExactGroup final : public ContactGroup {
 public:
  using ContactGroup::ContactGroup;

 protected:
  ContactCompliance::State doSolve(LocalView v, const std::vector<ContactState>& start, const Vector& moved) const override {
    return held().solve(v, start, moved);
  }
};

}  // namespace

void registerBuiltIns(Registry<ContactGroup>& registry) {
  registry.add("Exact", Schema("Finds the closed pairs exactly, for any initial status."),
               [](const ContactGroup::Parts& parts, const Parameters&) { return std::make_unique<ExactGroup>(parts); });
}

}  // namespace suture
