#pragma once
#include <suture/constraints/ContactLaw.hpp>
#include <suture/contact/RigidContact.hpp>

#include <vector>

namespace suture {

class PairResponse;

/// States of all pairs, by id.
using PairStates = std::vector<ContactState>;

/// Data of a pair that its law and the search need.
struct FrictionSite {
  Point place{0, 0, 0};
  double size = 1.0;        ///< tributary length or area
  double tangential = 0.0;  ///< tangential stiffness of both sides in series [force / length]
  bool slipped = false;     ///< the pair has slid in an earlier load step
};

/// Solution of the linear problem for given states: closed pairs are glued along the normal, sticking ones along the tangents too; slipping
/// ones carry the tangential force of their state.
struct FrictionAnswer {
  Matrix force;           ///< pairs x 3, in the frames of the pairs: force on side B [force]
  Matrix jump;            ///< pairs x 3: penetration, and slip u_A - u_B of the load step [length]
  Vector forceTolerance;  ///< violation of each pair below which it counts as zero [force]
  Vector jumpTolerance;   ///< the same for penetrations [length]
  bool solved = true;     ///< false: the linear solve failed; the reason is reported elsewhere
};

/// The linear problems that FrictionSearch needs. Collective if the implementation is; all ranks get the same numbers.
class FrictionOracle {
 public:
  virtual ~FrictionOracle() = default;
  /// Loosest and tightest available tolerance of forces, relative to the largest; both zero: a direct solver.
  virtual double loosest() const { return 0.0; }
  virtual double tightest() const { return 0.0; }
  /// True if tangential forces of slipping pairs follow the normal forces within a linear problem (Coulomb); false if bounds must be given.
  virtual bool drags() const { return true; }
  /// \param tolerance  between tightest() and loosest()
  virtual FrictionAnswer solve(const PairStates& states, double tolerance) = 0;
  /// False ends the search after the current step.
  virtual bool goesOn() { return true; }
};

/// Finds the states of contact with friction by semismooth Newton on normal and tangential forces together (Alart and Curnier 1991; Hueber,
/// Stadler and Wohlmuth 2008). Its constant along the tangents is a tenth of the local stiffness: with the full stiffness pairs alternate
/// between stick and slip (measured; doc/numerics.md). In 3D the slip direction is updated with the exact tangent.
///
/// All violated pairs change at once. If that does not reduce their number any more, a line search between solutions (whose combinations
/// are in equilibrium with the loads, too) reduces the distance of forces from their projections. After that, only the last violated pair
/// changes (Murty's rule, as in block principal pivoting: Judice and Pires 1994), which terminates if the problem has one solution. If even
/// that takes too long, the search tries: for few pairs, Lemke's pivots on the whole pair problem (PairResponse); a path along which
/// friction decreases; and, for an oracle whose bounds must be given, a fixed point of Tresca problems with bounds from the last normal
/// forces, each convex as long as no pair opens or closes.
///
/// Sets never leave a body unconstrained if pairs can hold it: the body is moved along the loads to the next pairs that it meets, or a pair
/// that held it before keeps holding it. If the force on such a pair exceeds its bound, others hold the body; if no pair can, the body
/// slides away. Limit analysis detects this where it is certain.
class FrictionSearch {
 public:
  struct Result {
    bool converged = false;
    Vector slides;          ///< rigid motion (RigidContact) of the driven bodies if there is no equilibrium; else empty
    double multiple = 0.0;  ///< factor on friction that would hold them (Collapse); 0: unknown
    PairStates states;
    int solves = 0;
    double contraction = -1.0;     ///< contraction factor of the fixed point of Tresca problems, estimated; negative: unknown
    std::vector<int> alternating;  ///< pairs whose states did not settle
  };

  /// All arguments must outlive it. \param most  maximum number of solves
  FrictionSearch(const RigidContact& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites, FrictionOracle& oracle,
                 int most)
      : rigid_(rigid), laws_(laws), sites_(sites), oracle_(oracle), left_(most) {}

  /// \param normal  normal forces of a frictionless solution, for a first Tresca problem; empty: none
  Result run(PairStates start, const Vector& normal = {});

  /// States that the laws give at these forces and jumps.
  PairStates projected(const PairStates& now, const FrictionAnswer& at) const;

 private:
  enum class End { Settled, Slides, Exhausted, Failed };
  enum class Way { Block, Descent, Single };  // pairs that change: all violated ones, those of a line search, a single one

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
  /// False once limit analysis, the number of solves or a stop request ends the search.
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
  int left_, solves_ = 0, answers_ = 0, patience_ = 0;  // solves_: all; answers_: successful ones
  double tolerance_ = 0.0;
  PairStates states_;
  FrictionAnswer answer_;
  std::vector<char> holders_;  // pairs that hold a body against their law
  std::vector<char> spent_;    // pairs that did so without success
  Vector normal_;              // normal forces for the bounds of a Tresca problem; empty: the law's own
  /// Constant along the normal, relative to the pair's stiffness, used where a combination of solutions has both force and jump.
  double normalConstant_ = 0.2;
  double scale_ = 1.0;  // factor on the friction of all laws
  std::vector<int> violated_;
  // Forces and jumps in equilibrium that are closest to the laws so far, and their distance.
  Matrix force_, jump_;
  double nearest_ = 0.0;
  int rises_ = 0;
  std::vector<PairStates> met_;  // states reached while driven bodies were moved
  Vector slides_;                // motion of a body that nothing holds
  Vector outdone_;               // motion along which no pair forces balance the loads; empty: none known
  Vector mechanism_;             // motion found by Collapse, or empty
  double multiple_ = 0.0;        // its factor on friction
  double contraction_ = -1.0;
};

}  // namespace suture
