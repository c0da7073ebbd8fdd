#pragma once
#include <suture/interface/ContactBodies.hpp>
#include <suture/interface/InterfaceState.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/search/LinearContactSolver.hpp>
#include <suture/search/PairStates.hpp>

#include <vector>

namespace suture {

/// Relative accuracy of a gap, as a difference of displacements.
constexpr double kGapDigits = 1e-14;

/// Tolerances of a trace: a pair must violate its condition by more than this before its status changes.
struct PairResolution {
  double ofCluster;     ///< relative to the largest force of its cluster of bodies and to the deformation by that force
  double ofBody = 0.0;  ///< relative to the largest force on the less loaded of its two bodies
  /// Relative to the largest force of the path of load steps, if a solution carries almost nothing of it.
  double ofPath = 0.0;
};

/// Solution of the linear problem of given pair states. Pairs by id, in their frames (PairFrame), the same on all ranks.
struct PairValues {
  Matrix force;             ///< pairs x 3: force on side B [force]
  Matrix jump;              ///< pairs x 3: penetration, and slip u_A - u_B of the load step [length]
  Vector digits;            ///< round-off of the jumps [length]
  MultiVectorPtr residual;  ///< residual of the linear problem
  double energy = 0.0;
  int applications = 0;  ///< operator applications used
};

/// Contact of an InterfaceProblem pair by pair: the interface between a formulation and StateSearch, with and without friction. Pair states
/// and values are by pair id, the same on all ranks. Functions with a state are collective.
class ContactProblem {
 public:
  virtual ~ContactProblem() = default;
  virtual const ContactBodies& bodies() const = 0;
  virtual const ContactLaws& laws() const = 0;
  virtual const std::vector<FrictionSite>& sites() const = 0;
  /// False if friction of slipping pairs cannot depend on normal forces within a linear problem: bounds are then given, as in Tresca
  /// problems.
  virtual bool couplesToNormal() const { return true; }

  virtual ContactStates statusOf(const PairStates& pairs) const = 0;
  virtual PairStates statesOf(const ContactStates& status) const = 0;
  /// Forces and jumps of the linear problem of the state's status: closed pairs tied in the normal direction, sticking ones along the
  /// tangents, too; slipping ones with the tangential forces of their state.
  virtual PairValues valuesOf(const InterfaceState& state) const = 0;
  /// The states found by the formulation's non-linear local problems at a state: Newton's next states. Empty: not available, or not found.
  virtual PairStates proposal(const InterfaceState&) const { return {}; }
  /// The state with zero trace and these pair states.
  virtual InterfaceState stateWith(const PairStates& pairs) const = 0;
  /// Part of each owned unknown.
  virtual const std::vector<int>& partOfOwned() const = 0;
  /// Moves the rigid motion of free parts from the trace to `rigid`, so that forces have only the round-off of deformations.
  virtual void separate(InterfaceState& state) const = 0;
  /// Applies the operator to fill the state's memory, unless it is filled. Returns the number of applications.
  virtual int remember(InterfaceState& state) const = 0;
  /// Twice the energy of the trace of each part, U.S U, without that of elastic supports in rigid motions. [force length]
  virtual Vector energies(const InterfaceState& state) const = 0;

  /// The state after rigid motions of bodies onto elastic pads in place of their contacts, with the resulting states of frictionless pairs.
  virtual InterfaceState padState() const = 0;

 protected:
  /// padState() of a rigid model.
  InterfaceState stateOnPads(RigidBodyModel& rigid) const;
};

/// Moves parts rigidly: `motion` are amplitudes of ContactBodies::rigid(), empty: none. Forces do not change. Local.
void move(InterfaceState& state, const Vector& motion);

/// Values of a linear problem with their tolerances. Local; the same on all ranks.
ContactAnswer answerOf(const ContactProblem& contact, const PairStates& states, const PairValues& values, PairResolution resolution);

/// Evaluates the laws at a solution of given states: the next states, and how many differ in their status. Local; the same on all ranks.
InterfaceEvaluation evaluationOf(const ContactProblem& contact, const PairStates& states, const PairValues& values,
                                 const ContactAnswer& answer);

}  // namespace suture
