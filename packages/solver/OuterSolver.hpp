#pragma once
#include <suture/answer/OuterFigures.hpp>
#include <suture/base/Registry.hpp>
#include <suture/interface/Formulation.hpp>
#include <suture/interface/InterfaceProblem.hpp>
#include <suture/precond/Preconditioner.hpp>
#include <suture/solver/InnerSolver.hpp>
#include <suture/solver/accuracy/AutomaticTolerance.hpp>

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <string>

namespace suture {

/// Settings common to all outer solvers.
struct OuterSettings {
  /// Bound of sqrt(r.M^-1 r), r = F - S_0 U - S_KON(U), relative to its value at InterfaceProblem::initialState().
  double tolerance = 1e-8;
  int maximumIterations = 50;
  int maximumInnerIterations = 1000;
  std::function<Teuchos::RCP<Preconditioner>()> preconditioner;  ///< makes one of the scene's kind, or returns that of an earlier solution
  bool rigidStart = true;  ///< methods that work by sets start from rigid bodies on pads; false: from all pairs closed
  AutomaticTolerance::Estimate discretisationError = {};  ///< if set, iterations may end before `tolerance`, see AutomaticTolerance
  /// Called on all ranks with the state of every outer iteration except the last, for restarts. Collective.
  std::function<void(const InterfaceState&)> accepted = {};
};

struct OuterResult : OuterFigures {
  InterfaceState state;
  Vector slides;                            ///< motion of bodies that contact or friction does not hold, if not converged; else empty
  double multiple = 0.0;                    ///< factor on friction that would hold these bodies; 0: unknown
  std::vector<int> unsettled;               ///< pairs that changed between the last two sets, if not converged
  AutomaticTolerance::Recovered recovered;  ///< from the state, if an automatic tolerance needed it; else null
};

/// Solver of an InterfaceProblem, independent of the formulation behind it. The base class solves the auxiliary problem (20)-(21), all
/// pairs closed, from which all methods start, computes the stopping norm and reports; a method implements doSolve(). Strategies: Active
/// Set, Semismooth Newton, Chord, Successive Approximation; Registry<OuterSolver> adds user strategies. Collective.
class OuterSolver {
 public:
  static const char* kind() { return "outer solver"; }
  virtual ~OuterSolver() = default;

  /// True if it can solve the problems of a formulation; the default trusts a user's method. Local.
  virtual bool solves(const Formulation&) const { return true; }

  /// True if it supports pairs with friction. Local.
  virtual bool knowsFriction() const { return false; }

  /// \throws NumericalError  breakdown; lack of convergence is only reported in the result
  /// \param start  initial state instead of the auxiliary solution (a restart), or null; a linear problem starts at the minimum of the
  /// energy on the line to it
  OuterResult solve(const InterfaceProblem& problem, const OuterSettings& settings, Monitor& monitor,
                    const InterfaceState* start = nullptr) const;

  /// Data of a running method.
  struct Run {
    const InterfaceProblem& problem;
    const OuterSettings& settings;
    Monitor& monitor;
    InnerSolver inner;
    Teuchos::RCP<InterfaceOperator> bilateral;    ///< S, all pairs closed
    Teuchos::RCP<Preconditioner> preconditioner;  ///< preconditioner of S; its norm is the stopping norm
    double reference = 0.0;                       ///< norm of the residual at InterfaceProblem::initialState()
    double referenceEuclidean = 0.0;
    double begin = 0.0;  ///< seconds
    OuterResult& result;
    ContactStates reported;                   ///< states of the last row, reference for `changed`; initially all closed
    InterfaceProblem::Evaluation evaluation;  ///< at result.state, with the status of the evaluation
    AutomaticTolerance automatic;
    bool fromAuxiliary = false;         ///< a method by sets starts from the auxiliary solution
    ContactStates preconditioned = {};  ///< in that case, states for which the preconditioner was made
    bool bySets = false;                ///< the method works by pair states
    bool given = false;                 ///< the start is a given state
    bool solved = false;                ///< a method by sets has found the set of closed pairs, and the residual is small enough
    bool atFloor = false;               ///< the residual stagnates at round-off above the tolerance
    double lowest = 0.0;                ///< smallest eigenvalue of M^-1 S in the linear solves so far; 0 before the first

    /// Tolerance of methods by pair states: that of the settings, or the automatic one, which changes with each estimate.
    double tolerance() const { return automatic.on() ? automatic.tolerance() : settings.tolerance; }
    /// Relative residual of an evaluation.
    double norm(const InterfaceProblem::Evaluation& at) const;
    /// Accepts a new iterate without evaluating it: updates status and result.residual, and reports a row.
    /// \param energyError  algebraic error in the energy norm; negative: unknown
    void accept(InterfaceState state, InterfaceProblem::Evaluation at, double residual, const InnerResult& cost, double step,
                double energyError);
    bool done() const;
    /// Estimates the discretisation error if an automatic tolerance may end the iterations and the estimate is not up to date. Collective.
    void confirm();
    /// Fills in the figures of the preconditioner and of its first operator in the result. Collective.
    void describe(const InterfaceOperator& matrix);
    bool described = false;  ///< describe() was called
    /// Records the smallest eigenvalue of a solve.
    void learn(const InnerResult& solve);
    /// Estimate of the algebraic error in the energy norm from a residual: sqrt(r.M^-1 r / lowest). An upper bound if these eigenvalues are
    /// those of the operator at the solution. Negative: unknown.
    double energyBound(double residual) const { return lowest > 0.0 ? residual * reference / std::sqrt(lowest) : -1.0; }
    /// The algebraic error in the energy norm by the tangent at a state, for methods that do not solve with the tangent. It costs a few
    /// iterations, which are added to `cost`, and is computed only if it may end the iterations (otherwise negative: unknown). Collective.
    double energyErrorByTangent(const InterfaceState& state, const InterfaceProblem::Evaluation& at, double residual, InnerResult& cost);
    /// Message that states why the automatic tolerance ended the iterations.
    std::string reason() const;
    /// True if a stop was requested. Collective.
    bool stopRequested();
    /// True while not converged, below the iteration limit and without a stop request. Collective.
    bool goesOn();
  };

 protected:
  /// True for a method that works by pair states (InterfaceProblem::contact()) and measures residuals itself. doSolve() then finds
  /// its initial state in run.result.state, not evaluated. If this is the auxiliary solution (wantsAuxiliary() and Start = Bilateral),
  /// run.fromAuxiliary is true and the preconditioner exists; otherwise there is no preconditioner yet.
  virtual bool worksBySets() const { return false; }
  /// True if Start = Bilateral means the auxiliary solution; else it is the unsolved state with all pairs closed.
  virtual bool wantsAuxiliary() const { return true; }
  /// Iterates from the evaluated auxiliary solution in run.result.state until run.done() or failure (run.result.failure).
  virtual void doSolve(Run& run) const = 0;
  /// Tolerance of the auxiliary problem.
  virtual double auxiliaryTolerance(const OuterSettings& settings) const = 0;

 private:
  static OuterResult conclude(Run& run);
};

void registerBuiltIns(Registry<OuterSolver>& registry);

}  // namespace suture
