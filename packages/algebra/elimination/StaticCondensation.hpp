#pragma once
#include <suture/algebra/dense/SymmetricMatrix.hpp>
#include <suture/algebra/elimination/SingleFactor.hpp>
#include <suture/base/Types.hpp>

#include <vector>

namespace suture {

/// Elimination of a subdomain's interior onto its boundary:
///     S = A_BB - A_BI A_II^-1 A_IB,   g = f_B - A_BI A_II^-1 f_I,
/// by a multifrontal factorisation of A_II (FrontTree) that stops at the boundary, where the remainder of the last front is S. Unlike in a
/// factorisation of the whole matrix, S is not factored and multiplied back, so floating bodies need no shift. Dense blocks by BLAS and
/// LAPACK. S times a translation vanishes to 2e-15 of S for 200 unknowns, 1e-14 for 1,900, 3e-14 for 7,400 (bounds of the test). Local.
class StaticCondensation {
 public:
  /// \param load      all unknowns
  /// \param boundary  positions of B
  /// \param places    coordinates of each unknown's node. They affect the time and, by round-off only, S.
  /// \throws NumericalError    a pivot of A_II is not positive, or is only round-off; names the unknown
  /// \throws EnvironmentError  out of memory
  StaticCondensation(const SymmetricMatrix& matrix, const Vector& load, const std::vector<int>& boundary, const std::vector<Point>& places);

  /// S in the order of `boundary`; its lower triangle is set. May be moved from, like factor().
  Matrix& schur() { return schur_; }
  /// g.
  const Vector& condensedLoad() const { return condensedLoad_; }
  /// -f_I A_II^-1 f_I / 2.
  double interiorEnergy() const { return interiorEnergy_; }
  /// The factor of A_II, converted to single precision.
  SingleFactor& factor() { return factor_; }
  /// Smallest pivot of A_II relative to its diagonal entry.
  double smallestPivot() const { return smallestPivot_; }

 private:
  Matrix schur_;
  Vector condensedLoad_;
  double interiorEnergy_ = 0.0, smallestPivot_ = 1.0;
  SingleFactor factor_;
};

}  // namespace suture
