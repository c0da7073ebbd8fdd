#pragma once
#include <suture/base/Point.hpp>
#include <suture/base/Types.hpp>
#include <suture/elasticity/StressVector.hpp>

#include <functional>
#include <vector>

namespace suture {

struct ElasticModel;
template <int D>
struct HookesLaw;
struct Load;
struct Material;
struct CellBlock;
enum class PlaneModel;

/// States of a block's elements before they deform: thermal strain, initial strain e_0 and initial stress s_0, so that s = D (e - e_0)
/// + s_0. One mechanism for temperature, shrinkage and swelling, a bolt's preload and stress in rock; most scenes have none.
class InitialState {
 public:
  /// None.
  InitialState() = default;
  /// Those among the model's loads, which must outlive it. \param bodyOf  body of each element of the block
  InitialState(const ElasticModel& model, std::function<int(int element)> bodyOf);
  /// The same for a block of one body, as a subdomain.
  InitialState(const ElasticModel& model, int body);

  bool empty() const { return ofBody_.empty(); }
  bool isIn(int element) const { return !empty() && !ofBody_[bodyOf_(element)].empty(); }

  /// Strain and stress. \tparam D  dimension
  template <int D>
  struct Values {
    StressVector<D> strain = StressVector<D>::Zero(), stress = StressVector<D>::Zero();
  };
  /// \throws InputError  an expression is not finite there, or gives a sheet in plane stress a stress across
  template <int D>
  Values<D> at(int element, const Point& place, const HookesLaw<D>& law) const;

 private:
  std::vector<std::vector<const Load*>> ofBody_;  // empty: none at all
  std::function<int(int element)> bodyOf_;
};

/// Nodal forces of initial states, integral of B^T (D e_0 - s_0) by the rule of the stiffness: strains that the elements can represent
/// leave no stress. nodes x dimension, node-major, Cartesian [force]; without any, empty. Local. \param sizes  if given, gets the sums of
/// magnitudes over the elements, of the same shape: how much rounding may be in the forces
Vector initialForces(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                     const InitialState& initial, Vector* sizes = nullptr);

}  // namespace suture
