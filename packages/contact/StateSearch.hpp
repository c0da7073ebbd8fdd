#pragma once
#include <suture/contact/LawProjection.hpp>
#include <suture/contact/PadModel.hpp>

#include <memory>
#include <vector>

namespace suture {

/// Finds the states (open, slip, stick) of contact pairs, for all laws, in 2D and 3D: forces l and jumps w with l = P(l + R w).
///
/// It knows linear problems of given states (FrictionOracle), the laws (LawProjection) and rigid bodies on pads (PadModel):
///   1. limit analysis first: loads that no forces within the cones balance have no equilibrium;
///   2. states of the pads to begin with, no solve;
///   3. semismooth Newton: the states of P(l + R w) at the present balance give the next linear problem. Combinations of balances are in
///      balance, so that a line search on the distance from the laws costs no solve; where no step lowers it a full one is taken. Where
///      states cannot balance the loads, bodies are moved along the loads to states that hold them, or get those of the pads at t = c l +
///      w;
///   4. where the closed pairs of states leave bodies a motion in which no force does work (a ball between two plates turns about the line
///      through its poles), a spring along a tangent of an open pair holds it: without force, at the place where the bodies are;
///   5. where the distance has not fallen for some steps: the states of the pads at the present balance, and Newton from there, with other
///      constants.
/// Accuracy of the solves follows the distance from the laws.
class StateSearch {
 public:
  struct Result {
    bool converged = false;
    Vector slides;  ///< motion of bodies (RigidContact) along which they are driven where there is no equilibrium; else empty
    PairStates states;
    int solves = 0;
    double contraction = -1.0;     ///< of the fixed point of Tresca problems, estimated; negative: not known
    std::vector<int> alternating;  ///< pairs whose states did not settle
  };

  /// All must outlive it. \param most  solves at most
  StateSearch(const RigidContact& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites, FrictionOracle& oracle, int most);

  /// States of the pads where nothing is known yet.
  PairStates start();
  Result run(PairStates start);

 private:
  enum class End { Settled, Stalled, Exhausted, Failed };
  /// Forces and jumps in balance with the loads, and the distance from the laws.
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
  std::vector<PairStates> met_;  // by bodies on their way
  Balance at_, best_, first_;    // present one, nearest and first one of a try
  bool isNew_ = true;            // the next answer begins a line: those before do not compare
  Vector guess_, tresca_;        // normal forces of the pads, and of the Tresca problem that they give
};

}  // namespace suture
