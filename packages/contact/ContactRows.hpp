#pragma once
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/base/Types.hpp>
#include <suture/constraints/ContactState.hpp>

#include <vector>

namespace suture {

/// The unilateral conditions of a group in its free unknowns v: row . v <= gap, a row (u_A - u_B) . n a pair. What prescribed components
/// contribute is in the gap. A row may be empty (both nodes held): such a pair cannot change and is left out of the local problem.
struct ContactRows {
  SparseMatrix rows;                  ///< pairs x free unknowns
  Vector gap;                         ///< [length]
  std::vector<int> pairIds;           ///< numbers of the pairs in the scene
  std::vector<int> lines;             ///< contact line or surface of each pair
  bool surfaces = false;              ///< pairs of one line lie on a surface, in no order
  std::vector<ContactState> pressed;  ///< state of each pair where it is closed (ContactLaw::pressed)
  int size() const { return static_cast<int>(pairIds.size()); }
};

}  // namespace suture
