#pragma once
#include <suture/elasticity/ElasticModel.hpp>

namespace suture {

/// The law of a material as elements use it: strains and stresses in the order (xx, yy, zz, xy), zz across the plane or along the hoop.
struct HookesLaw {
  Eigen::Matrix4d pointwise;  ///< on the strain at each point; without zz row and column in plane stress
  double projected = 0.0;     ///< Lame constant on the projection of the dilatation: of Mixed elements, which have no lambda in `pointwise`

  /// s.C s, C the compliance in three dimensions: twice the complementary energy density, whatever the plane model. [stress]
  double complementary(const Eigen::Vector4d& s) const {
    const double trace = s[0] + s[1] + s[2], squares = s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2 * s[3] * s[3];
    return ((1 + poisson) * squares - poisson * trace * trace) / young;
  }

  double young = 0.0, poisson = 0.0;

  HookesLaw() : pointwise(Eigen::Matrix4d::Zero()) {}
  HookesLaw(const Material& material, PlaneModel plane);
};

}  // namespace suture
