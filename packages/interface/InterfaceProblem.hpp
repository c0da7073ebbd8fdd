#pragma once
#include <suture/base/ForceScale.hpp>
#include <suture/base/Types.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/contact/FrictionSearch.hpp>
#include <suture/interface/ContactBodies.hpp>
#include <suture/interface/InterfaceOperator.hpp>

#include <map>
#include <memory>
#include <vector>

namespace suture {

/// Status of all contact pairs that a rank knows of, in the formulation's own order: for Condensed Groups the rows of each of its local
/// problems (none for a problem without contact), for Contact On The Interface one list of all rows.
using ContactStates = std::vector<std::vector<ContactState>>;

/// Where an outer solver stands.
struct InterfaceState {
  MultiVectorPtr trace;  ///< U
  ContactStates status;
  /// Rigid motions of parts (ContactBodies) on top of the trace, so that deformations are no differences of large numbers; empty: none.
  Vector rigid{};
  /// Cache of the formulation for this trace, which saves applications of operators. Reset it whenever you modify the trace directly.
  std::shared_ptr<const Matrix> memory = nullptr;
  int applications = 0;  ///< applications of the operator that making the state took
};

/// Value of a formulation at a state.
struct InterfaceEvaluation {
  MultiVectorPtr residual;  ///< F - S_0 U - S_KON(U) = -grad J(U)
  double energy = 0.0;      ///< J(U), the total potential energy
  ContactStates next;       ///< status of the pairs at U
  int changed = 0;          ///< pairs whose status differs from the state's
  int active = 0;           ///< closed pairs at U
  bool settled = true;      ///< no residual counts before this holds: the residual is that of another status than the next
  int applications = 0;     ///< applications of the operator that this took
  /// By pair id, of sets: forces of closed pairs, penetrations of open ones, and what these must violate their conditions by before they
  /// are believed.
  Vector force = {}, penetration = {}, forceTolerance = {}, penetrationTolerance = {};
};

/// Accuracy of a trace: what a pair must violate its condition by before its status changes.
struct PairResolution {
  double ofCluster;     ///< relative to the largest force of its cluster of bodies and to what that deforms
  double ofBody = 0.0;  ///< relative to the largest force on the less loaded one of its bodies
};

/// Contact states as sets of closed pairs: what a formulation offers to ContactSearch. Sets and pair values are by pair id, the same on
/// all ranks. All functions but the first are collective.
class ContactSets {
 public:
  virtual ~ContactSets() = default;
  virtual const ContactBodies& bodies() const = 0;
  virtual ContactStates statusOf(const ClosedSet& closed) const = 0;
  virtual ClosedSet closedSet(const ContactStates& status) const = 0;
  /// The linear problem of the state's set: closed pairs glued in the normal direction, open ones without force. Residual, pair forces and
  /// penetrations are its own; `next` are plain flips.
  virtual InterfaceEvaluation evaluateSet(const InterfaceState& state, PairResolution resolution) const = 0;
  /// The set that the formulation's own non-linear part answers with at a state: Newton's next. Empty: it has none, or no answer.
  virtual ClosedSet proposal(const InterfaceState&) const { return {}; }
  /// The state in which bodies have moved rigidly onto elastic pads in place of their contact, and the set that is closed then.
  virtual InterfaceState padState() const = 0;
  /// Moves parts rigidly: `motion` are amplitudes of bodies().rigid(). Forces do not change.
  virtual void move(InterfaceState& state, const Vector& motion) const = 0;
  /// Load of pair forces (> 0 compressive) on the interface, in the space of a status. [force]
  virtual MultiVectorPtr loadOf(const Vector& pairForces, const ContactStates& status) const = 0;
  /// Forces that a step in the space of a status adds to closed pairs, and penetrations that it adds to open ones.
  /// \param pairForces  that act beside them
  virtual void pairChanges(const MultiVector& step, const ContactStates& status, const Vector& pairForces, Vector& force,
                           Vector& penetration) const = 0;
  /// Part of each owned unknown.
  virtual const std::vector<int>& partOfOwned() const = 0;
  /// Takes what is a rigid motion of free parts out of the trace and puts it beside it: rounding of forces is then that of deformations.
  virtual void separate(InterfaceState& state) const = 0;
  /// Applies the operator, so that the state's memory is that of its trace, unless it has one. Returns how many applications it took.
  virtual int remember(InterfaceState& state) const = 0;
  /// U.S U of each part: the energy that holds its trace deformed, twice. [force length]
  virtual Vector energies(const InterfaceState& state) const = 0;
};

/// Forces and jumps of all pairs at a state, in their frames (PairFrame). By pair id, the same on all ranks.
struct PairValues {
  Matrix force;             ///< pairs x components: that side B feels [force]
  Matrix jump;              ///< pairs x components: penetration, and slip u_A - u_B of the step [length]
  Vector digits;            ///< rounding of the jumps [length]
  MultiVectorPtr residual;  ///< residual of the linear problem of the state's states
  double energy = 0.0;
  int applications = 0;
};

/// Contact states pair by pair, where laws restrict sliding: what a formulation offers to FrictionSearch. By pair id, the same on all
/// ranks. Functions with a state are collective.
class FrictionStates {
 public:
  virtual ~FrictionStates() = default;
  virtual const ContactLaws& laws() const = 0;
  /// False where normal forces cannot drag pairs that slip: bounds are given then, as those of Tresca problems.
  virtual bool drags() const { return true; }
  virtual ContactStates statusOf(const PairStates& pairs) const = 0;
  virtual PairStates statesOf(const ContactStates& status) const = 0;
  virtual PairValues valuesOf(const InterfaceState& state) const = 0;
  /// The state with a trace of zero and these states of pairs.
  virtual InterfaceState stateWith(const PairStates& pairs) const = 0;

