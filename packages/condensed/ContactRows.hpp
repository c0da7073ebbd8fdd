#pragma once
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/base/Types.hpp>
#include <suture/pairs/ContactState.hpp>

#include <array>
#include <vector>

namespace suture {

/// The unilateral conditions of a group in its free unknowns v: row . v <= gap, with one row (u_A - u_B) . n per pair, followed by
/// tangential rows for pairs whose laws restrict sliding. The gap includes the part of prescribed components; along a tangent it is the
/// slip before the load step. A row is empty if both nodes are held: it cannot change.
struct ContactRows {
  SparseMatrix rows;                  ///< rows x free unknowns: the normal rows of all pairs, then those of tangents
  Vector gap;                         ///< gap of each row [length]
  std::vector<int> pairIds;           ///< numbers of the pairs in the scene
  std::vector<int> lines;             ///< contact line or surface of each pair
  bool surfaces = false;              ///< pairs of one line lie on a surface and are not ordered
  std::vector<ContactState> pressed;  ///< state of each pair in a set of closed pairs: without friction, except for pairs that never open
  std::vector<std::array<int, 2>> tangents;  ///< tangential rows of each pair, -1: none; empty if no law restricts sliding
  int size() const { return static_cast<int>(pairIds.size()); }
  /// Row of a pair for a component of its frame; -1: none.
  int rowOf(int pair, int component) const {
    return component == 0     ? pair
           : tangents.empty() ? -1
                              : tangents[static_cast<std::size_t>(pair)][static_cast<std::size_t>(component - 1)];
  }
};

}  // namespace suture
