#pragma once
#include <suture/base/ForceScale.hpp>
#include <suture/base/Types.hpp>
#include <suture/interface/ContactBodies.hpp>
#include <suture/interface/InterfaceOperator.hpp>
#include <suture/pairs/ContactLaw.hpp>
#include <suture/pairs/ContactState.hpp>
#include <suture/pairs/PairForce.hpp>
#include <suture/search/LinearContactSolver.hpp>

#include <map>
#include <memory>
#include <vector>

namespace suture {

/// Status of all contact pairs known to a rank, in the formulation's own order: for Condensed Groups the rows of each local problem (none
/// for a problem without contact), for Contact On The Interface one list of all rows.
using ContactStates = std::vector<std::vector<ContactState>>;

/// State of an outer iteration.
struct InterfaceState {
  MultiVectorPtr trace;  ///< U
  ContactStates status;
  /// Rigid motions of parts (ContactBodies), to be added to the trace. Kept apart so that deformations are not differences of large
  /// numbers; empty: none.
  Vector rigid{};
  /// Cache of the formulation for this trace, which saves applications of operators. Reset it whenever you modify the trace directly.
  std::shared_ptr<const Matrix> memory = nullptr;
  int applications = 0;  ///< operator applications used to make the state
};

/// Value of a formulation at a state.
struct InterfaceEvaluation {
  MultiVectorPtr residual;  ///< F - S_0 U - S_KON(U) = -grad J(U)
  double energy = 0.0;      ///< J(U), the total potential energy
  ContactStates next;       ///< status of the pairs at U
  int changed = 0;          ///< pairs whose status differs from the state's
  int active = 0;           ///< closed pairs at U
  bool settled = true;      ///< false: the residual belongs to a status other than `next` and must not be used as a convergence criterion
  int applications = 0;     ///< operator applications used
  /// By pair id, for sets: forces of closed pairs, penetrations of open ones, and the violations below which they count as zero.
  Vector force = {}, penetration = {}, forceTolerance = {}, penetrationTolerance = {};
};

/// Tolerances of a trace: a pair must violate its condition by more than this before its status changes.
struct PairResolution {
  double ofCluster;     ///< relative to the largest force of its cluster of bodies and to the deformation by that force
  double ofBody = 0.0;  ///< relative to the largest force on the less loaded of its two bodies
};

/// Contact states as sets of closed pairs: the interface between a formulation and the search for frictionless states. Sets and pair values
/// are by pair id, the same on all ranks. All functions except the first are collective.
class ContactSets {
 public:
  virtual ~ContactSets() = default;
  virtual const ContactBodies& bodies() const = 0;
  virtual ContactStates statusOf(const ClosedSet& closed) const = 0;
  virtual ClosedSet closedSet(const ContactStates& status) const = 0;
  /// Evaluates the linear problem of the state's set: closed pairs tied in the normal direction, open ones without force. Residual, pair
  /// forces and penetrations are those of this linear problem; `next` are plain flips.
  virtual InterfaceEvaluation evaluateSet(const InterfaceState& state, PairResolution resolution) const = 0;
  /// The set found by the formulation's non-linear local problems at a state: Newton's next set. Empty: not available, or not found.
  virtual ClosedSet proposal(const InterfaceState&) const { return {}; }
  /// The state after rigid motions of bodies onto elastic pads in place of their contacts, and the resulting closed set.
  virtual InterfaceState padState() const = 0;
  /// Moves parts rigidly: `motion` are amplitudes of bodies().rigid(). Forces do not change.
  virtual void move(InterfaceState& state, const Vector& motion) const = 0;
  /// Part of each owned unknown.
  virtual const std::vector<int>& partOfOwned() const = 0;
  /// Moves the rigid motion of free parts from the trace to `rigid`, so that forces have only the round-off of deformations.
  virtual void separate(InterfaceState& state) const = 0;
  /// Applies the operator to fill the state's memory, unless it is filled. Returns the number of applications.
  virtual int remember(InterfaceState& state) const = 0;
  /// Twice the energy of the trace of each part, U.S U, without that of elastic supports in rigid motions. [force length]
  virtual Vector energies(const InterfaceState& state) const = 0;
};

/// Forces and jumps of all pairs at a state, in their frames (PairFrame). By pair id, the same on all ranks.
struct PairValues {
  Matrix force;             ///< pairs x components: force on side B [force]
  Matrix jump;              ///< pairs x components: penetration, and slip u_A - u_B of the load step [length]
  Vector digits;            ///< round-off of the jumps [length]
  MultiVectorPtr residual;  ///< residual of the linear problem for the given pair states
  double energy = 0.0;
  int applications = 0;
};

/// Contact states pair by pair, for laws that restrict sliding: the interface between a formulation and StateSearch. By pair id, the
/// same on all ranks. Functions with a state are collective.
class FrictionStates {
 public:
  virtual ~FrictionStates() = default;
  virtual const ContactLaws& laws() const = 0;
  /// False if friction of slipping pairs cannot depend on normal forces within a linear problem: bounds are then given, as in Tresca
  /// problems.
  virtual bool couplesToNormal() const { return true; }
  virtual ContactStates statusOf(const PairStates& pairs) const = 0;
  virtual PairStates statesOf(const ContactStates& status) const = 0;
  virtual PairValues valuesOf(const InterfaceState& state) const = 0;
  /// The state with zero trace and these pair states.
  virtual InterfaceState stateWith(const PairStates& pairs) const = 0;

