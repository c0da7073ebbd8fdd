#pragma once
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/subdomain/SchurComplement.hpp>

namespace suture {

/// S_i as a dense matrix from ONE elimination of the interior (StaticCondensation): an application is a product with a small dense matrix,
/// and the same elimination gives condensed loads. The factor is kept in single precision, to recover interiors (SingleFactor). Only where
/// pivots are too small for single precision (a body on a very soft spring), the local solver of the scene recovers interiors. Memory: that
/// factor and n^2 / 2 numbers for n boundary unknowns. Local.
class ExplicitSchurComplement : public SchurComplement {
 public:
  static Schema schema();
  const Vector& condensedLoad() const override { return condensedLoad_; }
  const PackedSymmetric* dense() const override { return &schur_; }
  Vector recover(const Vector& trace) const override;
  double interiorEnergy() const override { return interiorEnergy_; }
  double bytesRead() const override { return schur_.bytes(); }

 protected:
  void doCompute(const SchurData& data) override;
  void doReload(const SchurData& data) override;
  void doApply(ConstLocalView trace, LocalView flux) const override;

 private:
  /// x <- A_II^-1 x; other entries become zero.
  void solveInterior(Vector& x) const;

  const SymmetricMatrix* stiffness_ = nullptr;
  const Vector* load_ = nullptr;
  std::vector<int> boundary_;
  SingleFactor factor_;
  std::vector<int> interior_;           // with exact_
  std::unique_ptr<LocalSolver> exact_;  // factor of A_II in double precision; null if factor_ is sufficient
  PackedSymmetric schur_;
  Vector condensedLoad_;
  double interiorEnergy_ = 0.0;
};

}  // namespace suture
