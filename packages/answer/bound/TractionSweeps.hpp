#pragma once
#include <suture/answer/bound/EdgeStars.hpp>
#include <suture/answer/bound/SweepGain.hpp>

#include <optional>
#include <vector>

namespace suture {

/// Improves equilibrated tractions in 3D by conjugate gradients for the least complementary energy. The preconditioner solves exactly on
/// the star of each edge (EdgeStars), over tractions on its faces that leave each tetrahedron in equilibrium: every iterate is exactly in
/// equilibrium (Ainsworth and Oden, A Posteriori Error Estimation, 2000, use such stars of vertices). One ring of tetrahedra; each
/// iteration exchanges values with neighbours once.
/// \tparam K  degree of the stresses, 1 or 2
template <int K>
class TractionSweeps {
 public:
  /// \param tractions  EquilibratedTractions::values; all arguments must outlive this
  TractionSweeps(const StarMesh<3>& mesh, const Matrix& tractions);

  /// At least `sweeps` iterations, more while they pay (worthAnotherSweep). Collective.
  void run(int sweeps);
  /// Squared energy of the difference between statically admissible stress and the stress of the displacement, by own tetrahedron.
  /// [energy]
  Vector energies() const { return start_ + change_; }
  /// Largest resultant of the data of an own tetrahedron, relative to the largest force.
  double imbalance() const { return imbalance_; }

 private:
  using Face = FaceTractions<K>;
  static constexpr int count = Face::count, dofs = 4 * count, packed = dofs * (dofs + 1) / 2;
  using Local = Eigen::Matrix<double, dofs, 1>;

  void assemble(const Matrix& tractions);
  void toBases(int e, Matrix& gram);
  Local gather(const Matrix& field, int e) const;
  void scatter(const Local& values, int e, Matrix& field) const;
  Local product(int e, const Local& x) const;
  double dot(const Matrix& a, const Matrix& b) const;

  const StarMesh<3>& mesh_;
  std::vector<Face> faces_;
  std::vector<double> grams_;  // matrices of all tetrahedra in the bases of their faces, rows of the lower triangles
  Matrix loads_;               // G d in the same bases, dofs x tetrahedra
  Vector start_, change_;
  double imbalance_ = 0.0;
  std::optional<EdgeStars<K>> stars_;
};

}  // namespace suture
