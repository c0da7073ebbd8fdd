#pragma once
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/EnhancedModes.hpp>
#include <suture/elasticity/HookesLaw.hpp>
#include <suture/elasticity/MixedPressure.hpp>

#include <optional>

namespace suture {

/// The computed stress of one element at the points of a rule, whatever the element's form and the geometry: rows as elementStresses().
/// \tparam D  dimension
template <int D>
class ElementStress {
 public:
  /// \param displacement  of the block's nodes, node-major, Cartesian;  all of them must outlive it
  ElementStress(const CellBlock& block, int element, const ReferenceElement& reference, const HookesLaw<D>& law, const Vector& displacement,
                const InitialState& initial);

  /// Moves to a point of the rule.
  void at(int point) { map_.at(point); }
  const ElementMap<D>& map() const { return map_; }
  /// Tension positive. [stress]
  StressVector<D> stress() const;
  /// The part that follows from the displacement: without initial strain and stress.
  StressVector<D> ofDisplacement() const;
  /// True if there is another part.
  bool isInitial() const { return initial_ != nullptr; }
  /// Initial strain and stress at the point.
  InitialState::Values<D> initial() const { return initial_ ? initial_->at(element_, map_.place(), cellLaw()) : InitialState::Values<D>(); }

 private:
  const HookesLaw<D>& cellLaw() const { return own_ ? *own_ : law_; }
  void findPressure(const CellBlock& block);
  void findEnhancedStrain(const CellBlock& block);
  /// True where the points of the rule are the element's centre alone, at which enhanced strains are zero.
  bool vanishAtCentre(const ReferenceElement& reference) const;

  using ElementVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, D * mostNodes<D>, 1>;

  int element_;
  const InitialState* initial_;  // null: the element has none
  const HookesLaw<D>& law_;
  std::optional<HookesLaw<D>> own_;  // where the cell's law has other values: a copy for each element would cost as much as its stress
  ElementMap<D> map_;
  ElementVector u_;
  bool axisymmetric_;
  std::optional<MixedPressure<D>> pressure_;
  std::optional<EnhancedStrain<D>> enhanced_, enhancedInitial_;  // enhanced strains: due to the displacement, due to the initial state
  typename MixedPressure<D>::Projection initialDilatation_;
};

}  // namespace suture
