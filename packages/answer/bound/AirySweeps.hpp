#pragma once
#include <suture/answer/bound/StarMesh.hpp>

namespace suture {

/// Improves equilibrated tractions in 2D by conjugate gradients for the least complementary energy.
///
/// Changes of the stresses are derived from a stress function, continuous with its gradient, a polynomial of degree k + 2 on each part of
/// the split triangles (Hsieh-Clough-Tocher elements): every iterate is exactly in equilibrium. The preconditioner solves exactly on the
/// star of each vertex. Local data: one ring of triangles; each iteration exchanges values with neighbours once.
class AirySweeps {
 public:
  /// \param tractions  EquilibratedTractions::values; all arguments must outlive this
  AirySweeps(const StarMesh<2>& mesh, const Matrix& tractions);

  /// Collective.
  void run(int sweeps);
  /// Squared energy of the difference between statically admissible stress and the stress of the displacement, by own triangle.
  /// [energy]
  Vector energies() const;
  /// Largest resultant of the data of an own triangle, relative to `scale`. \param scale  [force]
  double imbalance() const { return imbalance_; }

 private:
  struct Field {
    Matrix ofVertices, ofSides;  // value and gradient, 3 x vertices; values on sides
  };
  void findFreedom();
  void constrain(int side);
  void assemble(const Matrix& tractions);
  Matrix sideTractions(int side) const;
  void factorStars();
  Field zero() const;
  Vector gather(const Field& field, int e) const;
  void scatter(const Vector& values, int e, Field& field) const;
  Field product(const Field& p) const;
  Field precondition(const Field& r) const;
  void exchange(Field& field) const;
  double dot(const Field& a, const Field& b) const;
  int dofs() const { return 9 + 3 * onSide_; }

  const StarMesh<2>& mesh_;
  int onSide_;                                         // unknowns of a side besides those of its ends
  std::vector<Eigen::Matrix2d> frames_;                // of the gradient at each vertex, columns
  std::vector<unsigned> fixedAtVertex_, fixedAtSide_;  // bits
  std::vector<double> matrices_;                       // of all triangles, dofs x dofs each
  Matrix loads_;                                       // T^T G d, dofs x triangles
  Vector start_;                                       // d.G d of own triangles
  double imbalance_ = 0.0;
  Field solution_;
  // Stars: sides, and Cholesky factors one after the other.
  std::vector<int> starSides_, starBegin_;
  std::vector<double> factors_;
  std::vector<std::size_t> factorBegin_;
};

}  // namespace suture
