#pragma once
#include <suture/precond/Preconditioner.hpp>

#include <array>

namespace suture {

/// A preconditioned operator solved by a fixed number of Chebyshev steps: a linear, symmetric positive definite approximation P of S^-1,
/// which may stand inside another preconditioner (conjugate gradients, which are not linear, may not).
///
/// The eigenvalues of M^-1 S lie between 1 (BDDC's bound) and the largest, which Lanczos estimates. Steps are as many as bring those of
/// P S into [1 - accuracy, 1 + accuracy]; P stays definite where the estimate is somewhat low.
class ChebyshevInverse {
 public:
  /// Collective. \param preconditioner  computed for `matrix`, with M^-1 S >= 1
  ChebyshevInverse(Teuchos::RCP<const InterfaceOperator> matrix, Teuchos::RCP<const Preconditioner> preconditioner, double accuracy);

  /// x <- P b. One right-hand side. Collective.
  void apply(const MultiVector& b, MultiVector& x) const;
  int steps() const { return steps_; }
  double largest() const { return largest_; }  ///< estimated eigenvalue of M^-1 S

 private:
  double estimateLargest() const;

  Teuchos::RCP<const InterfaceOperator> matrix_;
  Teuchos::RCP<const Preconditioner> preconditioner_;
  double largest_ = 1.0;
  int steps_ = 1;
  mutable std::array<MultiVectorPtr, 4> work_;  // work space of apply(), which every iteration calls
};

}  // namespace suture
