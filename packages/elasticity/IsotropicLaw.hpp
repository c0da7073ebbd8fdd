#pragma once
#include <suture/elasticity/MaterialLaw.hpp>

namespace suture {

/// Isotropic linear elastic law.
class IsotropicLaw : public MaterialLaw {
 public:
  static constexpr const char* kName = "Isotropic";
  static Schema schema();

  explicit IsotropicLaw(const Parameters& own);
  explicit IsotropicLaw(const IsotropicModuli& moduli) : moduli_(moduli) {}
  std::optional<IsotropicModuli> isotropic() const override { return moduli_; }

 protected:
  ElasticStiffness doStiffness() const override { return isotropicStiffness(moduli_); }

 private:
  IsotropicModuli moduli_;
};

}  // namespace suture
