#pragma once
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/base/Types.hpp>
#include <suture/constraints/ContactLaw.hpp>
#include <suture/constraints/ContactRow.hpp>

#include <array>
#include <vector>

namespace suture {

/// The unilateral conditions of a group in its free unknowns v: row . v <= gap, a row (u_A - u_B) . n a pair. Rows along the tangents
/// follow, for pairs whose laws restrict sliding. The gap contains the part of prescribed components; along a tangent it is the slip before
/// the load step. A row may be empty (both nodes held): it cannot change.
struct ContactRows {
  SparseMatrix rows;                  ///< rows x free unknowns: the normal rows of all pairs, then those of tangents
  Vector gap;                         ///< gap of each row [length]
  std::vector<int> pairIds;           ///< numbers of the pairs in the scene
  std::vector<int> lines;             ///< contact line or surface of each pair
  bool surfaces = false;              ///< pairs of one line lie on a surface, in no order
  std::vector<ContactState> pressed;  ///< state of each pair in a set of closed pairs: without friction, but for pairs that never open
  std::vector<std::array<int, 2>> tangents;  ///< rows of each pair along its tangents, -1: none; empty where no law restricts sliding
  int size() const { return static_cast<int>(pairIds.size()); }  ///< number of pairs
  /// Row of a pair along a component of its frame; -1: none.
  int rowOf(int pair, int component) const {
    return component == 0     ? pair
           : tangents.empty() ? -1
                              : tangents[static_cast<std::size_t>(pair)][static_cast<std::size_t>(component - 1)];
  }
};

/// State of a row's pair in a set of closed pairs: without friction, but for pairs that never open; open where nothing can change.
inline ContactState pressedState(const ContactRow& row, const ContactLaw& law) {
  if (!law.separates()) return law.pressed();
  if (!row.able()) return {};
  return row.restrictsSliding() ? ContactState(PairStatus::Slip) : law.pressed();
}

}  // namespace suture
