#pragma once
#include <suture/base/Types.hpp>

namespace suture {

/// Equilibrium of rigid bodies on unilateral pads:  min over x of  sum k (t + rows x)_+^2 / 2 - e.x.  Convex and piecewise quadratic in few
/// unknowns: Newton's method with an exact line search. Holds references: its arguments must outlive it. Local.
class UnilateralFoundation {
 public:
  /// \param rows        pads x motions, of order one
  /// \param stiffness   k >= 0 of the pads [force / length]
  /// \param work        e: work of the loads in each motion [force]
  /// \param forceScale  reference for an imbalance, together with the pad forces [force]
  UnilateralFoundation(const Matrix& rows, const Vector& stiffness, const Vector& work, double forceScale)
      : rows_(rows), stiffness_(stiffness), work_(work), forceScale_(forceScale) {}

  /// Moves from x to the equilibrium. If plain steps do not converge, the steps start with pads that press before they are touched, which
  /// are then stiffened.
  /// \param x  motions
  /// \param y  penetrations t + rows x, updated with x and never recomputed from it: the round-off of large motions then changes gaps
  /// equally little, and forces keep their accuracy
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