  virtual const std::vector<FrictionSite>& sites() const = 0;
};

/// The non-linear problem of an outer solver: find the trace U with  grad J(U) = S_0 U + S_KON(U) - F = 0.  J is the energy minimised over
/// interiors and contacts: convex, differentiable, with a semismooth gradient. All functions are collective.
class InterfaceProblem {
 public:
  virtual ~InterfaceProblem() = default;

  virtual const std::shared_ptr<const InterfaceSpace>& space() const = 0;
  /// All pairs closed (Newton fails when started from an empty set) with the smallest compatible trace: zero, except for gaps. Prescribed
  /// displacements are in the loads.
  virtual InterfaceState initialState() const = 0;

  /// The state for given values of the free unknowns of this rank's subdomains and a status of pairs by id, for a restart. Pairs without a
  /// status are closed.
  virtual InterfaceState stateOf(const std::vector<Vector>& freeValues, const std::map<int, ContactState>& status) const = 0;

  using Evaluation = InterfaceEvaluation;
  /// \param resolution  tolerance of the trace: a pair must violate its condition by more before its status changes, relative to the
  /// largest force of its cluster of bodies and to the deformation by that force
  virtual Evaluation evaluate(const InterfaceState& state, double resolution = 0.0) const = 0;

  struct Linearisation {
    Teuchos::RCP<InterfaceOperator> matrix;  ///< S_0 + S_KON' for the status; its space may depend on the status
    MultiVectorPtr load;  ///< residual for this status: right-hand side of the step from the state's trace to the solution; at the initial
                          ///< state F + F_g of (21)
  };
  /// Linearises at the state's status, not at that of its trace.
  virtual Linearisation linearise(const InterfaceState& state) const = 0;

  /// Contact as sets of closed pairs; null if the formulation condenses contact.
  virtual const ContactSets* sets() const { return nullptr; }

  /// Contact states pair by pair; null if no law restricts sliding, or if the formulation does not support friction.
  virtual const FrictionStates* friction() const { return nullptr; }

  /// S_0 alone, for the splitting (18); null if the formulation does not have it.
  virtual Teuchos::RCP<InterfaceOperator> withoutContact() const { return Teuchos::null; }

  /// Projects the trace onto the constraints of the state's status. Returns the number of operator applications.
  virtual int conform(InterfaceState& state) const;

  /// state.trace += length * step, for a step in the space of the linearisation at the state's status.
  /// \param image  record of the linearisation's operator for the step, or null
  virtual void update(InterfaceState& state, const MultiVector& step, double length, const Matrix* image = nullptr) const;

  /// Pairs whose status differs, by id, ascending; each once, the same on all ranks.
  virtual std::vector<int> differing(const ContactStates& a, const ContactStates& b) const = 0;

  struct Recovered {
    std::vector<Vector> freeValues;  ///< per subdomain of this rank
    std::vector<PairForce> pairs;    ///< pairs of this rank; each pair is on one rank
    double energy = 0.0;             ///< over all ranks
  };
  virtual Recovered recover(const InterfaceState& state) const = 0;
  /// The freeValues of recover(), possibly cheaper.
  virtual std::vector<Vector> interiors(const InterfaceState& state) const { return recover(state).freeValues; }

  /// True if reload() may be called.
  virtual bool reloads() const { return false; }
  /// Reloads the current loads of the subdomains and the current gaps and histories of their pairs; factorisations are kept.
  virtual void reload() {}

  /// Sets the largest forces on each body on the path of load steps so far, from which round-off is estimated. \param carried  empty: none
  virtual void rememberPath(const std::vector<BodyForces>& carried) { (void)carried; }

  /// Number of contact pieces and of pairs that can change, over all ranks.
  virtual int pieces() const = 0;
  virtual int pairs() const = 0;
};

}  // namespace suture
