#pragma once
#include <suture/pairs/ContactPair.hpp>
#include <suture/pairs/ContactState.hpp>
#include <suture/search/LinearContactSolver.hpp>

#include <array>

namespace suture {

/// Forces and displacements of a pair at a state of a formulation, in the pair's frame (PairFrame).
struct PairForces {
  double normal = 0.0;                                      ///< normal force of a closed pair [force]
  Point held{0, 0, 0};                                      ///< forces of the tangential rows of a sticking pair [force]
  double gap = 0.0;                                         ///< gap of an open pair [length]
  Point slip{0, 0, 0};                                      ///< u_A - u_B of the load step along the tangents [length]
  std::array<bool, 3> isPrescribed{{false, false, false}};  ///< rows without unknowns: their jumps are given, also if the pair sticks
  double digits = 0.0;                                      ///< magnitude of the displacements whose difference is the gap [length]

  /// Tangential force on side B: from the tangential rows of a sticking pair; for a slipping pair, its bound along the slip and the force
  /// of the transverse spring. [force]
  Point tangential(const ContactState& state) const;
};

/// Components along a pair's tangents as a Cartesian vector.
Point cartesian(const ContactPair& pair, int dimension, const Point& tangential);

/// Number of columns of a matrix with one row per pair, summed over all ranks: one rank knows the pair, the others add zeros.
constexpr Eigen::Index kPairColumns = 7;
/// Writes force, jump and round-off of the jump into a row.
void putPair(const ContactState& state, const PairForces& pair, Matrix& all, Eigen::Index row);
/// Writes the state of a pair into a row; statesFrom() reads all rows.
void putState(const ContactState& state, Matrix& all, Eigen::Index row);
PairStates statesFrom(const Matrix& rows);
/// Writes position, size, history and tangential stiffness of a pair into a row; sitesFrom() reads all rows.
/// \param stiffness  of its tangential rows, in series; zero for a pair that cannot change [force / length]
void putSite(const ContactPair& pair, const std::array<double, 2>& stiffness, Matrix& all, Eigen::Index row);
std::vector<FrictionSite> sitesFrom(const Matrix& rows);

}  // namespace suture
