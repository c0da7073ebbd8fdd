#pragma once
#include <suture/answer/bound/BoundElements.hpp>

namespace suture {

/// Strains of displacements and nodal forces of stresses on a straight simplex, integrated in closed form. Nodes as in SimplexNodes. Local.
template <int D>
class SimplexField {
 public:
  static constexpr int stress = BoundElement<D>::stress;
  using Nodal = Eigen::Matrix<double, D, (D == 2 ? 6 : 10)>;  ///< displacements, or forces
  using AtVertices = Eigen::Matrix<double, stress, D + 1>;    ///< linear stresses, or strains with engineering shear
  using Stiffness = Eigen::Matrix<double, stress, stress>;

  /// \param vertices  [length]
  explicit SimplexField(const Eigen::Matrix<double, D, D + 1>& vertices);

  double volume() const { return volume_; }
  /// Strains at the vertices. \param degree  of the displacements, 1 or 2
  AtVertices strains(const Nodal& displacements, int degree) const;
  /// Integral of B^T s for a linear stress s. \param degree  of the displacements, 1 or 2
  Nodal forces(const AtVertices& stresses, int degree) const;
  /// Nodal forces of a linear body force, by its values at the vertices. \param degree  of the displacements, 1 or 2
  Nodal forcesOfSources(const Eigen::Matrix<double, D, D + 1>& sources, int degree) const;
  /// Integral of s.C s for a linear stress s.
  double energy(const AtVertices& stresses, const Stiffness& compliance) const;

 private:
  Eigen::Matrix<double, D, D + 1> gradients_;  // gradients of the barycentric coordinates
  double volume_;
};

}  // namespace suture
