#pragma once
#include <suture/search/FrictionCone.hpp>
#include <suture/search/RigidBodyModel.hpp>

#include <vector>

namespace suture {

/// Rigid bodies on elastic pads with friction, one pad per contact pair: the cheap model of all contact searches. It gives an initial guess
/// of the states, states that hold a body where others would leave it unconstrained, and the proof that no equilibrium exists.
///
/// Rigid motions have amplitudes a (lengths); G is their effect on penetration and slip of the pairs. With pads of compliance c and
/// penetrations and slips t at a = 0, the problem is convex:
///     min over a of  sum phi_i(t_i + G_i a) - e.a,      phi_i' = P_i(. / c_i),  P_i the projection on the pair's friction cone.
/// Solved by Newton's method with an exact line search; G has at most 12 entries per row, and G^T D G has a sparse factor. If plain steps
/// do not converge (large motions between walls), the pads are softened until all touch and then stiffened again.
/// Local; the same arguments give the same result on all ranks. Measured: cost grows like bodies^1.0 to 1.3 (doc/numerics.md).
class PadModel {
 public:
  /// Least fraction of the loads left to the springs by the cones if there is no equilibrium. Measured: at most 3e-6 with an equilibrium,
  /// at least 3e-3 without.
  static constexpr double kUnbalanced = 1e-4;

  /// \param data   rows, tangents, loads; must outlive the model. Pairs that cannot change carry no force.
  /// \param cones  one per pair
  PadModel(const RigidBodyModel::Pairs& data, std::vector<FrictionCone> cones);

  struct Equilibrium {
    Matrix force;   ///< pairs x 3 [force]
    Matrix trial;   ///< pairs x 3: forces before projection [force]
    Vector motion;  ///< a [length]
    bool found = true;
  };
  /// Equilibrium of the convex problem. \param t  pairs x 3: penetration and slip [length];  \param compliance  one per pair
  Equilibrium associated(const Matrix& t, const Vector& compliance) const;
  /// The same with Coulomb's law, whose slip does not open a pair: fixed point of convex problems with penetrations t_n - friction |slip|
  /// (Acary et al. 2011). Pads without normal force hold nothing: a bound is lost where a pair opens. `trial` belongs to Coulomb's law.
  /// \param slip  initial guess of |slip| per pair, or empty
  Equilibrium coulomb(const Matrix& t, const Vector& compliance, const Vector& slip = {}) const;
  /// Equilibrium of rigid bodies on unilateral pads without friction. \param rows  pairs x motions;  \param t  penetrations [length]
  static Equilibrium unilateral(const SparseRows& rows, const Vector& work, const Vector& t, const Vector& compliance);
  /// Forces p >= 0 with the least remainder |work - rows^T p|, to about five digits. Rigid pads and soft springs on the motions: the
  /// springs take the remainder. \param rows  pairs x motions.  Empty: Newton's method did not converge
  static Vector leastRemainder(const SparseRows& rows, const Vector& work);

  /// Limit analysis (static theorem): a unit motion in which the loads do more work than all forces in the cones can resist; empty if
  /// forces in the cones can balance the loads. No equilibrium exists along such a motion, at any position of the bodies with these pairs.
  Vector unbalanced() const;
  /// True if forces on given rays and planes balance the loads. \param active  for each pair, the directions of its possible forces as
  /// columns, orthonormal or zero
  bool balances(const std::vector<Eigen::Matrix3d>& active) const;

 private:
  struct Row {
    std::vector<int> motions;
    std::vector<Eigen::Vector3d> effects;  // on penetration and slips, by motion
  };
  struct Point {
    Vector motion;
    Matrix y;  // t + G a, updated by increments and never recomputed from a: forces keep their accuracy after large motions
  };

  Matrix effect(const Vector& motion) const;
  Vector work(const Matrix& force) const;
  Vector reference(const Vector& stiffness) const;
  Matrix forces(const Matrix& y, const Vector& stiffness, std::vector<Eigen::Matrix3d>* derivatives) const;
  Vector solve(const std::vector<Eigen::Matrix3d>& blocks, const Vector& stiffness, const Vector& diagonal, const Vector& scale,
               const Vector& right) const;
  bool newton(Point& at, const Vector& stiffness, const Vector& spring, int steps, double tolerance) const;
  static RigidBodyModel::Pairs frictionless(const SparseRows& rows, const Vector& work);
  Vector rigidPads(const Vector& springs) const;
  bool onSprings(Point& at, const Vector& stiffness, const Vector& springs) const;

  const RigidBodyModel::Pairs& data_;
  std::vector<FrictionCone> cones_;
  std::vector<Row> rows_;
  int motions_;
};

}  // namespace suture
