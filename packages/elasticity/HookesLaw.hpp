#pragma once
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/elasticity/StressVector.hpp>

namespace suture {

/// The law of a material as used by elements, for strains and stresses in the order of StressVector.hpp. \tparam D  dimension
template <int D>
struct HookesLaw {
  StressMatrix<D> pointwise;   ///< acts on the strain at each point; zz row and column are zero in plane stress
  double projected = 0.0;      ///< acts on the projected dilatation: for Mixed elements, whose `pointwise` excludes it
  bool enhanced = false;       ///< result of of(cell): the element has enhanced strains (EnhancedModes.hpp)
  double expansion = 0.0;      ///< thermal strain along any direction per unit of temperature
  StressMatrix<D> compliance;  ///< 3D strains due to stresses, independent of the plane model [1 / stress]

  HookesLaw() : pointwise(StressMatrix<D>::Zero()), compliance(StressMatrix<D>::Zero()) {}
  /// \param plane  ignored in 3D
  HookesLaw(const Material& material, PlaneModel plane);

  /// Law of the elements of one cell type: Quadrilateral4 and Hexahedron8 of an enhanced material have `enhanced` strains and no projected
  /// part; all other cells have no enhanced strains.
  HookesLaw of(Cell cell) const;

  /// s.C s, C the compliance: twice the complementary energy density, for every plane model. [stress]
  double complementary(const StressVector<D>& s) const { return s.dot(compliance * s); }

  /// True in plane stress.
  bool isSheet() const { return pointwise(2, 2) == 0.0; }

  /// Out-of-plane stress for which the out-of-plane strain is zero, from the other components.
  double across(const StressVector<D>& s) const {
    static_assert(D == 2, "2D only: the out-of-plane stress follows from the others");
    return -(compliance(2, 0) * s[0] + compliance(2, 1) * s[1] + compliance(2, 3) * s[3]) / compliance(2, 2);
  }

  /// Largest stress along a coordinate axis for a unit strain along it, without the projected part.
  double normal() const { return pointwise.diagonal().template head<D>().maxCoeff(); }
};

}  // namespace suture
