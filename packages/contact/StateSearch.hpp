#pragma once
#include <suture/contact/LawProjection.hpp>
#include <suture/contact/PadModel.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Finds the states (open, slip, stick) of contact pairs, for all laws, in 2D and 3D: forces l and jumps w with l = P(l + R w).
///
/// It uses linear problems of given states (FrictionOracle), the laws (LawProjection) and rigid bodies on pads (PadModel):
///   1. Limit analysis first: loads that forces within the cones cannot balance have no equilibrium.
///   2. The initial states are those of the pads, without a solve.
///   3. Semismooth Newton: the states of P(l + R w) at the current solution define the next linear problem. Combinations of solutions are
///      in equilibrium, so a line search on the distance from the laws costs no solve; if no step reduces it, a full step is taken. If
///      states cannot balance the loads, bodies are moved along the loads to states that hold them, or the states of the pads at t = c l +
///      w are used.
///   4. If the closed pairs leave bodies a motion in which no force does work (a ball between two plates turns about the line through its
///      poles), a spring along a tangent of an open pair holds it, without force, at the current position.
///   5. If the distance has not decreased for some steps: the states of the pads at the current solution, and Newton from there with other
///      constants.
/// The accuracy of the solves is tied to the distance from the laws.
class StateSearch {
 public:
  struct Result {
    bool converged = false;
    Vector slides;  ///< rigid motion (RigidContact) of the driven bodies if there is no equilibrium; else empty
    PairStates states;
    int solves = 0;
    double contraction = -1.0;     ///< estimated contraction of the fixed point of Tresca problems; negative: unknown
    std::vector<int> alternating;  ///< pairs whose states did not settle
  };

  /// All arguments must outlive it. \param most  maximum number of solves
  StateSearch(const RigidContact& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites, FrictionOracle& oracle, int most);

  /// States of the pads, as initial guess.
  PairStates start();
  Result run(PairStates start);

 private:
  enum class End { Settled, Stalled, Exhausted, Failed };
  /// Forces and jumps in equilibrium with the loads, and their distance from the laws.
  struct Balance {
    Matrix force, jump;
    double distance = 0.0;
  };

  Vector unbalanced() const;
  void solveByGuess();
  Vector normalForces() const;
  double contraction() const;
  End newton(int most, int patience);
  bool solve(PairStates& next, double& turns);
  void sharpen(double distance, double turns);
  bool step(PairStates& next);
  bool drag(const PairStates& next, PairStates& found);
  bool isNeutral(const PairStates& next, const Matrix& free) const;
  void holdBySprings(PairStates& next, Matrix free) const;
  bool differs(const PairStates& next) const;
  PairStates held(PairStates next);
  PairStates padStates(const PadModel::Equilibrium& pads) const;
  bool fromPads(const Balance& at, double softness, PairStates& found) const;
  PairStates withHolders(PairStates next) const;
  bool goesOn() const { return left_ > 0 && oracle_.goesOn(); }

  const RigidContact& rigid_;
  const ContactLaws& laws_;
  FrictionOracle& oracle_;
  LawProjection projection_;
  PadModel pads_;
  int left_, solves_ = 0;
  double tolerance_ = 0.0;
  PairStates states_;
  FrictionAnswer answer_;
  std::vector<int> violated_;
  std::vector<PairStates> met_;  // states reached while bodies were moved
  Balance at_, best_, first_;    // current, closest to the laws, and first one of a try
  bool isNew_ = true;            // the next solution starts a new line: earlier ones are not comparable
  Vector guess_, tresca_;        // normal forces of the pads, and of the Tresca problem with bounds from them
};

}  // namespace suture
