#pragma once
#include <suture/interface/InterfaceOperator.hpp>
#include <suture/interface/InterfaceState.hpp>

#include <memory>

namespace suture {

/// Internal minus external forces of a trace, S U - F, with all pairs open: contact changes no local problem, so that all pair states share
/// it. It is cached in InterfaceState::memory.
class InterfaceBalance {
 public:
  /// \param space  without relations. Collective.
  InterfaceBalance(std::shared_ptr<const InterfaceSpace> space, LocalProblems locals);

  const LocalProblems& locals() const { return apart_->locals(); }
  /// Takes the current loads of the local problems. Collective. \param constantEnergy  energy of this rank's local problems at zero trace
  void takeLoads(double constantEnergy);

  /// S U - F on the overlap, complete; `applications` is incremented if the operator is applied. Collective.
  Matrix of(const InterfaceState& state, int& applications) const;
  /// -F on the overlap.
  Matrix ofNoTrace() const { return -load_; }
  /// S times a trace on the overlap, complete. Collective.
  Matrix forces(const MultiVector& trace) const;
  /// Forces S U on the owned unknowns, from of(). Local.
  Vector forces(const Matrix& imbalance) const;
  /// U.(S U) / 2 - F.U plus the energy of the local problems at zero trace. Collective. \param trace  on the overlap
  double energy(const Matrix& trace, const Matrix& imbalance) const;
  /// T^T of an imbalance, with the sign of a residual. Collective.
  MultiVectorPtr residual(const Matrix& imbalance, const InterfaceSpace& space, const FrictionTangent* friction = nullptr) const;

 private:
  std::shared_ptr<const InterfaceSpace> space_;
  Teuchos::RCP<InterfaceOperator> apart_;  // S on space_: all pairs open
  Matrix load_;                            // F on the overlap, complete
  double constantEnergy_ = 0.0;            // over all ranks
};

}  // namespace suture
