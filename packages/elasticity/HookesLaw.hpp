#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/StressVector.hpp>

namespace suture {

/// The law of a material as elements use it, on strains and stresses as StressVector.hpp has them. \tparam D  dimension
template <int D>
struct HookesLaw {
  StressMatrix<D> pointwise;   ///< on the strain at each point; without zz row and column in plane stress
  double projected = 0.0;      ///< on the projection of the dilatation: of Mixed elements, whose `pointwise` lacks it
  bool enhanced = false;       ///< of(cell): the element has enhanced strains (EnhancedModes.hpp)
  double expansion = 0.0;      ///< thermal strain along any direction per unit of temperature
  StressMatrix<D> compliance;  ///< strains of stresses in three dimensions, whatever the plane model [1 / stress]

  HookesLaw() : pointwise(StressMatrix<D>::Zero()), compliance(StressMatrix<D>::Zero()) {}
  /// \param plane  means nothing in space
  HookesLaw(const Material& material, PlaneModel plane);

  /// The law of the elements of one cell: Quadrilateral4 and Hexahedron8 of an enhanced material have `enhanced` strains and nothing
  /// projected, all others have no enhanced strains.
  HookesLaw of(Cell cell) const;

  /// s.C s, C the compliance: twice the complementary energy density, whatever the plane model. [stress]
  double complementary(const StressVector<D>& s) const { return s.dot(compliance * s); }

  /// True in plane stress.
  bool isSheet() const { return pointwise(2, 2) == 0.0; }

  /// Stress across the plane that keeps the strain there zero, from the others.
  double across(const StressVector<D>& s) const {
    static_assert(D == 2, "in space no strain follows from the others");
    return -(compliance(2, 0) * s[0] + compliance(2, 1) * s[1] + compliance(2, 3) * s[3]) / compliance(2, 2);
  }

  /// Largest stress along an axis of the plane or of space for a strain of one along it, but for what is projected.
  double normal() const { return pointwise.diagonal().template head<D>().maxCoeff(); }
};

}  // namespace suture
