#pragma once
#include <suture/base/Types.hpp>
#include <suture/search/PairStates.hpp>

#include <vector>

namespace suture {

/// Data of a pair that its law and the search need.
struct FrictionSite {
  Point place{0, 0, 0};
  double size = 1.0;        ///< tributary length or area
  double tangential = 0.0;  ///< tangential stiffness of both sides in series [force / length]
  bool slipped = false;     ///< the pair has slid in an earlier load step
};

/// Solution of the linear problem for given states: closed pairs are tied along the normal, sticking ones along the tangents too; slipping
/// ones carry the tangential force of their state.
struct ContactAnswer {
  Matrix force;           ///< pairs x 3, in the frames of the pairs: force on side B [force]
  Matrix jump;            ///< pairs x 3: penetration, and slip u_A - u_B of the load step, also prescribed slip of sticking pairs [length]
  Vector forceTolerance;  ///< violation of each pair below which it counts as zero [force]
  Vector jumpTolerance;   ///< the same for penetrations and prescribed slip [length]
  double energy = 0.0;    ///< potential energy of the state, without a constant
  bool solved = true;     ///< false: the linear solve failed; the reason is reported elsewhere
};

/// The linear problems of given pair states that a search needs. Collective if the implementation is; all ranks get the same numbers.
class LinearContactSolver {
 public:
  virtual ~LinearContactSolver() = default;
  /// Loosest and tightest available tolerance of forces, relative to the largest; both zero: a direct solver.
  virtual double loosest() const { return 0.0; }
  virtual double tightest() const { return 0.0; }
  /// True if tangential forces of slipping pairs follow the normal forces within a linear problem (Coulomb); false if bounds must be given.
  virtual bool couplesToNormal() const { return true; }
  /// \param tolerance  between tightest() and loosest()
  virtual ContactAnswer solve(const PairStates& states, double tolerance) = 0;
  /// Moves the state of the last solve rigidly, without changing forces. \param motion  amplitudes of RigidBodyModel
  virtual void move(const Vector& motion) = 0;
  /// Amplitudes of the rigid motions in the state of the last solve, as far as the solver keeps them apart from deformations; empty:
  /// unknown.
  virtual Vector motion() const = 0;
  /// False ends the search after the current step.
  virtual bool goesOn() { return true; }
};

}  // namespace suture
