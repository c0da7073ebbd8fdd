#pragma once
#include <suture/interface/ContactClusters.hpp>
#include <suture/interface/InterfaceSpace.hpp>
#include <suture/interface/InterfaceState.hpp>
#include <suture/interface/PairForces.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/pairs/ContactRow.hpp>
#include <suture/subdomain/Subdomain.hpp>

#include <memory>
#include <vector>

namespace suture {

/// The contact pairs that this rank sees, as rows between interface unknowns, and which of them it owns: each pair has one owner.
/// ContactStates here are one list with a state for each of these pairs.
class InterfaceRows {
 public:
  /// \param laws       must outlive it
  /// \param space      without relations
  /// \param stiffness  diagonal of the assembled matrix on the overlap
  /// Local.
  InterfaceRows(const std::vector<std::unique_ptr<Subdomain>>& subdomains, const ContactLaws& laws,
                std::shared_ptr<const InterfaceSpace> space, const Vector& stiffness);
  InterfaceRows(const InterfaceRows&) = delete;
  InterfaceRows& operator=(const InterfaceRows&) = delete;

  int size() const { return static_cast<int>(rows_.size()); }
  const ContactRow& row(int i) const { return rows_[static_cast<std::size_t>(i)]; }
  const std::vector<ContactRow>& all() const { return rows_; }
  const std::vector<char>& owned() const { return owned_; }
  bool isOwned(int i) const { return owned_[static_cast<std::size_t>(i)] != 0; }
  const ContactClusters& clusters() const { return *clusters_; }
  /// Takes the current gaps and histories of the pairs. Local.
  void reload(const std::vector<std::unique_ptr<Subdomain>>& subdomains);

  /// The state of a pair that is pressed together.
  ContactState pressed(int i) const { return pressedState(row(i), laws_.of(row(i).pair.line)); }
  ContactStates allPressed() const;
  /// Sums values of owned rows over all ranks, by pair id. Collective. \param pairs  number of pairs over all ranks
  Matrix everywhere(const Matrix& ofRows, int pairs) const;
  /// Ids of pairs whose states differ, ascending, the same on all ranks. Collective.
  std::vector<int> differing(const ContactStates& a, const ContactStates& b) const;

  /// Gaps of all rows (ContactClusters::gaps) for a trace on the overlap. Local.
  Vector gaps(const Matrix& trace, const Vector& moved) const { return clusters_->gaps(trace.col(0), moved); }
  /// Forces and displacements of a pair. \param force, gaps  of all rows
  PairForces pairForces(int i, const Vector& force, const Vector& gaps) const;
  /// Magnitude of the displacements whose difference is the gap of a pair. [length] \param trace  on the overlap \param moved  of all rows
  double digits(int i, const Matrix& trace, const Vector& moved) const;
  /// Adds the known tangential forces of slipping pairs and the forces of transverse springs to an imbalance. \param gaps  of all rows
  void addSlipForces(const std::vector<ContactState>& states, const Vector& gaps, Matrix& imbalance) const;

 private:
  /// Tangential jumps of a row's pair, by component.
  Point slipOf(int i, const Vector& gaps) const;

  const ContactLaws& laws_;
  std::shared_ptr<const InterfaceSpace> space_;
  std::vector<ContactRow> rows_;  // by pair
  std::vector<char> owned_;
  std::unique_ptr<ContactClusters> clusters_;
};

}  // namespace suture