  virtual const std::vector<FrictionSite>& sites() const = 0;
};

/// The non-linear problem that an outer solver sees: find the trace U with  grad J(U) = S_0 U + S_KON(U) - F = 0,  J the energy with
/// interiors and contacts minimised out: convex, differentiable, with a semismooth gradient. All functions are collective.
class InterfaceProblem {
 public:
  virtual ~InterfaceProblem() = default;

  virtual const std::shared_ptr<const InterfaceSpace>& space() const = 0;
  /// All pairs closed (contact must be started closed, from an empty set Newton fails), and the smallest trace that agrees with it: zero,
  /// but for gaps. Prescribed displacements are in the loads.
  virtual InterfaceState initialState() const = 0;

  /// The state that belongs to given values of the subdomains' free unknowns (of this rank) and status of pairs (by id; a pair that is not
  /// named is closed): a restart.
  virtual InterfaceState stateOf(const std::vector<Vector>& freeValues, const std::map<int, ContactState>& status) const = 0;

  using Evaluation = InterfaceEvaluation;
  /// \param resolution  accuracy of the trace: what a pair must violate its condition by before its status changes, relative to the largest
  ///                    force of its cluster of bodies and to what that deforms
  virtual Evaluation evaluate(const InterfaceState& state, double resolution = 0.0) const = 0;

  struct Linearisation {
    Teuchos::RCP<InterfaceOperator> matrix;  ///< S_0 + S_KON' for the status; its space may depend on it
    MultiVectorPtr load;  ///< residual with this status: right-hand side for the step from the state's trace to the solution with it; for
                          ///< the initial state F + F_g of (21)
  };
  /// With the status of the state (not that of its trace).
  virtual Linearisation linearise(const InterfaceState& state) const = 0;

  /// Contact as sets of closed pairs; null where the formulation hides it.
  virtual const ContactSets* sets() const { return nullptr; }

  /// Contact states pair by pair; null where no law restricts sliding, or the formulation knows no friction.
  virtual const FrictionStates* friction() const { return nullptr; }

  /// S_0 and nothing else, for the splitting (18): null when the formulation has none.
  virtual Teuchos::RCP<InterfaceOperator> withoutContact() const { return Teuchos::null; }

  /// Moves the trace onto the state's status where that restricts it. Returns how many applications of the operator it took.
  virtual int conform(InterfaceState& state) const;

  /// state.trace += length * step, a step in the space of the linearisation with the state's status.
  /// \param image  what the linearisation's operator recorded for the step, or null
  virtual void update(InterfaceState& state, const MultiVector& step, double length, const Matrix* image = nullptr) const;

  /// Pairs whose status differs, by id, ascending; each once, the same on all ranks.
  virtual std::vector<int> differing(const ContactStates& a, const ContactStates& b) const = 0;

  struct Recovered {
    std::vector<Vector> freeValues;  ///< values of each subdomain of this rank
    std::vector<PairForce> pairs;    ///< pairs of this rank; each pair on one rank
    double energy = 0.0;             ///< over all ranks
  };
  virtual Recovered recover(const InterfaceState& state) const = 0;
  /// Its freeValues alone, which may be had for less.
  virtual std::vector<Vector> interiors(const InterfaceState& state) const { return recover(state).freeValues; }

  /// True if reload() may be called.
  virtual bool reloads() const { return false; }
  /// Takes the loads of the subdomains, and gaps and histories of the pairs of their meshes, as they are now; what is factored stays.
  virtual void reload() {}

  /// Takes the largest forces on each body on the path of load steps so far: part of them is rounding. \param carried  empty: none
  virtual void rememberPath(const std::vector<BodyForces>& carried) { (void)carried; }

  /// Number of contact pieces and of pairs that can change, over all ranks.
  virtual int pieces() const = 0;
  virtual int pairs() const = 0;
};

}  // namespace suture
