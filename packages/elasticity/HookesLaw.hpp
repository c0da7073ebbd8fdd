#pragma once
#include <suture/elasticity/ElasticModel.hpp>

#include <algorithm>

namespace suture {

/// The law of a material as elements use it: strains and stresses in the order (xx, yy, zz, xy), zz across the plane or along the hoop.
struct HookesLaw {
  Eigen::Matrix4d pointwise;   ///< on the strain at each point; without zz row and column in plane stress
  double projected = 0.0;      ///< on the projection of the dilatation: of Mixed elements, whose `pointwise` lacks it
  double expansion = 0.0;      ///< thermal strain along any direction per unit of temperature
  Eigen::Matrix4d compliance;  ///< strains of stresses in three dimensions, whatever the plane model [1 / stress]

  HookesLaw() : pointwise(Eigen::Matrix4d::Zero()), compliance(Eigen::Matrix4d::Zero()) {}
  HookesLaw(const Material& material, PlaneModel plane);

  /// s.C s, C the compliance: twice the complementary energy density, whatever the plane model. [stress]
  double complementary(const Eigen::Vector4d& s) const { return s.dot(compliance * s); }

  /// True in plane stress.
  bool isSheet() const { return pointwise(2, 2) == 0.0; }

  /// Stress across the plane that keeps the strain there zero, from the others.
  double across(const Eigen::Vector4d& s) const {
    return -(compliance(2, 0) * s[0] + compliance(2, 1) * s[1] + compliance(2, 3) * s[3]) / compliance(2, 2);
  }

  /// Largest stress in the plane for a strain of one along an axis, but for what is projected.
  double normal() const { return std::max(pointwise(0, 0), pointwise(1, 1)); }
};

}  // namespace suture
