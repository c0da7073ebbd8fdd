#pragma once
#include <suture/answer/bound/StarMesh.hpp>
#include <suture/answer/bound/SweepGain.hpp>

namespace suture {

/// Improves equilibrated tractions in 2D by conjugate gradients for the least complementary energy.
///
/// Changes of the stresses are derived from a stress function, continuous with its gradient, a polynomial of degree k + 2 on each part of
/// the split triangles (Hsieh-Clough-Tocher elements): every iterate is exactly in equilibrium. The preconditioner solves exactly on the
/// star of each vertex. Local data: one ring of triangles; each iteration exchanges values with neighbours once.
/// \tparam K  degree of the stresses, 1 or 2
template <int K>
class AirySweeps {
 public:
  /// \param tractions  EquilibratedTractions::values; all arguments must outlive this
  AirySweeps(const StarMesh<2>& mesh, const Matrix& tractions);

  /// At least `sweeps` iterations, more while they pay (worthAnotherSweep). Collective.
  void run(int sweeps);
  /// Squared energy of the difference between statically admissible stress and the stress of the displacement, by own triangle.
  /// [energy]
  Vector energies() const;
  /// Largest resultant of the data of an own triangle, relative to `scale`. \param scale  [force]
  double imbalance() const { return imbalance_; }

 private:
  static constexpr int onSide = K == 1 ? 1 : 3;  ///< unknowns of a side besides those of its ends
  static constexpr int dofs = 9 + 3 * onSide, sideData = 2 * (K + 1), tractions = 3 * sideData;
  using Local = Eigen::Matrix<double, dofs, 1>;
  using LocalMatrix = Eigen::Matrix<double, dofs, dofs>;
  using OfSide = Eigen::Matrix<double, sideData, 6 + onSide>;
  struct Field {
    Matrix ofVertices, ofSides;  ///< value and gradient, 3 x vertices; onSide x sides
  };
  void findFreedom();
  void constrain(int side);
  void assemble(const Matrix& given);
  OfSide sideTractions(int side) const;
  void factorStars();
  void listStars();
  Field zero() const;
  Local gather(const Field& field, int e) const;
  void scatter(const Local& values, int e, Field& field) const;
  Field product(const Field& p) const;
  Field precondition(const Field& r) const;
  void exchange(Field& field) const;
  double dot(const Field& a, const Field& b) const;
  Eigen::Map<const LocalMatrix> matrix(int e) const { return Eigen::Map<const LocalMatrix>(&matrices_[std::size_t(e) * dofs * dofs]); }

  const StarMesh<2>& mesh_;
  std::vector<Eigen::Matrix2d> frames_;                // axes for the gradient at each vertex, columns
  std::vector<unsigned> fixedAtVertex_, fixedAtSide_;  // bits
  std::vector<double> matrices_;                       // stiffness of all triangles
  Matrix loads_;                                       // dofs x triangles
  Vector start_;                                       // energies of own triangles before the first sweep
  double imbalance_ = 0.0;
  Field solution_;
  // Stars: sides, and packed Cholesky factors one after the other, rows of the lower triangles; a zero on the diagonal marks a fixed
  // unknown.
  std::vector<int> starSides_, starBegin_;
  std::vector<double> factors_;
  std::vector<std::size_t> factorBegin_;
};

}  // namespace suture
