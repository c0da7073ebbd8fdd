#pragma once
#include <suture/contact/RigidContact.hpp>

#include <limits>
#include <string>
#include <vector>

namespace suture {

/// State of elastic bodies for a given set of closed pairs, which are glued in the normal direction (equalities); open pairs carry no
/// force.
struct ContactAnswer {
  Vector force;                 ///< forces of closed pairs, > 0 compressive; zero for open ones [force]
  Vector penetration;           ///< penetrations of open pairs, > 0 where they penetrate; zero for closed ones [length]
  Vector forceTolerance;        ///< tensile force of each pair below which it counts as zero [force]
  Vector penetrationTolerance;  ///< the same for penetrations [length]
  double energy = 0.0;          ///< potential energy of the state
  bool solved = true;           ///< false: the linear solve failed; the reason is reported elsewhere
};

/// The linear problems that ContactSearch needs. Collective if the implementation is; all ranks get the same numbers.
class ContactOracle {
 public:
  virtual ~ContactOracle() = default;
  /// Number of accuracy levels: 1 for a direct solver; more if first solves may be inaccurate.
  virtual int levels() const { return 1; }
  /// \param closed  leaves no motion free that pairs can stop
  /// \param level   0 (loose) .. levels() - 1 (final); the same set at the next level continues the last solve
  virtual ContactAnswer solve(const ClosedSet& closed, int level) = 0;
  /// Changes of forces and penetrations.
  struct Change {
    Vector force, penetration;  ///< empty: the solve failed
  };
  /// Change of the state due to given compressive forces on open pairs at unchanged gaps of closed pairs: one linear solve. The returned
  /// forces include the given ones.
  virtual Change redistribute(const ClosedSet& closed, const Vector& given) = 0;
  /// Moves the state of the last solve rigidly: `motion` are amplitudes of RigidContact.
  virtual void move(const Vector& motion) = 0;
  /// Amplitudes of the rigid motions in the last solve; empty: unknown.
  virtual Vector motion() const { return {}; }
  /// A better next set than plain flips, for the current state of the last solve; empty: none.
  virtual ClosedSet proposal() { return {}; }
  /// False ends the search after the current step.
  virtual bool goesOn() { return true; }
};

/// Finds the closed set of frictionless contact: forces l >= 0, penetrations w <= 0, l w = 0. No body is left unconstrained, and the search
/// terminates.
///
/// Each solve has a set of closed pairs. A set that leaves a motion free is extended by stabilising pairs (holders), which must carry no
/// force: no singular matrix is ever factored. The next set is found as follows:
///   1. In the first solves, by the oracle's proposal (semismooth Newton on condensed groups) or by plain flips (primal-dual active set:
///      closed pairs in tension open, penetrating open pairs close). Where a flip would leave a body unconstrained, the equilibrium on the
///      pads from t = c l + w is used instead. If a state is much farther from the contact laws than an earlier one, the next set is that
///      of the best combination of the two (line search without a solve: combinations of equilibrium states are in equilibrium).
///   2. If a set recurs, or after many solves: the learnt model (LearntModel) and plain flips in turn.
///   3. If that fails too: a safe step from the best state with l >= 0, along which the dual energy improves strictly; the first step
///      starts near the equilibrium state closest to the laws. The dual problem has finitely many faces, so the search terminates.
/// Measured (doc/numerics.md): no failure on 402 scenes, 2.1 solves on average.
class ContactSearch {
 public:
  struct Result {
    bool converged = false;
    std::string failure;
    ClosedSet closed;  ///< without holders
    Vector force;      ///< >= 0
    Matrix neutral;    ///< motions (columns) that change no force: positions of bodies are not determined along them
    int solves = 0;
    std::vector<int> alternating;  ///< pairs that changed between the last two sets, if the search did not converge
  };

  /// `rigid` and `oracle` must outlive it. \param most  maximum number of solves
  ContactSearch(const RigidContact& rigid, ContactOracle& oracle, int most);
  /// Switches the learnt model off; used for the small problem of the model itself.
  void withoutModel() { learns_ = false; }
  Result run(ClosedSet start);

 private:
  /// A state with l >= 0.
  struct State {
    Vector force, penetration, penetrationTolerance;
    ClosedSet closed;  // pairs with l > 0
    double energy = 0.0;
  };

  void remember(const Vector& force, const Vector& penetration);
  static ClosedSet joined(ClosedSet a, const ClosedSet& b);
  bool solve(const ClosedSet& closed);
  ClosedSet flipped() const;
  bool pulls() const;
  bool penetrates(const Vector& penetration, const Vector& tolerance, const ClosedSet& closed) const;
  bool done();
  void dropIdle();
  bool proposed(const ClosedSet& set) const;
  bool propose(ClosedSet& next);
  Vector padPenetration(const Vector& force, const Vector& penetration) const;
  ClosedSet guarded(ClosedSet set) const;
  ClosedSet guarded(ClosedSet set, const Vector& force, const Vector& penetration) const;
  double distance(const Vector& force, const Vector& penetration) const;
  bool searchLine(ClosedSet& next);
  bool nearestStart();
  bool staticStart();
  bool safeStep(ClosedSet& next);
  bool takeBest(ClosedSet& next);
  bool descend(const State& from, bool pushFirst, State& to);
  void moveLeast(const ClosedSet& carrying);
  Result finish(bool converged, std::string failure);

  const RigidContact& rigid_;
  ContactOracle& oracle_;
  int left_, solves_ = 0, plain_ = 0, level_ = 0;  // plain_: solves since the accuracy was raised
  bool failed_ = false, stopped_ = false;
  bool driven_ = false;      // the loads pull a body away from a holder: no equilibrium
  ClosedSet set_, holding_;  // set of the last solve without holders, and its holders
  ContactAnswer answer_;
  std::vector<ClosedSet> seen_;
  std::vector<std::pair<Vector, Vector>> history_;  // forces and penetrations of final solves, for the learnt model
  State best_;
  bool haveBest_ = false, loosened_ = false;
  int sinceBest_ = 0;
  bool learns_ = true;
  /// Forces and penetrations in equilibrium.
  struct Balance {
    Vector force, penetration;
    double distance = std::numeric_limits<double>::infinity();
  };
  Balance nearest_, nearestAnswer_;  // closest to the laws: among all, combinations included; among accurate solutions
};

}  // namespace suture
