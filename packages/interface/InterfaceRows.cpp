#include <suture/base/Collective.hpp>
#include <suture/base/Point.hpp>
#include <suture/interface/InterfaceRows.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace suture {

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

std::map<int, const ContactRow*> rowsByPair(const std::vector<std::unique_ptr<Subdomain>>& subdomains) {
  std::map<int, const ContactRow*> byPair;
  for (const auto& subdomain : subdomains)
    for (const ContactRow& row : subdomain->mesh().contactRows) byPair.emplace(row.pair.id, &row);
  return byPair;
}

}  // namespace

InterfaceRows::InterfaceRows(const std::vector<std::unique_ptr<Subdomain>>& subdomains, const ContactLaws& laws,
                             std::shared_ptr<const InterfaceSpace> space, const Vector& stiffness)
    : laws_(laws), space_(std::move(space)) {
  std::set<int> mine;
  for (const auto& subdomain : subdomains) {
    const SubdomainMesh& mesh = subdomain->mesh();
    for (const SubdomainMesh::ContactEnd& end : mesh.contactEnds) {
      const auto others = mesh.others(end.node);
      if (end.end == 0 && std::all_of(others.begin(), others.end(), [&](int other) { return other > mesh.id; })) mine.insert(end.pair);
    }
  }
  for (const auto& [id, row] : rowsByPair(subdomains)) {
    owned_.push_back(mine.count(id) > 0);
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
}

void InterfaceRows::reload(const std::vector<std::unique_ptr<Subdomain>>& subdomains) {
  const std::map<int, const ContactRow*> byPair = rowsByPair(subdomains);
  for (int i = 0; i < size(); ++i) {
    ContactRow& own = rows_[static_cast<std::size_t>(i)];
    own = *byPair.at(own.pair.id);
    for (int component = 0; component < static_cast<int>(own.equations.size()); ++component)
      clusters_->setGap(clusters_->rowOf(i, component), own.equations[static_cast<std::size_t>(component)].gap);
  }
}

ContactStates InterfaceRows::allPressed() const {
  ContactStates states(1);
  for (int i = 0; i < size(); ++i) states[0].push_back(pressed(i));
  return states;
}

Matrix InterfaceRows::everywhere(const Matrix& ofRows, int pairs) const {
  Matrix mine = Matrix::Zero(pairs, ofRows.cols()), all = mine;
  for (int i = 0; i < size(); ++i)
    if (isOwned(i)) mine.row(row(i).pair.id) = ofRows.row(i);
  Teuchos::reduceAll(*space_->comm(), Teuchos::REDUCE_SUM, static_cast<int>(mine.size()), mine.data(), all.data());
  return all;
}

std::vector<int> InterfaceRows::differing(const ContactStates& a, const ContactStates& b) const {
  std::vector<int> mine;
  for (std::size_t i = 0; i < rows_.size(); ++i)
    if (a[0][i] != b[0][i]) mine.push_back(rows_[i].pair.id);
  return unionOverRanks(*space_->comm(), mine);
}

Point InterfaceRows::slipOf(int i, const Vector& gaps) const {
  Point slip{0, 0, 0};
  for (int component = 1; component <= 2; ++component)
    if (const int tangent = clusters_->rowOf(i, component); tangent >= 0) slip[component] = -gaps(tangent);
  return slip;
}

PairForces InterfaceRows::pairForces(int i, const Vector& force, const Vector& gaps) const {
  PairForces pair;
  pair.normal = force(i);
  pair.gap = gaps(i);
  pair.slip = slipOf(i, gaps);
  for (int component = 1; component <= 2; ++component)
    if (const int tangent = clusters_->rowOf(i, component); tangent >= 0) {
      pair.held[component] = force(tangent);
      pair.isPrescribed[static_cast<std::size_t>(component)] = clusters_->row(tangent).places.empty();
    }
  return pair;
}

double InterfaceRows::digits(int i, const Matrix& trace, const Vector& moved) const {
  double most = std::max(std::abs(clusters_->row(i).gap), moved.size() > 0 ? std::abs(moved(i)) : 0.0);
  for (const int place : clusters_->row(i).places) most = std::max(most, std::abs(trace(place, 0)));
  return most;
}

void InterfaceRows::addSlipForces(const std::vector<ContactState>& states, const Vector& gaps, Matrix& imbalance) const {
  for (int i = 0; i < size(); ++i) {
    const ContactState& own = states[static_cast<std::size_t>(i)];
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

}  // namespace suture
