#pragma once
#include <suture/reference/Delassus.hpp>

namespace suture {

/// The conditions of contact with friction as equations for the forces f of all rows and the amplitudes a of the kernel: with the jumps
/// w = h - H f + C Z a (penetrations and slips of the step) and the trial forces z = f + c w of a pair,
///     f = projection of z by the pair's law,    (C Z)^T f = Z^T load
/// (Alart and Curnier 1991). c is a tenth of the local stiffness, 1 / H_ii or more on bodies that yield as a
/// whole: at one and above Newton's method cycles (measured). Either by
/// the laws, or with frozen bounds of the tangential forces: a Tresca problem, which is convex. Local.
class FrictionConditions {
 public:
  struct Unknowns {
    Vector force, place;
  };
  enum class Sliding { Free, Stick, Slip };
  /// Branch of the projection in which a pair is.
  struct Branch {
    bool pressed = false;  ///< the normal row is an equation
    Sliding sliding = Sliding::Free;
    double bound = 0.0;                 ///< tangential force at the trial of a pair that slips
    double slope = 0.0;                 ///< by how much the normal force raises it
    double normal = 0.0, length = 0.0;  ///< trial forces: the normal one, size of the tangential one
    Point direction{0, 0, 0};           ///< direction of slip, in the frame of the pair

    /// The same equations, but for a slip that turns a little.
    bool like(const Branch& other) const;
  };
  struct Evaluation {
    std::vector<ContactState> states;  ///< by the laws; empty with frozen bounds
    std::vector<Branch> branches;
    Vector jump, residual;        ///< w; f - projection
    Vector defect;                ///< Z^T load - (C Z)^T f
    double merit = 0.0;           ///< norm of residual and defect [force]
    double error = 0.0;           ///< largest of them over its tolerance: solved at 1 and below
    bool withinRounding = false;  ///< solved, if rounding is allowed for that the largest forces leave in each jump
    double violation = 0.0;       ///< residual as a displacement [length]
  };
  using States = std::vector<ContactState>;

  /// Both must outlive it.
  FrictionConditions(const CondensedContact& problem, const Delassus& delassus);

  int rows() const { return int(open_.size()); }
  int motions() const { return int(motions_.cols()); }
  const std::vector<CondensedContact::Pair>& pairs() const { return pairs_; }

  /// \param now  states that the pairs have; kept where the trial decides nothing
  Evaluation evaluate(const Unknowns& at, const States& now) const;
  /// With frozen bounds, one a pair; infinite: the pair does not slide.
  Evaluation evaluate(const Unknowns& at, const Vector& bounds) const;
  /// Branches that given states mean: a start.
  std::vector<Branch> branchesOf(const States& states) const;
  /// Bounds of the tangential forces at a trial, for a Tresca problem.
  Vector bounds(const Unknowns& at, const States& now) const;

  enum class Solved { Exactly, Held, Dragged, Not };
  /// Solution of the equations of some branches, linearised: a step of Newton's method. Where they leave forces undetermined these stay
  /// near what they are (Held); where they leave a body loose, it moves against a drag (Dragged).
  /// \param drag  of the loose motions, of the local stiffness
  Solved solve(const std::vector<Branch>& branches, const Unknowns& at, double drag, Unknowns& next) const;

  /// Tresca problem by block Gauss-Seidel on its energy, which falls with each block, and Newton steps where they lower it, inside a
  /// proximal point iteration on the motions. Ends always. Better `at` in, best found out. \return its evaluation
  Evaluation solveByBlocks(Unknowns& at, const Vector& bounds, int sweeps) const;

 private:
  /// Softness, of a row's own elements, that keeps undetermined forces near what they were.
  static constexpr double kHold = 1e-8;

  void finish(const Unknowns& at, const Vector& projection, Evaluation& evaluation) const;
  Evaluation begin(const Unknowns& at) const;
  Vector projection(const Evaluation& evaluation, const Vector& trial) const;
  Vector trial(const Unknowns& at, const Vector& jump) const { return at.force + factor_.cwiseProduct(jump); }
  bool solveOnce(const std::vector<Branch>& branches, const Unknowns& at, double hold, double drag, Unknowns& next) const;
  ContactState project(std::size_t pair, const Point& force, const Point& jump, const ContactState& now) const;
  Vector ontoAllowed(Vector force, const Vector& bounds) const;

  std::vector<CondensedContact::Pair> pairs_;
  std::vector<char> able_, touches_;  // by pair: its normal row has unknowns; it touches where it has none
  const Vector &open_, &work_;
  Matrix compliance_, sizes_;          // H, |H|; of a tangential row without unknowns next to nothing
  const Matrix& motions_;              // C Z
  Vector local_, rounding_;            // compliance of each row's own elements; error of its jump by rounding
  Vector factor_, scale_, amplitude_;  // c of each row; scales of forces and amplitudes
};

}  // namespace suture
