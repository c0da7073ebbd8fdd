#pragma once
#include <suture/elasticity/MaterialLaw.hpp>

namespace suture {

/// Three axes at right angles, each a symmetry of the material: timber, layered rock, fibres in one direction. Axis 3 is z (in axisymmetric
/// scenes the hoop), axes 1 and 2 lie in the plane, turned by an angle. From the nine constants of the compliance: strains e_11 = s_11 /
/// E_1 - nu_12 s_22 / E_1 - nu_13 s_33 / E_1 and so on, where nu_ij is the contraction along j over the extension along i under s_ii.
class OrthotropicLaw : public MaterialLaw {
 public:
  static constexpr const char* kName = "Orthotropic";
  static Schema schema();

  /// \throws InputError  a list that has not three entries
  explicit OrthotropicLaw(const Parameters& own);

 protected:
  ElasticStiffness doStiffness() const override;

 private:
  std::array<double, 3> young_, poisson_, shear_;
  double angle_;  // [rad]
};

}  // namespace suture
