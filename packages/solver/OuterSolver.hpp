#pragma once
#include <suture/base/Registry.hpp>
#include <suture/interface/Formulation.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/precond/Preconditioner.hpp>
#include <suture/solver/InnerSolver.hpp>
#include <suture/solver/OuterFigures.hpp>
#include <suture/solver/accuracy/AutomaticTolerance.hpp>

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace suture {

/// Settings of every outer solver.
struct OuterSettings {
  double tolerance = 1e-8;  ///< bound of sqrt(r.M r) relative to the residual of the lifted start, r = F - S_0 U - S_KON(U)
  int maximumIterations = 50;
  int maximumInnerIterations = 1000;
  std::function<Teuchos::RCP<Preconditioner>()> preconditioner;  ///< makes one of the scene's kind, or gives that of a solution before
  bool rigidStart = true;  ///< methods that start themselves: from rigid bodies on pads; else with all pairs closed
  AutomaticTolerance::Estimate discretisationError = {};  ///< set: iterations may end before `tolerance`, see AutomaticTolerance
  /// Told the state of every outer iteration but the last, on all ranks: where a run could go on. Collective.
  std::function<void(const InterfaceState&)> accepted = {};
};

struct OuterResult : OuterFigures {
  InterfaceState state;
  Vector slides;                            ///< motion of bodies that friction does not hold, where it did not converge; else empty
  double multiple = 0.0;                    ///< of friction, that would hold them; 0: not known
  std::vector<int> unsettled;               ///< pairs that changed between the last two sets, where it did not converge
  AutomaticTolerance::Recovered recovered;  ///< from the state, where an automatic tolerance needed it; else null
};

/// Solves an InterfaceProblem of which it knows nothing else. The shell solves the auxiliary problem (20)-(21), all pairs closed, from
/// which all methods start, owns the stopping norm and reports; a method is written in doSolve(). Strategies: Semismooth Newton, Chord,
/// Successive Approximation; a user adds his own through Registry<OuterSolver>. Collective.
class OuterSolver {
 public:
  static const char* kind() { return "outer solver"; }
  virtual ~OuterSolver() = default;

  /// True if it can solve the problems of a formulation; of a user's own it is believed. Local.
  virtual bool solves(const Formulation&) const { return true; }

  /// True if it finds the states of pairs with friction. Local.
  virtual bool knowsFriction() const { return false; }

  /// \throws NumericalError  breakdown; not for a mere lack of convergence, which the result says.
  /// \param start  where to begin instead of the auxiliary solution (a restart), or null; a linear problem begins on the way to it
  OuterResult solve(const InterfaceProblem& problem, const OuterSettings& settings, Monitor& monitor,
                    const InterfaceState* start = nullptr) const;

  /// Data of a method while it runs.
  struct Run {
    const InterfaceProblem& problem;
    const OuterSettings& settings;
    Monitor& monitor;
    InnerSolver inner;
    Teuchos::RCP<InterfaceOperator> bilateral;    ///< S, all pairs closed
    Teuchos::RCP<Preconditioner> preconditioner;  ///< preconditioner of S; its norm is the stopping norm
    double reference = 0.0;                       ///< norm of the lifted start's residual
    double referenceEuclidean = 0.0;
    double begin = 0.0;  ///< seconds
    OuterResult& result;
    ContactStates reported;                   ///< states of the last row, from which `changed` counts; at first all closed
    InterfaceProblem::Evaluation evaluation;  ///< at result.state, whose status is the evaluation's
    AutomaticTolerance automatic;
    bool fromAuxiliary = false;         ///< a method by sets starts from the auxiliary solution
    ContactStates preconditioned = {};  ///< states that the preconditioner was made for then
    bool given = false;                 ///< the start is one to go on from
    bool solved = false;   ///< a method that finds the set of closed pairs itself has found it, and the residual is small enough
    bool atFloor = false;  ///< rounding hides what the tolerance asks for beyond result.residual
    double lowest = 0.0;   ///< smallest eigenvalue of M^-1 S that a linear solve met, 0 before the first

    /// Relative residual of an evaluation.
    double norm(const InterfaceProblem::Evaluation& at) const;
    /// Takes over a new point: evaluates nothing; updates status, result.residual and reports a row.
    /// \param energyError  algebraic error in the energy norm; negative: not known
    void accept(InterfaceState state, InterfaceProblem::Evaluation at, double residual, const InnerResult& cost, double step,
                double energyError);
    bool done() const;
    /// Where an automatic tolerance may end the iterations: estimates, unless that was done, after which it may not. Collective.
    void confirm();
    /// Fills in what the result says of the preconditioner and the operator it was first made for. Collective.
    void describe(const InterfaceOperator& matrix);
    bool described = false;  ///< that was done
    /// Remembers the smallest eigenvalue that a solve met.
    void learn(const InnerResult& solve);
    /// Estimate of the algebraic error in the energy norm from a residual: sqrt(r.M r / lowest). An upper bound where the operator at the
    /// solution is the one whose eigenvalues were met. Negative: not known.
    double energyBound(double residual) const { return lowest > 0.0 ? residual * reference / std::sqrt(lowest) : -1.0; }
    /// The algebraic error in the energy norm, found with the tangent there: for methods that do not solve with it. Only where it may
    /// decide (else negative: not known), since it costs a few iterations, which are added to the step's. Collective.
    double energyErrorByTangent(const InterfaceState& state, const InterfaceProblem::Evaluation& at, double residual, InnerResult& cost);
    /// Why the automatic tolerance ended the iterations, for the user.
    std::string reason() const;
    /// True if somebody asked to stop. Collective.
    bool stopRequested();
    /// True while not converged, not at the iteration limit and not asked to stop. Collective.
    bool goesOn();
  };

 protected:
  /// True for a method that works by sets of closed pairs (InterfaceProblem::sets()) and measures residuals itself: doSolve() then begins
  /// with the state to start from in run.result.state, not evaluated. Where that is the auxiliary solution (wantsAuxiliary() and
  /// Start = Bilateral), run.fromAuxiliary holds, and there is a preconditioner; else there is none.
  virtual bool worksBySets() const { return false; }
  /// True if Start = Bilateral means the auxiliary solution; else the state with all pairs closed, not solved.
  virtual bool wantsAuxiliary() const { return true; }
  /// From the auxiliary solution in run.result.state, evaluated, until run.done() or given up with run.result.failure.
  virtual void doSolve(Run& run) const = 0;
  /// Tolerance of the auxiliary problem that the method starts from.
  virtual double auxiliaryTolerance(const OuterSettings& settings) const = 0;

 private:
  static OuterResult conclude(Run& run);
};

void registerBuiltIns(Registry<OuterSolver>& registry);

}  // namespace suture
