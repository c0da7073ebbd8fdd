#pragma once
#include <suture/pairs/mortar/MortarFace.hpp>
#include <suture/pairs/mortar/MortarSampling.hpp>

#include <vector>

namespace suture {

/// A surface in 3D facing a rigid obstacle: quadrature points of its sides and their distances to the obstacle. The multiplier is that of
/// FaceSampling. Local.
class ObstacleSampling : public MortarSampling {
 public:
  explicit ObstacleSampling(const ContactSurface& contact);

  int functions(int side, bool whole) const override;
  /// Normal of the pairs at the node: that of the obstacle or of the side (Contact::Direction).
  Point rowNormal(int side, int node) const override;
  MortarSamples sample(int side, const Point& normal) const override;

 private:
  const ContactSurface& contact_;
  std::vector<MortarFace> own_;
};

}  // namespace suture
