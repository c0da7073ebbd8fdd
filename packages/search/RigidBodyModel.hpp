#pragma once
#include <suture/algebra/SparseMatrix.hpp>
#include <suture/base/Types.hpp>
#include <suture/search/PairStates.hpp>

#include <memory>
#include <vector>

namespace suture {

class DisjointSets;
class SoftBodies;

constexpr double kDependentRows = 1e-9;  ///< singular value of rows (of order one) below which they leave a motion free

/// Rigid bodies in contact through unilateral elastic pads, one per contact pair: the cheap model that gives contact solvers their first
/// set of closed pairs and detects sets that leave a body unconstrained.
///
/// Rigid motions have amplitudes a (lengths); the columns of `rows` are their effect on the pairs: penetration grows by rows a. With pads
/// of compliance c and penetrations t at a = 0, the equilibrium under loads that do the work e in each motion is
///     min over a of  sum (t + rows a)_+^2 / 2 c - e.a,       pad forces (t + rows a)_+ / c >= 0,  rows^T force = e.
/// Convex and piecewise quadratic in few unknowns: Newton with an exact line search. Local; the same arguments give the same result on all
/// ranks.
class RigidBodyModel {
 public:
  struct Pairs {
    SparseRows rows;        ///< pairs x motions, of order one: motions are scaled by their largest displacement
    Vector work;            ///< e: work of the loads in each motion [force]
    Vector penetration;     ///< t at zero motions: minus the initial gap, plus the part closed by prescribed displacements [length]
    Vector stiffness;       ///< stiffness of both sides in series at each pair, along its normal: 1 / k = sum n^2 / K_nn [force / length]
    std::vector<int> line;  ///< contact line of each pair; consecutive pairs of one line are neighbours
    std::vector<std::vector<int>> bodies;   ///< bodies of each pair; empty: all pairs belong together
    std::vector<char> canChange;            ///< pairs that can change; the others have no free unknowns and zero rows
    bool surfaces = false;                  ///< pairs of one line lie on a surface and are not ordered
    std::vector<SparseRows> tangents = {};  ///< as `rows`, along each tangent; empty without friction
    std::vector<char> bound = {};           ///< pairs that never open (ContactLaw::separates): motions keep them closed. Empty: none
  };

  explicit RigidBodyModel(Pairs pairs);

  int pairs() const { return static_cast<int>(pairs_.line.size()); }
  int motions() const { return static_cast<int>(pairs_.work.size()); }
  const Pairs& data() const { return pairs_; }
  /// Compliance of each pad as set by start(), that of a contact patch: max(2, n) / k for n adjacent closed pairs on a line, max(2, 0.9
  /// sqrt(n)) / k on a surface. [length / force]
  const Vector& compliance() const { return compliance_; }

  /// Round-off of each pair's force on the path of load steps so far: smaller forces count as zero. Zero unless set. [force]
  const Vector& rounding() const { return rounding_; }
  void setRounding(Vector ofPairs) { rounding_ = std::move(ofPairs); }

  /// The model that includes motions held by soft supports only; null: there are none.
  const SoftBodies* soft() const { return soft_.get(); }
  void setSoft(std::shared_ptr<const SoftBodies> soft) { soft_ = std::move(soft); }

  struct Equilibrium {
    Vector force, motion;
    bool found = true;  ///< false: the loads drive a motion that no pad stops
  };
  /// Equilibrium on the pads, starting from penetrations t.
  Equilibrium project(const Vector& t) const;

  /// The least motion that pairs with the given forces and penetrations allow, if they leave one free. \param motion  motion at the given
  /// penetrations
  Vector leastMotion(const ClosedSet& carrying, const Vector& motion, const Vector& penetration) const;

  /// The closed set at equilibrium from `penetration`, with soft supports if there are any; sets compliance(). Pairs between parts that
  /// cannot move rigidly have no pad force: they are closed if they penetrate or touch.
  ClosedSet start();

  /// Orthonormal combinations of motions that leave all pairs of a set unchanged: motions x k.
  Matrix loose(const ClosedSet& closed) const;
  /// True if a pair never opens.
  bool isBound(std::size_t pair) const { return !pairs_.bound.empty() && pairs_.bound[pair] != 0; }
  /// The same for pairs with friction: closed pairs hold along the normal, sticking ones along the tangents, and springs
  /// (ContactState::transverseStiffness) along their direction.
  Matrix loose(const PairStates& states) const;
  /// True if a set leaves a motion free that all pairs together would stop.
  bool loosens(const ClosedSet& closed) const;
  bool loosens(const PairStates& states) const;
  /// Stabilising pairs: open pairs that, closed in addition to a set with the free motions `loose`, stop all motions
  /// that pairs can stop: one per motion, chosen for the best conditioning.
  std::vector<int> stabilisingPairs(const ClosedSet& closed, const Matrix& loose) const;
  /// Forces of stabilising pairs from statics alone, if loads do work in free motions: > 0 compressive. Zero if the work is round-off.
  Vector stabilisingForces(const std::vector<int>& stabilisingPairs, const Matrix& loose) const;
  /// The combination z of free motions Z that minimises penetration of open pairs: argmin sum (w + rows Z z)_+^2 / c. Zero if none
  /// penetrates.
  Vector settle(const ClosedSet& closed, const Vector& penetration, const Matrix& loose) const;
  /// Motions that change no pair with force and make no touching pair penetrate, orthonormal; a motion that is free in one direction only
  /// counts, too. motions x k.
  Matrix neutral(const ClosedSet& carrying, const ClosedSet& touching) const;
  /// Scale of values at each pair: the largest magnitude in its cluster, i.e. among pairs of the bodies that closed pairs connect to its
  /// own bodies. A lightly loaded cluster thus has its own scale.
  Vector clusterScale(const ClosedSet& closed, const Vector& values) const;
  /// The same for the less loaded of a pair's two bodies: a light body is not measured by its support.
  Vector bodyScale(const ClosedSet& closed, const Vector& values) const;

 private:
  void findComponents();
  /// A row of the model: component of the pair's frame, and pair.
  struct Row {
    std::size_t component;
    int pair;
  };
  const SparseRows& rowsOf(std::size_t component) const { return component == 0 ? pairs_.rows : pairs_.tangents[component - 1]; }
  Matrix nullSpaceOf(const std::vector<Row>& rows) const;
  Vector patchLengths(const ClosedSet& set) const;
  int bodies() const;
  Vector scaleOf(DisjointSets sets, const ClosedSet& closed, const Vector& values, bool least) const;

  Pairs pairs_;
  Vector compliance_, rounding_;
  std::shared_ptr<const SoftBodies> soft_;
  struct Component {
    std::vector<int> motions, pairs;
  };
  std::vector<Component> components_;  // motions coupled by pads
  int rank_ = 0;                       // number of motions that pairs can stop
};

}  // namespace suture
