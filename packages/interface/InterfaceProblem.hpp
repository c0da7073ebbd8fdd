#pragma once
#include <suture/base/ForceScale.hpp>
#include <suture/base/Types.hpp>
#include <suture/interface/BrokenField.hpp>
#include <suture/interface/ContactProblem.hpp>
#include <suture/interface/InterfaceOperator.hpp>
#include <suture/interface/InterfaceState.hpp>
#include <suture/pairs/PairForce.hpp>

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace suture {

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

  /// Contact pair by pair; null if no pair can change, or if the formulation does not offer it.
  virtual const ContactProblem* contact() const { return nullptr; }

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

  /// The field of a state with corrections of the traces. Nothing if the formulation does not offer it.
  /// \param corrections  by local problem, in the order of linearise(state).matrix->locals(); empty: none
  virtual std::optional<BrokenField> brokenField(const InterfaceState& state, const std::vector<Vector>& corrections) const {
    return (void)state, (void)corrections, std::nullopt;
  }

  /// True if reload() may be called.
  virtual bool reloads() const { return false; }
  /// Reloads the current loads of the subdomains and the current gaps and histories of their pairs; factorisations are kept.
  virtual void reload() {}

  /// True if rearrange() may be called.
  virtual bool rearranges() const { return false; }
  /// Takes over new places and pairs of the subdomains, after Subdomain::rearrange(); factorisations are kept. Collective.
  virtual void rearrange() {}

  /// Sets the largest forces on each body on the path of load steps so far, from which round-off is estimated. \param carried  empty: none
  virtual void rememberPath(const std::vector<BodyForces>& carried) { (void)carried; }

  /// Number of contact pieces and of pairs that can change, over all ranks.
  virtual int pieces() const = 0;
  virtual int pairs() const = 0;
};

}  // namespace suture
