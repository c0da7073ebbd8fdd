#pragma once
#include <suture/search/DrivenBodies.hpp>
#include <suture/search/PadStates.hpp>

#include <limits>
#include <vector>

namespace suture {

/// Finds the states (open, slip, stick) of contact pairs, for all laws, in 2D and 3D: forces l and jumps w with l = P(l + R w).
///
/// It uses linear problems of given states (LinearContactSolver), the laws (LawProjection) and rigid bodies on pads (PadModel):
///   1. Limit analysis first: loads that forces within the cones cannot balance have no equilibrium.
///   2. The initial states are those of the pads, without a solve.
///   3. Semismooth Newton: the states of P(l + R w) at the current solution define the next linear problem. Combinations of solutions are
///      in equilibrium, so a line search on the distance from the laws costs no solve; if no step reduces it, a full step is taken (with
///      friction). If states cannot balance the loads, bodies are moved along the loads to states that hold them, or the states of the pads
///      at t = c l + w are used.
///   4. If the closed pairs leave a motion in which no force does work (a ball between two plates turns about the line through its poles),
///   a
///      spring along a tangent of an open pair holds it, without force, at the current position. Without friction an open pair is closed,
///      without force, and the body is then moved to where open pairs penetrate least. States that leave a body to soft supports alone
///      (SoftBodies), or that tie it to another body by pairs in tension, are replaced by those of the pads.
///   5. If the distance has not decreased for some steps, or without friction if states recur: a convex problem (all pairs frictionless) is
///      solved by DualAscent, which is proven to converge. With friction, Collapse first looks for bodies that slide as a whole in spite of
///      elastic pressure; then Newton restarts with all pairs sticking, and from the states of the pads at earlier solutions, with
///      different constants.
/// The accuracy of the solves is tied to the distance from the laws.
class StateSearch {
 public:
  struct Result {
    bool converged = false;
    Vector slides;          ///< rigid motion (RigidBodyModel) of the driven bodies if there is no equilibrium; else empty
    double multiple = 0.0;  ///< factor on friction that would hold them (Collapse); 0: unknown
    PairStates states;
    Vector normal;  ///< normal forces of the last solution [force]
    int solves = 0;
    double contraction = -1.0;     ///< estimated contraction of the fixed point of Tresca problems; negative: unknown
    std::vector<int> alternating;  ///< pairs whose states did not settle
  };

  /// All arguments but the last must outlive it. \param most  maximum number of solves
  /// \param normal  normal forces for the bounds of a Tresca problem [force]; empty: bounds follow the current normal forces
  StateSearch(const RigidBodyModel& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites, LinearContactSolver& solver,
              int most, const Vector& normal = {});
  /// Frictionless contact: all pairs have Signorini's law.
  StateSearch(const RigidBodyModel& rigid, LinearContactSolver& solver, int most);
  /// Switches the half-plane model off; used for the small problems of that model.
  void withoutPrediction() { predicts_ = false; }

  /// States of the pads, as initial guess.
  PairStates start();
  /// Normal forces of the pads, after start(). [force]
  const Vector& guess() const { return guess_; }
  /// Distance of the start from the solution, which determines the accuracy of the first solve.
  enum class Start {
    Guess,    ///< as inaccurate as the solver allows
    Near,     ///< the solution of the last load step or of a coarser mesh: changes are small compared with the solution
    Solution  ///< the solution of nearly the same problem: accurate from the first solve
  };
  /// Searches from given states. Collective if the solver is.
  Result run(PairStates start, Start nearness = Start::Guess);
  /// Rigid motion in which the loads overcome the resistance of all pairs, by limit analysis; empty: none. \param states  whose closed
  /// pairs the motion keeps closed, if it can
  Vector unbalanced(const PairStates& states) const;

 private:
  enum class End { Settled, Stalled, Exhausted, Failed };

  ContactAnswer solveHeld();
  void moveLeast();
  PairStates predicted(PairStates next) const;
  End ascend();
  void solveByGuess();
  PairStates sticking() const;
  bool collapses(Result& result);
  End restart(End end);
  Vector normalForces() const;
  double contraction() const;
  End newton(int most, int patience);
  bool solve(PairStates& next, double& turns);
  double between() const;
  void sharpen(double distance, double turns);
  bool step(PairStates& next);
  bool differs(const PairStates& next) const;
  bool arePulled(const PairStates& next);
  PairStates held(PairStates next);
  PairStates stabilised(PairStates next) const;
  double largest() const;
  bool isFrictionless() const { return projection_.isFrictionless(); }
  bool goesOn() const { return left_ > 0 && solver_.goesOn(); }

  const RigidBodyModel& rigid_;
  const ContactLaws none_;  // laws and sites of the frictionless constructor
  const std::vector<FrictionSite> bare_;
  const ContactLaws& laws_;
  const std::vector<FrictionSite>& sites_;
  LinearContactSolver& solver_;
  LawProjection projection_;
  PadStates pads_;
  StabilisingPairs stabilising_;
  DrivenBodies driven_;
  bool predicts_ = true;
  int left_, solves_ = 0;
  double tolerance_ = 0.0;
  double disproved_ = std::numeric_limits<double>::infinity();  // no solve is less accurate: an accurate one has disproved its states
  PairStates states_;
  ContactAnswer answer_;
  std::vector<int> violated_;
  ContactBalance at_, best_, first_;  // current, closest to the laws, and first one of a try
  bool werePulled_ = false;           // see arePulled()
  bool isNew_ = true;                 // the next solution starts a new line: earlier ones are not comparable
  Vector guess_, tresca_;             // normal forces of the pads, and of the Tresca problem with bounds from them
};

}  // namespace suture
