#pragma once
#include <suture/contact/RigidContact.hpp>

#include <limits>
#include <string>
#include <vector>

namespace suture {

/// State of elastic bodies with a given set of closed pairs, glued in the normal direction (equalities), the others without force.
struct ContactAnswer {
  Vector force;                 ///< forces of closed pairs, > 0 compressive; zero for open ones [force]
  Vector penetration;           ///< penetrations of open pairs, > 0 where they penetrate; zero for closed ones [length]
  Vector forceTolerance;        ///< pull of each pair below which it is not believed [force]
  Vector penetrationTolerance;  ///< the same for penetrations [length]
  double energy = 0.0;          ///< potential energy of the state
  bool solved = true;           ///< false: the linear solve failed, and says why elsewhere
};

/// The linear problems that ContactSearch asks for. Collective where the implementation is; all ranks get the same numbers.
class ContactOracle {
 public:
  virtual ~ContactOracle() = default;
  /// Number of accuracies that it offers: 1 for a direct solver; more if a solve may be done loosely at first.
  virtual int levels() const { return 1; }
  /// \param closed  leaves no motion loose that pairs can stop
  /// \param level   0 (loose) .. levels() - 1 (final); the same set at the next level continues the last solve
  virtual ContactAnswer solve(const ClosedSet& closed, int level) = 0;
  /// Changes of forces and penetrations.
  struct Change {
    Vector force, penetration;  ///< empty: the solve failed
  };
  /// Change of the state when open pairs push with given forces and the gaps of closed ones stay: one linear solve. Its forces contain the
  /// given ones.
  virtual Change redistribute(const ClosedSet& closed, const Vector& given) = 0;
  /// The state of the last solve moves rigidly: `motion` are amplitudes of RigidContact.
  virtual void move(const Vector& motion) = 0;
  /// Amplitudes of the last solve's rigid motions; empty: not known.
  virtual Vector motion() const { return {}; }
  /// A next set better than plain flips, at the state of the last solve as it stands now; empty: none.
  virtual ClosedSet proposal() { return {}; }
  /// False ends the search after the step in hand.
  virtual bool goesOn() { return true; }
};

/// Finds the closed set of frictionless contact: forces l >= 0, penetrations w <= 0, l w = 0. Loses no body and ends.
///
/// A solve has a set of closed pairs; sets that leave a motion loose get holders beside them, which carry no force: no singular matrix is
/// ever factored. The next set is found by
///   1. in the first solves the oracle's proposal (semismooth Newton on condensed groups), or plain flips (closed pairs that pull open,
///      open ones that penetrate close: primal-dual active set); where a flip would make a body loose, by the equilibrium on the pads from
///      t = c l + w. An answer that is much farther from the laws than an earlier one is not followed: combinations of balances are in
///      balance, and the set of the best one between the two is next (line search, without a solve);
///   2. when a set returns, or after many solves: the learnt model (LearntModel) and plain flips in turn;
///   3. when that does not help either: a safe step from the best state with l >= 0, along which the dual energy improves strictly; the
///      first one begins beside the nearest balance. Faces of the dual problem are finite: the search ends.
/// Measured (doc/numerics.md): no failure on 402 scenes, 2.1 solves in the mean.
class ContactSearch {
 public:
  struct Result {
    bool converged = false;
    std::string failure;
    ClosedSet closed;  ///< holders left out
    Vector force;      ///< >= 0
    Matrix neutral;    ///< motions (columns) that change no force: the bodies' places are not determined along them
    int solves = 0;
    std::vector<int> alternating;  ///< pairs that changed between the last two sets, where it did not converge
  };

  /// `rigid` and `oracle` must outlive it. \param most  solves at most
  ContactSearch(const RigidContact& rigid, ContactOracle& oracle, int most);
  /// Without the learnt model, as the model's own small problem is solved.
  void withoutModel() { learns_ = false; }
  Result run(ClosedSet start);

 private:
  /// A state with l >= 0.
  struct State {
    Vector force, penetration, penetrationTolerance;
    ClosedSet closed;  // its support
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
  bool driven_ = false;      // loads pull a body away from a holder: no equilibrium
  ClosedSet set_, holding_;  // set of the last solve: without holders, holders alone
  ContactAnswer answer_;
  std::vector<ClosedSet> seen_;
  std::vector<std::pair<Vector, Vector>> history_;  // forces and penetrations of final solves, for the model
  State best_;
  bool haveBest_ = false, loosened_ = false;
  int sinceBest_ = 0;
  bool learns_ = true;
  /// Forces and penetrations in balance.
  struct Balance {
    Vector force, penetration;
    double distance = std::numeric_limits<double>::infinity();
  };
  Balance nearest_, nearestAnswer_;  // nearest to the laws: on lines between answers, too; among accurate answers
};

}  // namespace suture
