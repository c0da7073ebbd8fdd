#pragma once
#include <suture/contact/ContactSearch.hpp>

namespace suture {

/// Elastic bodies condensed to their contact pairs (Delassus matrix): penetrations  w = d - W f + G a,  equilibrium  G^T f = e,  with the
/// compliance W = N K^+ N^T, the penetrations d without forces, and rigid amplitudes a. Solved by dense factorisations. Local.
class DelassusProblem : public ContactOracle {
 public:
  /// Result of a solve, from which displacements are recovered.
  struct State {
    Vector force;      ///< forces of all pairs, including holders
    Vector amplitude;  ///< a
  };

  /// `rigid` and `compliance` must outlive it.
  /// \param open     d [length]
  /// \param rounding error of d at each pair; empty: only its own round-off [length]
  DelassusProblem(const RigidContact& rigid, const Matrix& compliance, const Vector& open, const Vector& rounding);

  ContactAnswer solve(const ClosedSet& closed, int level) override;
  Change redistribute(const ClosedSet& closed, const Vector& given) override;
  void move(const Vector& motion) override { state_.amplitude += motion; }
  Vector motion() const override { return state_.amplitude; }
  const State& state() const { return state_; }

 private:
  /// Solves  W f - G a = right,  G^T f = balance  on closed pairs for f and a, with a in the motions that these pairs stop.
  void solveSaddle(const std::vector<int>& closed, const Vector& right, const Vector& balance, Vector& force, Vector& amplitude) const;

  const RigidContact& rigid_;
  const Matrix& compliance_;
  Vector open_, rounding_;
  State state_;
};

}  // namespace suture
