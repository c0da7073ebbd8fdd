#pragma once
#include <suture/monolithic/MonolithicContact.hpp>
#include <suture/search/RigidBodyModel.hpp>

namespace suture {

/// The Delassus matrix H of a condensed contact problem and related data: with forces f of the rows and amplitudes a of the kernel,
///     C x - g = h - H f + (C Z) a.
/// Dense factorisations of the bodies' blocks. Local.
class Delassus {
 public:
  /// `problem` must outlive it.
  explicit Delassus(const CondensedContact& problem);

  RigidBodyModel rigidBodyModel() const;
  /// x for given row forces, with kernel amplitudes `place`.
  Vector displacement(const Vector& force, const Vector& place) const;
  /// x.S x / 2 - f.x if the row forces do no work.
  double energy(const Vector& force, const Vector& place) const {
    return -0.5 * constant_ + 0.5 * gapless_.dot(force) - 0.5 * work_.dot(place);
  }
  const std::vector<int>& blocksOf(int row) const { return blocksOf_[static_cast<std::size_t>(row)]; }  ///< blocks of a row
  const Matrix& compliance() const { return h_; }                                                       ///< H
  const Vector& open() const { return gapless_; }                                                       ///< h: C S^-1 f - g
  const Matrix& motions() const { return g_; }      ///< C Z, with columns of Z of order one
  const Vector& work() const { return work_; }      ///< Z^T f
  const Matrix& kernel() const { return kernel_; }  ///< Z
  /// Round-off error of h in each row. [length]
  Vector rounding() const;

 private:
  const CondensedContact& problem_;
  const int rows_, modes_;
  std::vector<Matrix> factors_;             // factors of S with stiffness added on the kernel, by block
  std::vector<std::vector<int>> blocksOf_;  // blocks of each row
  Matrix h_;                                // compliance H of the rows
  Matrix g_, kernel_;                       // rows times kernel; the kernel, columns of order one
  Vector gapless_, work_;                   // h = C S^-1 f - bound;   Z^T f
  double constant_ = 0.0;                   // f.S^-1 f
};

}  // namespace suture
