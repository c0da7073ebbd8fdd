#pragma once
#include <suture/reference/Delassus.hpp>

namespace suture {

/// Frictional contact conditions as equations for the forces f of all rows and the amplitudes a of the kernel: with the jumps w = h - H f +
/// C Z a (penetrations and slips of the step) and the trial forces z = f + c w of a pair,
///     f = projection of z by the pair's law,    (C Z)^T f = Z^T load
/// (Alart and Curnier 1991). c is a tenth of the local stiffness, which is 1 / H_ii, or more on bodies that yield as a whole; with c of the
/// local stiffness and above, Newton's method cycles (measured). The tangential forces follow either the laws, or frozen bounds: a convex
/// Tresca problem. Local.
class FrictionConditions {
 public:
  struct Unknowns {
    Vector force, place;
  };
  enum class Sliding { Free, Stick, Slip };
  /// Branch of the projection of a pair.
  struct Branch {
    bool pressed = false;  ///< the normal row is an equation
    Sliding sliding = Sliding::Free;
    double bound = 0.0;                 ///< tangential force limit of a slipping pair at the trial state
    double slope = 0.0;                 ///< derivative of the bound with respect to the normal force
    double normal = 0.0, length = 0.0;  ///< trial forces: normal force, norm of the tangential force
    Point direction{0, 0, 0};           ///< direction of slip, in the frame of the pair

    /// True if the equations are the same up to a small rotation of the slip direction.
    bool like(const Branch& other) const;
  };
  struct Evaluation {
    std::vector<ContactState> states;  ///< from the laws; empty with frozen bounds
    std::vector<Branch> branches;
    Vector jump, residual;        ///< w; f - projection
    Vector defect;                ///< Z^T load - (C Z)^T f
    double merit = 0.0;           ///< norm of residual and defect [force]
    double error = 0.0;           ///< largest of them over its tolerance; solved if <= 1
    bool withinRounding = false;  ///< solved up to the round-off of the largest forces in each jump
    double violation = 0.0;       ///< residual as a displacement [length]
  };
  using States = std::vector<ContactState>;

  /// Both must outlive it.
  FrictionConditions(const CondensedContact& problem, const Delassus& delassus);

  int rows() const { return int(open_.size()); }
  int motions() const { return int(motions_.cols()); }
  const std::vector<CondensedContact::Pair>& pairs() const { return pairs_; }

  /// \param now  current states of the pairs, kept if the trial is indifferent
  Evaluation evaluate(const Unknowns& at, const States& now) const;
  /// With frozen bounds, one per pair; infinite: the pair does not slide.
  Evaluation evaluate(const Unknowns& at, const Vector& bounds) const;
  /// Branches of given states, for a start.
  std::vector<Branch> branchesOf(const States& states) const;
  /// Bounds of the tangential forces at a trial, for a Tresca problem.
  Vector bounds(const Unknowns& at, const States& now) const;

  enum class Solved { Exactly, Held, Dragged, Not };
  /// Solves the linearised equations of given branches: a Newton step. Undetermined forces stay near their current values (Held); a loose
  /// body moves against a drag (Dragged). \param drag  of the loose motions, relative to the local stiffness
  Solved solve(const std::vector<Branch>& branches, const Unknowns& at, double drag, Unknowns& next) const;

  /// Solves a Tresca problem by block Gauss-Seidel on its energy, which decreases with each block, and Newton steps that decrease it,
  /// inside a proximal point iteration on the motions. Always terminates. \param at  in: initial guess; out: best solution found. \return
  /// its evaluation
  Evaluation solveByBlocks(Unknowns& at, const Vector& bounds, int sweeps) const;

 private:
  /// Compliance, relative to a row's own elements, that keeps undetermined forces near their previous values.
  static constexpr double kHold = 1e-8;

  void finish(const Unknowns& at, const Vector& projection, Evaluation& evaluation) const;
  Evaluation begin(const Unknowns& at) const;
  Vector projection(const Evaluation& evaluation, const Vector& trial) const;
  Vector trial(const Unknowns& at, const Vector& jump) const { return at.force + factor_.cwiseProduct(jump); }
  bool solveOnce(const std::vector<Branch>& branches, const Unknowns& at, double hold, double drag, Unknowns& next) const;
  ContactState project(std::size_t pair, const Point& force, const Point& jump, const ContactState& now) const;
  Vector ontoAllowed(Vector force, const Vector& bounds) const;

  std::vector<CondensedContact::Pair> pairs_;
  std::vector<char> able_, touches_;  // by pair: its normal row has unknowns; without unknowns, the pair touches
  const Vector &open_, &work_;
  Matrix compliance_, sizes_;          // H, |H|; close to zero for a tangential row without unknowns
  const Matrix& motions_;              // C Z
  Vector local_, rounding_;            // compliance of each row's own elements; round-off error of its jump
  Vector factor_, scale_, amplitude_;  // c of each row; scales of forces and amplitudes
};

}  // namespace suture
