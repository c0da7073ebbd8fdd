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

/// States of a block's elements before deformation: thermal strain, initial strain e_0 and initial stress s_0, so that s = D (e - e_0) +
/// s_0. One mechanism for temperature, shrinkage and swelling, bolt preload and in-situ stress in rock; most scenes have none.
class InitialState {
 public:
  /// No initial state.
  InitialState() = default;
  /// Initial states among the loads of the model, which must outlive this object. \param bodyOf  body of each element of the block
  InitialState(const ElasticModel& model, std::function<int(int element)> bodyOf);
  /// The same for a block of a single body, such as a subdomain.
  InitialState(const ElasticModel& model, int body);

  bool empty() const { return ofBody_.empty(); }
  bool isIn(int element) const { return !empty() && !ofBody_[bodyOf_(element)].empty(); }

  /// Strain and stress. \tparam D  dimension
  template <int D>
  struct Values {
    StressVector<D> strain = StressVector<D>::Zero(), stress = StressVector<D>::Zero();
  };
  /// \throws InputError  if an expression is not finite there, or gives an out-of-plane stress in plane stress
  template <int D>
  Values<D> at(int element, const Point& place, const HookesLaw<D>& law) const;

 private:
  std::vector<std::vector<const Load*>> ofBody_;  // empty: none at all
  std::function<int(int element)> bodyOf_;
};

/// Nodal forces of initial states, integral of B^T (D e_0 - s_0) by the quadrature rule of the stiffness: strains that the elements can
/// represent leave no stress. nodes x dimension, node-major, Cartesian [force]; empty if there is no initial state. Local. \param sizes  if
/// given, receives the sums of magnitudes over the elements, of the same shape: a bound for the round-off of the forces
Vector initialForces(const CellBlock& block, const std::function<const Material&(int element)>& materialOf, PlaneModel plane,
                     const InitialState& initial, Vector* sizes = nullptr);

}  // namespace suture
