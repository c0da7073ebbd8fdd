#pragma once
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// A part that moves as the combinations of some modes: its unknowns, the modes' values there (columns of the order of one), and rows that
/// must vanish (what holds it).
struct RigidMember {
  std::vector<GlobalId> dofs;
  Matrix modes;  ///< dofs x k
  Matrix held;   ///< any number of rows x k
};

/// Coefficients of all motions of several parts that agree wherever two parts have an unknown in common and vanish in the held rows: sum of
/// k rows (part by part) x number of motions. A hinge between two parts is found, too. By the null space of a small matrix. Local.
Matrix commonRigidMotions(const std::vector<RigidMember>& parts);

}  // namespace suture
