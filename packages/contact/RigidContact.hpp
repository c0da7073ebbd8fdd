#pragma once
#include <suture/base/Types.hpp>
#include <suture/constraints/ContactState.hpp>

#include <vector>

namespace suture {

class DisjointSets;

/// Closed contact pairs: one entry a pair, not zero where it is closed.
using ClosedSet = std::vector<char>;

/// A scene's bodies as rigid ones that touch through unilateral elastic pads, one a contact pair: the cheap model from which contact
/// solvers take their first set of closed pairs, and with which they keep sets from leaving a body loose.
///
/// A rigid motion has amplitudes a (lengths), the columns of `rows` are their effect on the pairs: penetration grows by rows a. With
/// pads of compliance c and penetrations t at a = 0 the equilibrium under loads that do the work e in each motion is
///     min over a of  sum (t + rows a)_+^2 / 2 c - e.a,       pad forces (t + rows a)_+ / c >= 0,  rows^T force = e.
/// Convex and piecewise quadratic in few unknowns: Newton with an exact line search. Local; the same arguments give the same answer on all
/// ranks.
class RigidContact {
 public:
  struct Pairs {
    Matrix rows;            ///< pairs x motions, of the order of one: motions are measured by the largest displacement they cause
    Vector work;            ///< e, of the loads in each motion [force]
    Vector penetration;     ///< t where all motions are zero: minus the initial gap, plus the part closed by prescribed motions [length]
    Vector stiffness;       ///< both sides in series at each pair, along its normal: 1 / k = sum n^2 / K_nn [force / length]
    std::vector<int> line;  ///< contact line of each pair; successive pairs of one line are neighbours
    std::vector<std::vector<int>> bodies;  ///< bodies that each pair touches. Empty: all pairs belong together
    std::vector<char> able;                ///< pairs that can change; others have no free unknowns, and rows of zeros
    bool surfaces = false;                 ///< pairs of one line lie on a surface, in no order
    std::vector<Matrix> tangents = {};     ///< as `rows`, along each tangent; none without friction
    std::vector<char> bound = {};          ///< pairs that never open (ContactLaw::separates), not able; motions keep them. Empty: none
  };

  explicit RigidContact(Pairs pairs);

  int pairs() const { return static_cast<int>(pairs_.line.size()); }
  int motions() const { return static_cast<int>(pairs_.work.size()); }
  const Pairs& data() const { return pairs_; }
  /// Compliance of each pad, as start() left it: that of a patch of contact: max(2, n) / k, n closed pairs in a row, or on a surface
  /// max(2, 0.9 sqrt(n)) / k. [length / force]
  const Vector& compliance() const { return compliance_; }

  /// Force of each pair below which it is rounding of forces on the path of load steps so far; zero unless set. [force]
  const Vector& rounding() const { return rounding_; }
  void setRounding(Vector ofPairs) { rounding_ = std::move(ofPairs); }

  struct Equilibrium {
    Vector force, motion;
    bool found = true;  ///< false: the loads drive a motion that no pad stops
  };
  /// Equilibrium on the pads from penetrations t.
  Equilibrium project(const Vector& t) const;

  /// The least motion that pairs with force and penetrations allow, where they leave one free. \param motion  that of the given
  /// penetrations
  Vector leastMotion(const ClosedSet& carrying, const Vector& motion, const Vector& penetration) const;

  /// The closed set of the equilibrium from `penetration`; sets compliance(). Pairs between parts that cannot move rigidly carry no pad
  /// force: they are closed where they penetrate or touch.
  ClosedSet start();

  /// Orthonormal combinations of motions that leave all pairs of a set as they are: motions x k.
  Matrix loose(const ClosedSet& closed) const;
  /// True if a pair never opens.
  bool isBound(std::size_t pair) const { return !pairs_.bound.empty() && pairs_.bound[pair] != 0; }
  /// The same of states of pairs with friction: they hold along the normals where they are closed, along the tangents where they stick, and
  /// along the springs that they have (ContactState::across).
  Matrix loose(const std::vector<ContactState>& states) const;
  /// True if a set leaves a motion free that all pairs together would stop.
  bool loosens(const ClosedSet& closed) const;
  /// Open pairs that, closed beside a set with the loose motions Z, stop all that pairs can stop: one for each, the best determined.
  std::vector<int> holders(const ClosedSet& closed, const Matrix& loose) const;
  /// Forces on holders that statics alone ask for, where loads do work in loose motions: > 0 where they press on it. Zero where the work is
  /// rounding.
  Vector holderForces(const std::vector<int>& holders, const Matrix& loose) const;
  /// The combination z of loose motions after which open pairs penetrate least: argmin sum (w + rows Z z)_+^2 / c. Zero where none does.
  Vector settle(const ClosedSet& closed, const Vector& penetration, const Matrix& loose) const;
  /// Motions that change no pair with force and make none of the touching ones penetrate, orthonormal; a motion counts if it is free in
  /// one sense. motions x k.
  Matrix neutral(const ClosedSet& carrying, const ClosedSet& touching) const;
  /// Scale of values at each pair: the largest magnitude among pairs of its cluster, that is of the bodies which closed pairs connect with
  /// its own. A weak cluster is not measured by a strong one beside it.
  Vector clusterScale(const ClosedSet& closed, const Vector& values) const;
  /// The same of the less loaded one of a pair's bodies: a light body is not measured by what it lies on.
  Vector bodyScale(const ClosedSet& closed, const Vector& values) const;
  /// Forces p >= 0 on as few pairs as possible (linearly independent rows) with rows^T p = e; empty: there are none.
  Vector staticForces() const;

 private:
  void findComponents();
  Vector patchLengths(const ClosedSet& set) const;
  int bodies() const;
  Vector scaleOf(DisjointSets sets, const ClosedSet& closed, const Vector& values, bool least) const;

  Pairs pairs_;
  Vector compliance_, rounding_;
  struct Component {
    std::vector<int> motions, pairs;
  };
  std::vector<Component> components_;  // motions that pads couple
  double norm_ = 0.0;                  // norm of the work
  int rank_ = 0;                       // motions that pairs can stop
};

}  // namespace suture
