#pragma once
#include <suture/constraints/Constraints.hpp>
#include <suture/contact/FrictionSearch.hpp>

#include <array>

namespace suture {

/// Forces and displacements of a pair at a state of a formulation, in the pair's frame (PairFrame).
struct PairForces {
  double normal = 0.0;  ///< normal force of a closed pair [force]
  Point held{0, 0, 0};  ///< forces of the tangential rows that hold a pair which sticks [force]
  double gap = 0.0;     ///< gap of an open pair [length]
  Point slip{0, 0, 0};  ///< u_A - u_B of the step along the tangents [length]
  double digits = 0.0;  ///< displacements that the gap is the difference of [length]

  /// Tangential force that side B feels: that of the rows which hold a pair that sticks; its bound along the slip of one that slips, and
  /// the force of the spring across. [force]
  Point tangential(const ContactState& state) const;
};

/// Components along a pair's tangents as a Cartesian vector.
Point cartesian(const ContactPair& pair, int dimension, const Point& tangential);

/// Number of columns of a matrix with one row a pair that all ranks sum: each pair is known to one of them, the others have zeros.
constexpr Eigen::Index kPairColumns = 7;
/// Puts force, jump, and rounding of the jump into a row.
void putPair(const ContactState& state, const PairForces& pair, Matrix& all, Eigen::Index row);
/// Puts the state of a pair into a row; and takes them from all rows.
void putState(const ContactState& state, Matrix& all, Eigen::Index row);
PairStates statesFrom(const Matrix& rows);
/// Puts place, size, history and tangential stiffness of a pair into a row, and takes them from all rows.
/// \param stiffness  stiffness of its rows along the tangents, in series; zero for one that cannot change [force / length]
void putSite(const ContactPair& pair, const std::array<double, 2>& stiffness, Matrix& all, Eigen::Index row);
std::vector<FrictionSite> sitesFrom(const Matrix& rows);

}  // namespace suture
