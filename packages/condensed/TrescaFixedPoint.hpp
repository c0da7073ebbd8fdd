#pragma once
#include <suture/search/StateSearch.hpp>

namespace suture {

/// Coulomb's law as a fixed point of Tresca problems, for linear solvers in which the forces of slipping pairs cannot follow normal forces
/// (LinearContactSolver::couplesToNormal): StateSearch solves each problem with bounds from the normal forces of the last one. Bounds are
/// mixed by Anderson's method (Walker and Ni 2011): as long as states do not change, the normal forces are linear in the bounds. The first
/// bounds are those of rigid bodies on pads, or of the given states; until states settle, bounds are updated after every second solve.
class TrescaFixedPoint {
 public:
  /// All arguments must outlive it. \param most  maximum number of solves
  TrescaFixedPoint(const RigidBodyModel& rigid, const ContactLaws& laws, const std::vector<FrictionSite>& sites,
                   LinearContactSolver& solver, int most)
      : rigid_(rigid), laws_(laws), sites_(sites), solver_(solver), left_(most) {}

  /// \param start  states of an earlier solution; empty: those of the pads
  StateSearch::Result run(PairStates start = {});

 private:
  bool next(Vector& normal, const Vector& found, double same);
  StateSearch::Result solve(const PairStates& start, const Vector& normal, int most);

  const RigidBodyModel& rigid_;
  const ContactLaws& laws_;
  const std::vector<FrictionSite>& sites_;
  LinearContactSolver& solver_;
  int left_, solves_ = 0;
  Matrix bounds_, changes_;  // one column per problem: normal forces of its bounds, and their difference from those of its solution
  double contraction_ = -1.0;
};

}  // namespace suture
