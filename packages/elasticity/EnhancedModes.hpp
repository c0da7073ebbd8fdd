#pragma once
#include <suture/elasticity/ElementMap.hpp>
#include <suture/elasticity/HookesLaw.hpp>

#include <Eigen/Cholesky>

namespace suture {

/// Functions of the reference coordinates from which enhanced strains are built, minus their means: 2D: xi, eta, xi eta; 3D: xi, eta, zeta,
/// eta zeta, zeta xi, xi eta, xi eta zeta. \tparam D  dimension
template <int D>
struct EnhancedFunctions {
  static constexpr int count = D == 2 ? 3 : 7;
  double means[count] = {};  ///< nonzero in axisymmetric blocks only

  /// \param x  reference coordinates
  void at(const double* x, double (&f)[count]) const {
    for (int k = 0; k < D; ++k) f[k] = x[k];
    f[D] = x[D - 2] * x[D - 1];
    if constexpr (D == 3) {
      f[4] = x[2] * x[0];
      f[5] = x[0] * x[1];
      f[6] = x[0] * f[3];
    }
    for (int i = 0; i < count; ++i) f[i] -= means[i];
  }
};

/// An enhanced strain of one element.
template <int D>
struct EnhancedStrain {
  EnhancedFunctions<D> functions;
  Eigen::Matrix<double, stressComponents<D>, EnhancedFunctions<D>::count>
      factors;  ///< strain per function, times the determinant of the map

  /// Strain at the current point of a map of the element.
  StressVector<D> at(const ElementMap<D>& map) const {
    double f[EnhancedFunctions<D>::count];
    functions.at(map.referencePlace(), f);
    StressVector<D> strain = factors.col(0) * f[0];
    for (int i = 1; i < EnhancedFunctions<D>::count; ++i) strain += factors.col(i) * f[i];
    return strain / map.determinant();
  }
};

/// Enhanced strains of one Quadrilateral4 or Hexahedron8: strains that nodal displacements cannot produce, with amplitudes eliminated
/// within the element (static condensation), so that the element bends without locking (Simo and Rifai, Int. J. Num. Meth. Eng. 29,
/// 1595-1638, 1990; on parallelograms the incompatible modes QM6 of Taylor, Beresford and Wilson, 1976).
///
/// The strain is e(u) + sum of alpha_m f_m / j E_m: f_m a function of the reference coordinates with zero mean, j the determinant of the
/// element's map and E_m a constant tensor. It is therefore orthogonal to constant stresses, and the patch test holds on distorted
/// elements. In axisymmetric blocks the mean is weighted with the radius.
/// - D vectors along each reference direction i: f = xi_i, E = sym(vector x c_i), c_i the cofactors of the map at the centre.
/// - The remaining dilatation at the points of the rule, except its mean: f = eta zeta, zeta xi, xi eta, xi eta zeta and E = identity in
/// 3D, f = xi eta and E = the hoop strain in axisymmetric blocks. Elements then do not lock as nu tends to 0.5: one constraint is left, as
/// in Mixed elements of constant pressure.
///
/// Usage: add() at all points of the stiffness rule, then close(). \tparam D  dimension
template <int D>
class EnhancedModes {
 public:
  static constexpr int nodes = D == 2 ? 4 : 8;
  static constexpr int count = D == 2 ? 5 : 13;  ///< modes; the last one is empty in 2D
  using Amplitudes = Eigen::Matrix<double, count, 1>;

  /// \param rule  stiffnessElement() of the element
  EnhancedModes(const CellBlock& block, int element, const ReferenceElement& rule, const ElementMap<D>& map);

  /// Adds the point at which the map currently is.
  void add(const ElementMap<D>& map);
  /// Factorises the stiffness of the modes. \param law  pointwise law for the strain
  void close(const StressMatrix<D>& law);

  /// Subtracts the compliance of the modes from a stiffness matrix, upper triangle. \param k  D * nodes square
  template <typename ElementMatrix>
  void condense(ElementMatrix& k) const {
    const Eigen::Matrix<double, count, D* nodes> root = factor_.matrixL().solve(coupling_);
    for (int j = 0; j < D * nodes; ++j)
      for (int i = 0; i <= j; ++i) k(i, j) -= root.col(i).dot(root.col(j));
  }

  /// Amount by which condense() reduces the diagonal.
  Eigen::Matrix<double, D * nodes, 1> softening() const {
    const Eigen::Matrix<double, count, D* nodes> root = factor_.matrixL().solve(coupling_);
    return root.colwise().squaredNorm().transpose();
  }

  /// Adds the forces that a stress at the current point of the map exerts on the modes.
  void addForces(const ElementMap<D>& map, const StressVector<D>& stress, Amplitudes& forces) const {
    double f[Functions::count];
    functions_.at(map.referencePlace(), f);
    const double factor = map.measure() / map.determinant();
    for (int m = 0; m < count; ++m) forces[m] += factor * f[functionOf(m)] * tensors_.col(m).dot(stress);
  }
  /// Strain of the modes under forces on them.
  EnhancedStrain<D> strain(const Amplitudes& forces) const;
  /// Strain of the modes for displacements of the nodes (node-major).
  template <typename Displacement>
  EnhancedStrain<D> strainOf(const Displacement& u) const {
    return strain(-(coupling_ * u));
  }
  /// Nodal forces that replace forces on the modes once the modes are eliminated (node-major).
  Eigen::Matrix<double, D * nodes, 1> condensed(const Amplitudes& forces) const { return -(coupling_.transpose() * factor_.solve(forces)); }

 private:
  using Functions = EnhancedFunctions<D>;
  static constexpr int functionOf(int mode) { return mode < D * D ? mode / D : mode - D * D + D; }
  void setTensors(Cell cell, const ElementMap<D>& map);
  void setMeans(const ReferenceElement& rule, const ElementMap<D>& map);

  bool axisymmetric_;
  Functions functions_;
  double products_[Functions::count][Functions::count] = {};   // integrals of f_i f_j / j^2, upper triangle
  Eigen::Matrix<double, D * nodes, Functions::count> slopes_;  // integrals of f_i / j times the gradients of the shape functions
  Eigen::Matrix<double, nodes, Functions::count> hoops_;       // likewise for the hoop strains, in axisymmetric blocks
  Eigen::Matrix<double, stressComponents<D>, count> tensors_;
  Eigen::Matrix<double, count, D * nodes> coupling_;  // integrals of the modes' stress times the strain of each degree of freedom
  Eigen::LLT<Eigen::Matrix<double, count, count>> factor_;
};

}  // namespace suture
