#pragma once
#include <suture/algebra/InverseWithBasis.hpp>

#include <string>

namespace suture {

/// The saddle-point problem of BDDC with a dense Schur complement:  S x + C^T m = f,  C x = 0,  and the basis of least energy with C Phi =
/// I.
///
/// Solved by a change of basis: one reflection per row turns each constraint into the value of a single coordinate (a row with a single
/// entry needs none). The remaining coordinates are free, their block of S is definite, and its inverse, transformed back, is stored as a
/// matrix: an application is one symmetric product. Inverse and basis are stored in single precision if the inverse is large and
/// well-conditioned. No multiplier, no penalty; S may be singular. Local.
class ConstrainedInverse : public InverseWithBasis {
 public:
  /// \param what  for messages. \throws NumericalError  if C does not have full rank or leaves a mechanism.
  ConstrainedInverse(Matrix schur, const Matrix& constraints, const std::string& what);

  void apply(ConstLocalView flux, LocalView trace) const override { inverse_.multiply(flux, trace); }
  double bytesRead() const override { return inverse_.bytes(); }

 private:
  PackedSymmetric inverse_;
};

}  // namespace suture
