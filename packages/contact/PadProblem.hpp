#pragma once
#include <suture/base/Types.hpp>

namespace suture {

constexpr double kDependentRows = 1e-9;     ///< singular value of rows of the order of one below which they leave a motion free
constexpr double kNoPadEquilibrium = 1e-8;  ///< imbalance of pad forces, relative to their sum, that is no equilibrium

/// Equilibrium of rigid bodies on unilateral pads:  min over x of  sum k (t + rows x)_+^2 / 2 - e.x.  Convex and piecewise quadratic in few
/// unknowns: Newton's method with an exact line search. Holds references: its arguments must outlive it. Local.
class PadProblem {
 public:
  /// \param rows        pads x motions, of the order of one
  /// \param stiffness   k >= 0 of the pads [force / length]
  /// \param work        e, of the loads in each motion [force]
  /// \param forceScale  by which, with the pad forces themselves, an imbalance is measured [force]
  PadProblem(const Matrix& rows, const Vector& stiffness, const Vector& work, double forceScale)
      : rows_(rows), stiffness_(stiffness), work_(work), forceScale_(forceScale) {}

  /// From x to the equilibrium; where plain steps do not settle, over pads that press before they are touched and get harder.
  /// \param x  motions
  /// \param y  penetrations t + rows x. They are moved with x, never computed from it: rounding of long ways changes the
  ///           gaps by as little, and forces keep their digits.
  /// \return false: the loads drive a motion that no pad stops
  bool solve(Vector& x, Vector& y) const;

 private:
  enum class End { Found, Unbounded, Exhausted };

  double slope(const Vector& y, const Vector& v, double work, double a) const;
  double lineSearch(const Vector& y, const Vector& v, double work) const;
  Vector gradient(const Vector& y) const;
  Vector scales(const Matrix& hessian) const;
  End newton(Vector& x, Vector& y, int steps, double nothing) const;
  void soften(Vector& x, Vector& y, double softness) const;

  const Matrix& rows_;
  const Vector& stiffness_;
  const Vector& work_;
  double forceScale_;
};

}  // namespace suture
