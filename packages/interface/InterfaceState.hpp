#pragma once
#include <suture/base/Types.hpp>
#include <suture/interface/TpetraTypes.hpp>
#include <suture/pairs/ContactState.hpp>

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
};

}  // namespace suture
