#pragma once
#include <suture/search/LinearContactSolver.hpp>
#include <suture/search/RigidBodyModel.hpp>

#include <functional>

namespace suture {

/// Frictionless contact from any admissible forces: the dual energy d.l - l.W l / 2 of forces l >= 0 in equilibrium increases strictly from
/// one set of closed pairs to the next, so no set recurs, and the search ends at the solution. Slower than Newton steps, but proven to
/// converge; StateSearch uses it if Newton stalls.
///
/// In each step all penetrating pairs close. Forces then move towards the solution of the new set until a pair would be in tension; this
/// pair opens, and so on. If only newly closed pairs would be in tension, fewer pairs close, finally only the one that penetrates most,
/// whose force is compressive. Local, apart from the solves.
class DualAscent {
 public:
  /// Solves for a set of closed pairs at the final accuracy; null: no solution, or no solves left.
  using Solve = std::function<const ContactAnswer*(const ClosedSet&)>;

  /// \param rigid  must outlive it
  DualAscent(const RigidBodyModel& rigid, Solve solve) : rigid_(rigid), solve_(std::move(solve)) {}
  /// \param force  >= 0, in equilibrium with the loads
  /// \return true: the last solve is the solution, at least up to round-off of its energy; false: a solve returned null
  bool run(const Vector& force);

 private:
  /// State with forces >= 0 that is the solution for its closed pairs.
  struct State {
    Vector force, penetration, tolerance;
    ClosedSet closed;
    double energy = 0.0;
  };
  enum class End { Risen, Stopped, Idle };

  End climb(ClosedSet support, ClosedSet entering, Vector force, State& to);
  ClosedSet penetrating(const State& at) const;
  int worst(const State& at) const;

  const RigidBodyModel& rigid_;
  Solve solve_;
};

}  // namespace suture
