#pragma once
#include <suture/elasticity/ElasticModel.hpp>

namespace suture {

/// The law of a material as elements use it: strains and stresses in the order (xx, yy, zz, xy), zz across the plane or along the hoop.
struct HookesLaw {
  Eigen::Matrix4d pointwise;  ///< on the strain at each point; without zz row and column in plane stress
  double projected = 0.0;     ///< Lame constant on the projection of the dilatation: of Mixed elements, which have no lambda in `pointwise`

  HookesLaw() : pointwise(Eigen::Matrix4d::Zero()) {}
  HookesLaw(const Material& material, PlaneModel plane);
};

}  // namespace suture
