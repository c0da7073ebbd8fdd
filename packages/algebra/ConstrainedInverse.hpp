#pragma once
#include <suture/algebra/InverseWithBasis.hpp>

#include <string>

namespace suture {

/// The saddle problem of BDDC with a dense Schur complement:  S x + C^T m = f,  C x = 0,  and the basis of least energy with C Phi = I.
///
/// By a change of basis: one reflection a row makes each constraint the value of a single coordinate (a row that is one already needs
/// none). The coordinates left are free, their block of S is definite, and its inverse, turned back, is kept as a matrix: an application
/// is one symmetric product, and as the basis in single precision if it is large and well-conditioned. No multiplier, no penalty; S may be
/// singular. Local.
class ConstrainedInverse : public InverseWithBasis {
 public:
  /// \param what  for messages. \throws NumericalError  C is not of full rank, or leaves a mechanism.
  ConstrainedInverse(Matrix schur, const Matrix& constraints, const std::string& what);

  void apply(ConstLocalView flux, LocalView trace) const override { inverse_.multiply(flux, trace); }
  double bytesRead() const override { return inverse_.bytes(); }

 private:
  PackedSymmetric inverse_;
};

}  // namespace suture
