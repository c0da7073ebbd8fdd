#pragma once
#include <suture/elasticity/MaterialLaw.hpp>

namespace suture {

/// Three axes at right angles, each a symmetry of the material: timber, layered rock, fibres in one direction. They are those of the scene
/// (in axisymmetric scenes radius, axis and hoop), or given by directions; axes 1 and 2 are then turned about axis 3 by an angle. From the
/// nine constants of the compliance: strains e_11 = s_11 / E_1 - nu_12 s_22 / E_1 - nu_13 s_33 / E_1 and so on, where nu_ij is the
/// contraction along j over the extension along i under s_ii.
class OrthotropicLaw : public MaterialLaw {
 public:
  static constexpr const char* kName = "Orthotropic";
  static Schema schema();

  /// \throws InputError  a list that has not three entries, directions that are no axes
  explicit OrthotropicLaw(const Parameters& own);

 protected:
  ElasticStiffness doStiffness() const override;

 private:
  std::array<double, 3> young_, poisson_, shear_;
  Eigen::Matrix3d axes_;  // columns
};

}  // namespace suture
