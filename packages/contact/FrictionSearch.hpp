#pragma once
#include <suture/constraints/ContactLaw.hpp>
#include <suture/contact/RigidContact.hpp>

#include <vector>

namespace suture {

class PairResponse;

/// States of all pairs, by id.
using PairStates = std::vector<ContactState>;

/// Data of a pair that its law and the search ask for.
struct FrictionSite {
  Point place{0, 0, 0};
  double size = 1.0;        ///< tributary length or area
  double tangential = 0.0;  ///< stiffness of both sides in series along the tangents [force / length]
  bool slipped = false;     ///< the pair has slid in an earlier load step
};

/// Solution of the linear problem of given states: closed pairs glued along the normal, sticking ones along the tangents too, slipping
/// ones under the tangential force of their state.
struct FrictionAnswer {
  Matrix force;           ///< pairs x 3, in the frames of the pairs: that side B feels [force]
  Matrix jump;            ///< pairs x 3: penetration, and slip u_A - u_B of the step [length]
  Vector forceTolerance;  ///< violation of each pair below which it is not believed [force]
  Vector jumpTolerance;   ///< the same for penetrations [length]
  bool solved = true;     ///< false: the linear solve failed, and says why elsewhere
};

/// The linear problems that FrictionSearch asks for. Collective where the implementation is; all ranks get the same numbers.
class FrictionOracle {
 public:
  virtual ~FrictionOracle() = default;
  /// Least and most accurate tolerance that it offers, of forces relative to the largest; both zero: a direct solver.
  virtual double loosest() const { return 0.0; }
  virtual double tightest() const { return 0.0; }
  /// True if the linear problems are those of pairs that normal forces drag (Coulomb); false if bounds must be given.
  virtual bool drags() const { return true; }
  /// \param tolerance  between the two
  virtual FrictionAnswer solve(const PairStates& states, double tolerance) = 0;
  /// False ends the search after the step in hand.
  virtual bool goesOn() { return true; }
};

/// Finds the states of contact with friction: semismooth Newton on normal and tangential forces together (Alart and Curnier 1991; Hueber,
/// Stadler and Wohlmuth 2008), with a tenth of the local stiffness as its constant along the tangents: with all of it pairs alternate
/// between stick and slip (measured; doc/numerics.md). In space the direction of a pair that slips turns with it, by the exact tangent.
///
/// All violated pairs change at a time. When that does not lower their number any more, a line search between answers does (they are in
/// balance with the loads, and so are their combinations): it lowers the distance of forces from their projections. Then only the last
/// violated pair changes (Murty's rule, as in block principal pivoting: Judice and Pires 1994), which ends wherever the problem has one
/// solution. If even that takes too long: where pairs are few, Lemke's pivots on their problem as a whole (PairResponse); a path along
/// which friction falls; and, where an oracle knows no drag at once, a fixed point of Tresca problems: bounds by the normal forces of the
/// last one, each convex as long as no pair opens or closes.
///
/// Sets never leave a body loose that pairs can hold: it is dragged along the loads to the pairs that it meets, or one of those that held
/// it goes on to. If that is beyond its bound others hold it; if none do the body slides away. Limit analysis tells where that is certain.
class FrictionSearch {
 public:
  struct Result {
    bool converged = false;
    Vector slides;          ///< motion of bodies (RigidContact) along which they are driven where there is no equilibrium; else empty
    double multiple = 0.0;  ///< factor on friction that would hold them (Collapse); 0: not known
    PairStates states;
    int solves = 0;
    double contraction = -1.0;     ///< contraction of the fixed point of Tresca problems, estimated; negative: not known
    std::vector<int> alternating;  ///< pairs whose states did not settle
  };

  /// All must outlive it. \param most  solves at most
  FrictionSearch(const RigidContact& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites, FrictionOracle& oracle,
                 int most)
      : rigid_(rigid), laws_(laws), sites_(sites), oracle_(oracle), left_(most) {}

  /// \param normal  forces of a solution without friction, by which a first Tresca problem is made; empty: none
  Result run(PairStates start, const Vector& normal = {});

  /// States that laws answer with at given forces and jumps.
  PairStates projected(const PairStates& now, const FrictionAnswer& at) const;

 private:
  enum class End { Settled, Slides, Exhausted, Failed };
  enum class Way { Block, Descent, Single };  // ways of changing states: all violated pairs, by a line search, one pair

  ContactState project(std::size_t pair, const ContactState& now, const FrictionAnswer& at) const;
  ContactState onto(std::size_t pair, const ContactState& now, const ContactTrial& trial) const;
  double violation(const Matrix& force, const Matrix& jump, PairStates* states = nullptr) const;
  bool descend(PairStates& next);
  PairStates guarded(PairStates next, const PairStates& before);
  End settle(double last);
  End fixedPoint(const Vector& start);
  End solveAsTresca(const Vector& normal);
  End limited(int most, double last);
  double mobilisation();
  End tryAgain(End first);
  End lowerFriction();
  bool pivot(const PairResponse& response, double softness, FrictionAnswer& found) const;
  End solveByPivots();
  /// False once limit analysis, the number of solves or a request ends the search.
  bool goesOn() { return outdone_.size() == 0 && left_ > 0 && oracle_.goesOn(); }
  End solveByNewton(const Vector& normal);
  Vector drivenMotion(const PairStates& next, const std::vector<std::size_t>& changed) const;
  bool follow(PairStates& next);
  bool relieve(const PairStates& next);
  bool drag(const Vector& motion, int loose, PairStates& found);
  Vector outdone() const;
  bool collapses();
  double turn(std::size_t pair, const ContactState& next) const;
  Vector normalForces() const;
  bool dependOnNormals();
  void thaw();
  void stick();

  const RigidContact& rigid_;
  const ContactLaws& laws_;
  const std::vector<FrictionSite>& sites_;
  FrictionOracle& oracle_;
  int left_, solves_ = 0, answers_ = 0, patience_ = 0;  // solves; those with an answer
  double tolerance_ = 0.0;
  PairStates states_;
  FrictionAnswer answer_;
  std::vector<char> holders_;  // pairs that hold a body against their law
  std::vector<char> spent_;    // those that did so in vain
  Vector normal_;              // normal forces that bounds of a Tresca problem are made of; empty: the law's own
  /// Constant along the normal, in parts of the pair's stiffness, where force and jump of a combination of answers are both there.
  double normalConstant_ = 0.2;
  double scale_ = 1.0;  // multiple of the friction of all laws
  std::vector<int> violated_;
  // Forces and jumps that are in balance, nearest to the laws so far; their distance.
  Matrix force_, jump_;
  double nearest_ = 0.0;
  int rises_ = 0;
  std::vector<PairStates> met_;  // states that driven bodies have met
  Vector slides_;                // motion of a body that nothing holds
  Vector outdone_;               // motion in which no forces of pairs balance the loads; empty: none is known
  Vector mechanism_;             // motion that Collapse has found, or empty
  double multiple_ = 0.0;        // its multiple of friction
  double contraction_ = -1.0;
};

}  // namespace suture
