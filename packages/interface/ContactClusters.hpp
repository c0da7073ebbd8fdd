#pragma once
#include <suture/base/Types.hpp>
#include <suture/constraints/ContactState.hpp>
#include <suture/interface/InterfaceSpace.hpp>

#include <array>
#include <utility>
#include <vector>

namespace suture {

/// The contact rows that one rank sees, as equations between interface unknowns: row . v <= gap, or row . v = gap along tangents. Rows that
/// share an unknown (a node in several pieces) make a cluster and are treated together; most clusters are a single row between two normal
/// components. Local; every rank that sees a cluster sees all of it and comes to the same result.
class ContactClusters {
 public:
  struct Row {
    std::vector<int> places;  ///< places of the unknowns in the overlap, a mortar's carrying one first; none: nothing can change
    std::vector<double> coefficients;
    double gap = 0.0;   ///< [length]
    int cluster = 0;    ///< any number that the rows of a cluster share
    int pair = -1;      ///< place of the state that decides about the row; -1: that of the row itself
    int component = 0;  ///< in the pair's frame: 0 the normal, others hold where the pair sticks (ContactState::holds)
    double size = 1.0;  ///< tributary length or area of the pair
  };

  /// \param stiffness  of each unknown of the overlap: diagonal of the assembled matrix. What has to give, the softer side gives.
  ContactClusters(std::vector<Row> rows, Vector stiffness);

  int size() const { return static_cast<int>(rows_.size()); }
  const Row& row(int i) const { return rows_[i]; }
  void setGap(int row, double gap) { rows_[row].gap = gap; }

  /// `status`: states of the pairs, here and below. Rows that their pair's state closes as equations solved for one unknown each, by
  /// elimination within the cluster; a row that follows from the others is left out.
  /// \param test  gets the same of the rows in which normal forces drag: those of the virtual displacements; empty if nothing drags
  std::vector<InterfaceRelation> relations(const std::vector<ContactState>& status, std::vector<InterfaceRelation>* test = nullptr) const;

  /// gap - row . v of every row. [length]
  /// \param moved  what rigid motions beside the trace add to row . v; empty: nothing
  Vector gaps(const Vector& trace, const Vector& moved = {}) const;
  /// 1 / (row K^-1 row^T), the harmonic mean of the two sides' stiffnesses: the complementarity constant of a row. [force / length]
  const Vector& stiffness() const { return rowStiffness_; }
  /// Forces of the closed rows that balance `imbalance` (internal less external forces of every unknown) best, weighted by compliance:
  /// for a single pair the force that the softer side feels. > 0 compressive; 0 for open rows. The force of a normal row that drags brings
  /// friction times itself along the tangents, which is not among those of the tangential rows. [force]
  Vector forces(const std::vector<ContactState>& status, const Vector& imbalance) const;
  /// Change of the trace, smallest in the energy of the diagonal, that makes closed rows hold exactly. Zero where they do already.
  Vector correction(const std::vector<ContactState>& status, const Vector& trace, const Vector& moved = {}) const;

  /// Row of a pair and a component; -1: it has none.
  int rowOf(int pair, int component) const;

 private:
  using Sparse = std::vector<std::pair<int, double>>;  // place, coefficient; places ascend
  class Elimination;
  /// A row as forces of its pair act: the normal one of a pair that slips with the tangents along which it drags.
  Row withDrag(int row, const std::vector<ContactState>& status) const;
  std::vector<int> closedRows(const std::vector<int>& cluster, const std::vector<ContactState>& status) const;
  /// Solution of a system with C K^-1 C^T of some rows of a cluster.
  Vector solve(const std::vector<const Row*>& rows, const Vector& rhs) const;

  std::vector<Row> rows_;
  Vector stiffness_, rowStiffness_;
  std::vector<std::vector<int>> clusters_;      // rows of each
  std::vector<std::array<int, 2>> tangentsOf_;  // rows of each pair along the tangents; empty if there are none
};

}  // namespace suture
