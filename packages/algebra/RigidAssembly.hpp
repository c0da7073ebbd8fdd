#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// A part whose motions are combinations of some modes: its unknowns, the values of the modes there (columns of order one), and rows that
/// must vanish (supports).
struct RigidMember {
  std::vector<GlobalId> dofs;
  Matrix modes;  ///< dofs x k
  Matrix held;   ///< any number of rows x k
};

/// Coefficients of all motions of several parts that agree at common unknowns and vanish in the held rows: sum of k rows (part by part) x
/// number of motions. Also finds hinges between two parts. Computed as the null space of a small matrix. Local.
Matrix commonRigidMotions(const std::vector<RigidMember>& parts);

}  // namespace suture
