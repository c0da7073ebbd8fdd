#pragma once
#include <suture/algebra/LocalInverse.hpp>
#include <suture/algebra/dense/PackedColumns.hpp>

namespace suture {

/// A LocalInverse under constraints that stores the basis Phi as a packed matrix, and its energies. Derived classes set both. Local.
class InverseWithBasis : public LocalInverse {
 public:
  Matrix basis() const override { return basis_.full(); }
  const Matrix& energy() const override { return energy_; }
  void applyBasisTransposed(const Eigen::Ref<const Vector>& flux, Vector& values) const override {
    basis_.multiplyTransposed(flux, values);
  }
  void addBasis(const Vector& values, Eigen::Ref<Vector> trace) const override { basis_.addProduct(values, trace); }
  double basisBytesRead() const override { return 2.0 * basis_.bytes(); }

 protected:
  PackedColumns basis_;  // Phi: size x constraints
  Matrix energy_;        // Phi^T S Phi
};

}  // namespace suture
