#pragma once
#include <suture/contact/FrictionCone.hpp>
#include <suture/contact/RigidContact.hpp>

#include <vector>

namespace suture {

/// A scene's bodies as rigid ones on elastic pads with friction, one pad for each contact pair: the cheap model of all contact searches. It
/// gives a first guess of the states, states that hold a body where others would leave it loose, and the proof that nothing holds one.
///
/// Rigid motions have amplitudes a (lengths); G are their effect on penetration and slip of the pairs. With pads of compliance c and
/// penetrations and slips t at a = 0,
///     min over a of  sum phi_i(t_i + G_i a) - e.a,      phi_i' = P_i(. / c_i),  P_i the projection on the pair's friction cone:
/// convex. Newton's method with an exact line search; at most 12 entries a row of G, a sparse factor of G^T D G. Where plain steps do not
/// settle (long ways between walls), pads are softened until all touch and then stiffened again.
/// Local; the same arguments give the same answer on all ranks. Measured: cost grows like bodies^1.0 to 1.3 (doc/numerics.md).
class PadModel {
 public:
  /// \param data   rows, tangents, loads; must outlive the model. Pairs that cannot change carry no force.
  /// \param cones  one per pair
  PadModel(const RigidContact::Pairs& data, std::vector<FrictionCone> cones);

  struct Equilibrium {
    Matrix force;   ///< pairs x 3 [force]
    Matrix trial;   ///< pairs x 3: forces whose projections they are [force]
    Vector motion;  ///< a [length]
    bool found = true;
  };
  /// Equilibrium of the convex problem. \param t  pairs x 3: penetration and slip [length];  \param compliance  one per pair
  Equilibrium associated(const Matrix& t, const Vector& compliance) const;
  /// The same by Coulomb's law, whose slip does not open a pair: fixed point of convex problems with penetrations t_n - friction |slip|
  /// (Acary et al. 2011). `trial` belongs to Coulomb's law. \param slip  |slip| of each pair to begin with, or empty
  Equilibrium coulomb(const Matrix& t, const Vector& compliance, const Vector& slip = {}) const;

  /// Limit analysis (static theorem): a unit motion in which the loads do more work than all forces in the cones can resist; empty if the
  /// cones can balance the loads. No equilibrium exists along such a motion, wherever the bodies come to rest on these pairs.
  Vector unbalanced() const;
  /// True if forces on given rays and planes balance the loads. \param active  pairs x 3, column blocks: directions in which each pair can
  /// have a force, orthonormal or zero
  bool balances(const std::vector<Eigen::Matrix3d>& active) const;

 private:
  struct Row {
    std::vector<int> motions;
    std::vector<Eigen::Vector3d> effects;  // on penetration and slips, by motion
  };
  struct Point {
    Vector motion;
    Matrix y;  // t + G a: moved with a, never computed from it, so that forces keep their digits on long ways
  };

  Matrix effect(const Vector& motion) const;
  Vector work(const Matrix& force) const;
  Vector reference(const Vector& stiffness) const;
  Matrix forces(const Matrix& y, const Vector& stiffness, std::vector<Eigen::Matrix3d>* derivatives) const;
  Vector solve(const std::vector<Eigen::Matrix3d>& blocks, const Vector& stiffness, const Vector& diagonal, const Vector& scale,
               const Vector& right) const;
  bool newton(Point& at, const Vector& stiffness, const Vector& spring, int steps, double tolerance) const;

  const RigidContact::Pairs& data_;
  std::vector<FrictionCone> cones_;
  std::vector<Row> rows_;
  int motions_;
};

}  // namespace suture
