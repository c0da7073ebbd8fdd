#pragma once
#include <suture/answer/bound/StarMesh.hpp>
#include <suture/answer/bound/SweepGain.hpp>

namespace suture {

/// Improves equilibrated tractions in 3D by conjugate gradients for the least complementary energy. The preconditioner solves exactly on
/// the star of each edge, over all tractions on the faces at the edge that leave each tetrahedron in equilibrium: every iterate is exactly
/// in equilibrium (Ainsworth and Oden, A Posteriori Error Estimation, 2000, use such stars of vertices). One ring of tetrahedra; each
/// iteration exchanges values with neighbours once. Nothing of the stars is stored.
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
  struct Star {
    std::vector<int> elements, sides;
  };
  void assemble(const Matrix& tractions);
  void findStars();
  Vector gather(const Matrix& field, int e) const;
  void scatter(const Vector& values, int e, Matrix& field) const;
  Matrix product(const Matrix& p) const;
  Matrix precondition(const Matrix& r) const;
  void solveStar(const Star& star, const Matrix& r, Matrix& z) const;
  double dot(const Matrix& a, const Matrix& b) const;
  Eigen::Map<const Matrix> gram(int e) const { return {&grams_[std::size_t(e) * count_ * count_], count_, count_}; }

  const StarMesh<3>& mesh_;
  int nodes_, count_;          // nodes of a side; tractions of a tetrahedron
  std::vector<double> grams_;  // Gram matrices of all tetrahedra
  Matrix loads_;               // G d, count_ x tetrahedra
  Vector start_, change_;
  double imbalance_ = 0.0;
  std::vector<Star> stars_;
};

}  // namespace suture
