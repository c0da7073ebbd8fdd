#pragma once
#include <suture/search/LinearContactSolver.hpp>
#include <suture/search/RigidBodyModel.hpp>

namespace suture {

/// Elastic bodies condensed to their contact pairs, without friction (Delassus matrix): penetrations  w = d - W f + G a,  equilibrium
/// G^T f = e,  with the compliance W = N K^+ N^T, the penetrations d without forces, and rigid amplitudes a. Solved by dense
/// factorisations. Local.
class DelassusProblem : public LinearContactSolver {
 public:
  /// Result of a solve, from which displacements are recovered.
  struct State {
    Vector force;      ///< forces of all pairs
    Vector amplitude;  ///< a
  };

  /// `rigid` and `compliance` must outlive it.
  /// \param open     d [length]
  /// \param rounding error of d at each pair; empty: only its own round-off [length]
  DelassusProblem(const RigidBodyModel& rigid, const Matrix& compliance, const Vector& open, const Vector& rounding);

  ContactAnswer solve(const PairStates& states, double tolerance) override;
  void move(const Vector& motion) override { state_.amplitude += motion; }
  Vector motion() const override { return state_.amplitude; }
  const State& state() const { return state_; }

 private:
  /// Solves  W f - G a = d,  G^T f = e  on closed pairs for f and a, with a in the motions that these pairs stop.
  void solveSaddle(const std::vector<int>& closed);

  const RigidBodyModel& rigid_;
  const Matrix& compliance_;
  Vector open_, rounding_;
  State state_;
};

}  // namespace suture
