#pragma once
#include <suture/elasticity/MaterialLaw.hpp>

namespace suture {

/// Three orthogonal axes of symmetry: timber, layered rock, unidirectional fibres. The axes are those of the scene (in axisymmetric scenes
/// radius, axis and hoop), or given by directions; axes 1 and 2 are then rotated about axis 3 by an angle. Defined by the nine constants of
/// the compliance: strains e_11 = s_11 / E_1 - nu_12 s_22 / E_1 - nu_13 s_33 / E_1 and so on, where nu_ij is the contraction along j over
/// the extension along i under s_ii.
class OrthotropicLaw : public MaterialLaw {
 public:
  static constexpr const char* kName = "Orthotropic";
  static Schema schema();

  /// \throws InputError  for a list without three entries, or directions that do not define axes
  explicit OrthotropicLaw(const Parameters& own);

 protected:
  ElasticStiffness doStiffness() const override;

 private:
  std::array<double, 3> young_, poisson_, shear_;
  Eigen::Matrix3d axes_;  // columns
};

}  // namespace suture
