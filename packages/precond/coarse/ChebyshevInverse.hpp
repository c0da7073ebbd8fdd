#pragma once
#include <suture/precond/Preconditioner.hpp>

#include <array>

namespace suture {

/// Chebyshev iteration with a fixed number of steps for a preconditioned operator: a linear, symmetric positive definite approximation P of
/// S^-1. It may be used inside another preconditioner, unlike conjugate gradients, which are not linear.
///
/// The eigenvalues of M^-1 S lie between 1 (BDDC's bound) and the largest, which Lanczos estimates. The number of steps is chosen such that
/// the eigenvalues of P S lie in [1 - accuracy, 1 + accuracy], but at most 100; P stays definite if the estimate is somewhat low.
class ChebyshevInverse {
 public:
  /// Collective. \param preconditioner  computed for `matrix`, with M^-1 S >= 1
  ChebyshevInverse(Teuchos::RCP<const InterfaceOperator> matrix, Teuchos::RCP<const Preconditioner> preconditioner, double accuracy);

  /// x <- P b. One right-hand side. Collective.
  void apply(const MultiVector& b, MultiVector& x) const;
  int steps() const { return steps_; }
  /// True if the accuracy requires more steps than are made.
  bool isClamped() const { return isClamped_; }
  double largest() const { return largest_; }  ///< estimated eigenvalue of M^-1 S

 private:
  double estimateLargest() const;

  Teuchos::RCP<const InterfaceOperator> matrix_;
  Teuchos::RCP<const Preconditioner> preconditioner_;
  double largest_ = 1.0;
  int steps_ = 1;
  bool isClamped_ = false;
  mutable std::array<MultiVectorPtr, 4> work_;  // work space of apply()
};

}  // namespace suture
