#pragma once
#include <suture/subdomain/SchurComplement.hpp>

namespace suture {

/// Chooses Explicit or Implicit, whichever should take less time for a number of iterations, within a memory limit. With n unknowns, b of
/// them on the boundary, and a factor of f = 8 n log2(n) entries (inferred from the memory of a run with n = 3,600), the times in seconds
/// at assumed rates, of which only ratios matter, are
///     Explicit  2/3 b^3 / 5e9 once, 4.4 b^2 / 8e9 per application       Implicit  16 f / 3e9 per application
/// In 2D Explicit is faster for nearly all subdomains; Implicit if nearly all unknowns are on the boundary, or for few applications.
/// Local.
class AutomaticSchurComplement : public SchurComplement {
 public:
  static Schema schema();
  explicit AutomaticSchurComplement(const Parameters& own);
  /// \param iterations  expected number of applications
  /// \param megabytes   limit for the dense matrix of one subdomain
  AutomaticSchurComplement(int iterations, double megabytes) : iterations_(iterations), megabytes_(megabytes) {}

  const Vector& condensedLoad() const override { return own_->condensedLoad(); }
  const PackedSymmetric* dense() const override { return own_->dense(); }
  Vector recover(const Vector& trace) const override { return own_->recover(trace); }
  double interiorEnergy() const override { return own_->interiorEnergy(); }
  double bytesRead() const override { return own_->bytesRead(); }
  std::string chosen() const override { return name_; }

 protected:
  void doCompute(const SchurData& data) override;
  void doReload(const SchurData& data) override { own_->reload(data); }
  void doApply(ConstLocalView trace, LocalView flux) const override { own_->apply(trace, flux); }

 private:
  int iterations_;
  double megabytes_;
  std::string name_;
  std::unique_ptr<SchurComplement> own_;
};

}  // namespace suture
