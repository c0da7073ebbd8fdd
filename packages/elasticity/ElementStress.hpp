#pragma once
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/EnhancedModes.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/MixedPressure.hpp>

#include <optional>

namespace suture {

/// The computed stress of one element at the points of a rule, for every element form and geometry; components as in elementStresses().
/// \tparam D  dimension
template <int D>
class ElementStress {
 public:
  /// \param displacement  of the block's nodes, node-major, Cartesian;  all arguments must outlive this object
  ElementStress(const CellBlock& block, int element, const ReferenceElement& reference, const HookesLaw<D>& law, const Vector& displacement,
                const InitialState& initial);

  /// Moves to a point of the rule.
  void at(int point) { map_.at(point); }
  const ElementMap<D>& map() const { return map_; }
  /// Tension positive. [stress]
  StressVector<D> stress() const;
  /// Part of the stress due to the displacement: without initial strain and stress.
  StressVector<D> ofDisplacement() const;
  /// True if the element has an initial state.
  bool isInitial() const { return initial_ != nullptr; }
  /// Initial strain and stress at the point.
  InitialState::Values<D> initial() const { return initial_ ? initial_->at(element_, map_.place(), cellLaw()) : InitialState::Values<D>(); }

 private:
  const HookesLaw<D>& cellLaw() const { return own_ ? *own_ : law_; }
  void findPressure(const CellBlock& block);
  void findEnhancedStrain(const CellBlock& block);
  /// True if the only point of the rule is the element's centre, where enhanced strains are zero.
  bool vanishAtCentre(const ReferenceElement& reference) const;

  using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, D * mostNodes<D>, 1>;

  int element_;
  const InitialState* initial_;  // null: the element has none
  const HookesLaw<D>& law_;
  std::optional<HookesLaw<D>> own_;  // law of the cell where it differs; a copy for every element would cost as much as its stress
  ElementMap<D> map_;
  ElementVector u_;
  bool axisymmetric_;
  std::optional<MixedPressure<D>> pressure_;
  std::optional<EnhancedStrain<D>> enhanced_, enhancedInitial_;  // enhanced strains: due to the displacement, due to the initial state
  typename MixedPressure<D>::Projection initialDilatation_;
};

}  // namespace suture
