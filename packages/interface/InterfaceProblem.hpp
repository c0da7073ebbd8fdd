#pragma once
#include <suture/base/Types.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/interface/InterfaceOperator.hpp>

#include <map>
#include <memory>
#include <vector>

namespace suture {

/// Status of all contact pairs, as a rank keeps it: for each of its local problems, in the order of its rows (empty for a problem
/// without contact).
using ContactStatus = std::vector<std::vector<PairStatus>>;

/// Where an outer solver stands.
struct InterfaceState {
  MultiVectorPtr trace;  ///< U
  ContactStatus status;
};

/// A contact pair at the end of a run.
struct PairState {
  ContactPair pair;
  PairStatus status = PairStatus::Open;
  double force = 0.0;           ///< >= 0 compressive [force]
  double gap = 0.0;             ///< current gap [length]
  Point displacement{0, 0, 0};  ///< of node A, Cartesian
};

/// The non-linear problem that an outer solver sees: find the trace U with  grad J(U) = S_0 U + S_KON(U) - F = 0,  J the energy with
/// interiors and contacts minimised out: convex, differentiable, with a semismooth gradient. All functions are collective.
class InterfaceProblem {
 public:
  virtual ~InterfaceProblem() = default;

  virtual const std::shared_ptr<const InterfaceSpace>& space() const = 0;
  /// Zero trace (prescribed displacements are in the loads), all pairs closed: contact must be started closed, from an empty set
  /// Newton fails.
  virtual InterfaceState initialState() const = 0;

  /// The state that belongs to given values of the subdomains' free unknowns (of this rank) and status of pairs (by id; a pair that is not
  /// named is closed): a restart.
  virtual InterfaceState stateOf(const std::vector<Vector>& freeValues, const std::map<int, PairStatus>& status) const = 0;

  struct Evaluation {
    MultiVectorPtr residual;  ///< F - S_0 U - S_KON(U) = -grad J(U)
    double energy = 0.0;      ///< J(U), the total potential energy
    ContactStatus next;       ///< status of the pairs at U
    int changed = 0;          ///< pairs whose status differs from the state's
    int active = 0;           ///< closed pairs at U
  };
  virtual Evaluation evaluate(const InterfaceState& state) const = 0;

  struct Linearisation {
    Teuchos::RCP<InterfaceOperator> matrix;  ///< S_0 + S_KON' for the status; its space may depend on it
    MultiVectorPtr load;  ///< right-hand side of the linear problem with this status: S U = F + F_g of (21) with all closed
  };
  /// With the status of the state (not that of its trace).
  virtual Linearisation linearise(const InterfaceState& state) const = 0;

  /// S_0 and nothing else, for the splitting (18): null when the formulation has none.
  virtual Teuchos::RCP<InterfaceOperator> withoutContact() const { return Teuchos::null; }

  /// state.trace += length * step
  virtual void update(InterfaceState& state, const MultiVector& step, double length) const;

  struct Recovered {
    std::vector<Vector> freeValues;  ///< of each subdomain of this rank
    std::vector<PairState> pairs;    ///< those of this rank
    double energy = 0.0;             ///< over all ranks
  };
  virtual Recovered recover(const InterfaceState& state) const = 0;

  /// Number of contact pieces and of pairs that can change, over all ranks.
  virtual int pieces() const = 0;
  virtual int pairs() const = 0;
};

}  // namespace suture
