#pragma once
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/MixedPressure.hpp>

#include <optional>

namespace suture {

/// The computed stress of one element at the points of a rule, whatever the element's form and the geometry: rows as elementStresses().
class ElementStress {
 public:
  /// \param displacement  of the block's nodes, node-major, Cartesian;  all but `law` must outlive it
  ElementStress(const CellBlock& block, int element, const ReferenceElement& reference, const HookesLaw& law, const Vector& displacement);

  /// Moves to a point of the rule.
  void at(int point) { map_.at(point); }
  const ElementMap& map() const { return map_; }
  /// xx, yy, zz, xy; tension positive. [stress]
  Eigen::Vector4d stress() const;

 private:
  using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 2 * ReferenceElement::maxNodes, 1>;

  HookesLaw law_;
  ElementMap map_;
  ElementVector u_;
  bool axisymmetric_;
  std::optional<MixedPressure> pressure_;
};

}  // namespace suture
