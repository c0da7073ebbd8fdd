#pragma once
#include <suture/answer/bound/AlfeldStresses.hpp>

namespace suture {

/// Piecewise polynomial stresses on one simplex, exactly in equilibrium with given tractions and sources (their data), and the least
/// complementary energy of such stresses: the element of the strict error bound.
///
/// The stress is a symmetric polynomial of degree k on each part of the Alfeld split (AlfeldStresses), with continuous tractions. With k =
/// 1 balanced data determine it; with k = 2 the one of least energy is meant. Stresses with compatible strains, such as those of
/// displacements, have the least energy.
///
/// Data: traction of side a at its node j, component c: (a sideNodes() + j) D + c; then the sources -div s at the source nodes:
/// tractions() + j D + c. Side a is opposite to vertex a; its nodes are its vertices in ascending order, then with k = 2 the middles of its
/// edges (0, 1), (1, 2), (0, 2), numbered within the side. Tractions act on this simplex (outward normal) [stress]; sources are forces per
/// volume. All components are Cartesian.
///
/// Round-off in a simplex whose longest edge is A times its least height, for a compliance of condition c: relative errors of about
/// 1e-16 c A^4 in x.G x and 1e-16 sqrt(c) A^2 in energy().
/// Local and thread-safe.
template <int D>
class StressElement {
 public:
  static constexpr int components = AlfeldStresses<D>::components;  ///< xx, yy, xy; in 3D xx, yy, zz, xy, yz, xz
  static constexpr int rigidModes = D * (D + 1) / 2;
  using Map = Eigen::Matrix<double, D, D>;           ///< columns: x_i - x_0, i = 1..D; its determinant may be negative
  using Vertices = Eigen::Matrix<double, D, D + 1>;  ///< columns
  using Stress = Eigen::Matrix<double, components, 1>;
  using Compliance = Eigen::Matrix<double, components, components>;  ///< from stresses to strains, with engineering shear strains
  using Barycentric = Eigen::Matrix<double, D + 1, 1>;

  /// \param degree  1 or 2. \throws InternalError  for another. Creates the tables on first use.
  static const StressElement& of(int degree);

  int degree() const { return degree_; }
  /// Nodes of a side: k + 1 in 2D; 3 or 6 in 3D.
  int sideNodes() const { return sideNodes_; }
  /// Constant sources for k = 1, otherwise linear ones with the vertices as nodes.
  int sourceNodes() const { return sourceNodes_; }
  int tractions() const { return (D + 1) * sideNodes_ * D; }
  int data() const { return tractions() + sourceNodes_ * D; }

  /// Coefficients of a stress on the parts of the split, rank of the equations for them, and those that the data leave free.
  int unknowns() const { return int(particular_.rows()); }
  int rank() const { return unknowns() - free(); }
  int free() const { return int(free_.cols()); }

  /// G with x.G x = least integral of s.C s over the stresses s with the data x; symmetric, meaningful for balanced x. [volume / stress]
  void gram(const Map& map, const Compliance& compliance, Matrix& result) const;
  /// x.G x as a sum of squares: more accurate than with gram() on flat simplices, and the energy of a stress with these data in any case.
  double energy(const Map& map, const Compliance& compliance, const Vector& data) const;
  /// The stress of least energy at a point of a part of the split. \param point  barycentric coordinates within the part, whose vertices
  /// are those of side `part`, ascending, then the centroid
  Stress stress(const Map& map, const Compliance& compliance, const Vector& data, int part, const Barycentric& point) const;

  /// Resultants of data [stress]: D forces, then moments about the centroid (one; in 3D about x, y and z) over the root mean square
  /// distance from it to the vertices. Zero for balanced data. rigidModes x data()
  void resultants(const Vertices& vertices, Matrix& result) const;
  /// The data of a linear stress, given at the vertices.
  void dataOf(const Vertices& vertices, const Eigen::Matrix<double, components, D + 1>& stresses, Vector& result) const;

 private:
  static constexpr int pairs = components * (components + 1) / 2;
  static constexpr int mostData = D == 2 ? 24 : 84;
  static constexpr int mostFree = D == 2 ? 3 : 18;
  struct Piola;
  struct FreePart;

  explicit StressElement(int degree);

  void tabulate();
  Eigen::Index packed() const { return moments_.rows(); }
  Vector coefficients(const Piola& piola, const Vector& data) const;

  int degree_, sideNodes_, sourceNodes_;
  Matrix particular_, free_;  // AlfeldStresses
  // For each pair of components a <= b the integral of their products in the reference simplex, as one column: (particular x particular) by
  // columns of D x D blocks from the diagonal downwards, then (free x particular), (free x free).
  Matrix moments_;
  Matrix massRoot_;               // Cholesky factor of the integrals of products of two basis functions over a part
  Matrix sidePlaces_, sideArms_;  // barycentric coordinates of a side's nodes, and their means weighted by the nodes' functions
  Vector sideMeans_;              // mean values of the nodes' functions
};

}  // namespace suture
