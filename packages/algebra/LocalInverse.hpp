#pragma once
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/base/Types.hpp>

namespace suture {

/// An inverse of a local problem's Schur complement. Without constraints: a generalised inverse S^+, the local Neumann problems of eq.
/// (28)-(29). With constraint rows C: the saddle-point problem  S x + C^T m = f, C x = 0  of BDDC. Local.
class LocalInverse {
 public:
  virtual ~LocalInverse() = default;
  /// trace <- S^+ flux: without constraints S S^+ f = f for a flux orthogonal to the kernel. S^+ is positive definite or semidefinite on
  /// all fluxes.
  virtual void apply(ConstLocalView flux, LocalView trace) const = 0;
  /// With constraints: the traces Phi of least energy with C Phi = I, size() x rows, and their energies Phi^T S Phi. Otherwise empty.
  virtual Matrix basis() const { return none_; }
  virtual const Matrix& energy() const { return none_; }
  /// Products with Phi, limited only by memory bandwidth: values <- Phi^T flux, trace <- trace + Phi values. One flux, one trace.
  virtual void applyBasisTransposed(const Eigen::Ref<const Vector>& flux, Vector& values) const;
  virtual void addBasis(const Vector& values, Eigen::Ref<Vector> trace) const;
  /// trace <- P flux + Phi values; the second argument is Phi^T flux, from applyBasisTransposed(). One flux, one trace.
  virtual void applyWithBasis(ConstLocalView flux, const Vector& told, const Vector& values, LocalView trace) const;
  /// Bytes of memory read by apply() with one right-hand side, without Phi, and by one product each with Phi^T and Phi; 0 if unknown.
  virtual double bytesRead() const { return 0.0; }
  virtual double basisBytesRead() const { return 0.0; }

 private:
  Matrix none_;
};

}  // namespace suture
