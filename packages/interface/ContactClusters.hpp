#pragma once
#include <suture/base/Types.hpp>
#include <suture/interface/InterfaceSpace.hpp>
#include <suture/pairs/ContactState.hpp>

#include <array>
#include <utility>
#include <vector>

namespace suture {

/// The contact rows that one rank sees, as equations between interface unknowns: row . v <= gap, or row . v = gap along tangents. Rows that
/// share an unknown (a node in several pieces) form a cluster and are treated together; most clusters are a single row between two normal
/// components. Local; a rank sees a cluster completely or not at all, and all ranks that see it get the same result.
class ContactClusters {
 public:
  struct Row {
    std::vector<int> places;  ///< places of the unknowns in the overlap, the carrying one of a mortar first; empty: nothing can change
    std::vector<double> coefficients;
    double gap = 0.0;   ///< [length]
    int cluster = 0;    ///< any number that the rows of a cluster share
    int pair = -1;      ///< place of the pair state that governs the row; -1: the row's own place
    int component = 0;  ///< in the pair's frame: 0 the normal; others are closed if the pair sticks (ContactState::holds)
    double size = 1.0;  ///< tributary length or area of the pair
  };

  /// \param stiffness  of each unknown of the overlap: diagonal of the assembled matrix. Corrections of the trace move mainly the softer
  /// side.
  ContactClusters(std::vector<Row> rows, Vector stiffness);

  int size() const { return static_cast<int>(rows_.size()); }
  const Row& row(int i) const { return rows_[i]; }
  void setGap(int row, double gap) { rows_[row].gap = gap; }

  /// Rows closed by their pair's state, as equations solved for one unknown each by elimination within the cluster; redundant rows are
  /// omitted. `status` here and below: states of the pairs.
  /// \param test  receives the relations of the virtual displacements if normal forces produce friction; else empty
  std::vector<InterfaceRelation> relations(const std::vector<ContactState>& status, std::vector<InterfaceRelation>* test = nullptr) const;

  /// gap - row . v of each row. [length]
  /// \param moved  contribution of rigid motions, which the trace does not contain, to row . v; empty: none
  Vector gaps(const Vector& trace, const Vector& moved = {}) const;
  /// 1 / (row K^-1 row^T), the stiffness of both sides in series: the complementarity constant of a row. [force / length]
  const Vector& stiffness() const { return rowStiffness_; }
  /// Forces of the closed rows that best balance `imbalance` (internal minus external forces of all unknowns), weighted by compliance: for
  /// a single pair the force on the softer side. > 0 compressive; 0 for open rows. Friction produced by a normal force is part of that
  /// normal row and not included in the forces of tangential rows. [force]
  Vector forces(const std::vector<ContactState>& status, const Vector& imbalance) const;
  /// Change of the trace, smallest in the energy norm of the diagonal, after which closed rows hold exactly. Zero if they hold already.
  Vector correction(const std::vector<ContactState>& status, const Vector& trace, const Vector& moved = {}) const;

  /// Row of a pair for a component; -1: none.
  int rowOf(int pair, int component) const;

 private:
  using Sparse = std::vector<std::pair<int, double>>;  // place, coefficient; ascending places
  class Elimination;
  /// The row in the direction of its pair's force: for a slipping pair, the normal row with the tangential components of friction.
  Row withFriction(int row, const std::vector<ContactState>& status) const;
  std::vector<int> closedRows(const std::vector<int>& cluster, const std::vector<ContactState>& status) const;
  /// Solves a system with C K^-1 C^T for some rows of a cluster.
  Vector solve(const std::vector<const Row*>& rows, const Vector& rhs) const;

  std::vector<Row> rows_;
  Vector stiffness_, rowStiffness_;
  std::vector<std::vector<int>> clusters_;      // rows of each cluster
  std::vector<std::array<int, 2>> tangentsOf_;  // tangential rows of each pair; empty if there are none
};

}  // namespace suture
