#include <suture/base/Progress.hpp>
#include <suture/base/Timers.hpp>
#include <suture/solver/InnerSolver.hpp>
#include <suture/solver/accuracy/EnergyError.hpp>

#include <BelosCGIteration.hpp>
#include <BelosLinearProblem.hpp>
#include <BelosOutputManager.hpp>
#include <BelosPseudoBlockCGIter.hpp>
#include <BelosStatusTest.hpp>
#include <BelosTpetraAdapter.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_MultiVector.hpp>
#include <Tpetra_Operator.hpp>

#include <cmath>
#include <limits>

namespace suture {

namespace {

// Ritz values are above the smallest eigenvalue, but the error bound needs a value below it.
constexpr double kBelowRitz = 0.98;
// Reduction of the residual below which its recurrence goes on, down to underflow, but the solution does not change any more.
constexpr double kLeastReduction = std::numeric_limits<double>::epsilon();

/// A number below the smallest eigenvalue of M^-1 S; 0: unknown. After few iterations the Ritz values are far above that eigenvalue, hence
/// also that of earlier solves and that of theory. \param known, theory  0: unknown
double lowestEigenvalue(const RitzValues& ritz, double known, double theory) {
  double lowest = 0.0;
  for (const double value : {kBelowRitz * ritz.smallest, known, kBelowRitz * theory})
    if (value > 0.0) lowest = lowest > 0.0 ? std::min(lowest, value) : value;
  return lowest;
}

using Iteration = Belos::Iteration<double, MultiVector, Operator>;
using ConjugateGradients = Belos::PseudoBlockCGIter<double, MultiVector, Operator>;

/// sqrt(r.z), z = M^-1 r
double residualNorm(const ConjugateGradients& cg) {
  const auto state = cg.getState();
  return std::sqrt(std::max(dot(*state.R, *state.Z), 0.0));
}

/// Stops on sqrt(r.z), z = M^-1 r, which the iteration computes anyway. Stores norms and steps of all iterations.
class PreconditionedNormTest : public Belos::StatusTest<double, MultiVector, Operator> {
 public:
  /// Stopping criteria of one call.
  struct Aim {
    double tolerance, reference;
    int last;  ///< last iteration allowed
    Monitor& monitor;
    const EnergyCriterion& energy;
    std::function<const MultiVector&()> x;  ///< vector passed to the criterion
  };

  void aimAt(const Aim& aim) {
    aim_ = &aim;
    converged = enough = false;
  }

  /// \param leastEigenvalue  of the preconditioned operator by theory; 0: unknown
  explicit PreconditionedNormTest(double leastEigenvalue) : leastEigenvalue_(leastEigenvalue) {}

  /// Below the smallest eigenvalue; 0: unknown.
  double lowest(const EnergyCriterion& energy) const { return lowestEigenvalue(ritzValues(norms, steps), energy.lowest, leastEigenvalue_); }

  Belos::StatusType checkStatus(Iteration* iteration) override {
    auto& cg = dynamic_cast<ConjugateGradients&>(*iteration);
    const auto k = static_cast<std::size_t>(iteration->getNumIters());
    if (norms.size() == k) {  // else the solve was resumed, and this iteration is already recorded
      norms.push_back(residualNorm(cg));
      if (k > 0) {
        // The Lanczos matrix has 1 / step_k + b_(k-1) / step_(k-1) on its diagonal, b the ratio of successive squared norms.
        const double ratio = k > 1 ? norms[k - 1] / norms[k - 2] : 0.0;
        steps.push_back(1.0 / (cg.getDiag()[k - 1] - (k > 1 ? ratio * ratio / steps[k - 2] : 0.0)));
      }
      Progress::iteration(static_cast<long>(k), norms.back() / aim_->reference, aim_->tolerance);
      if (aim_->monitor.wantsInner()) aim_->monitor.inner(static_cast<int>(k), norms.back() / aim_->reference);
    }
    const double relative = norms.back() / aim_->reference;
    converged = relative <= aim_->tolerance;
    if (!converged && aim_->energy.enough && std::isfinite(relative))
      if (const double below = lowest(aim_->energy); below > 0.0) {
        const std::vector<double> errors = energyErrors(norms, steps, below);
        converged = enough = aim_->energy.enough(errors.front(), std::max(norms.back(), errors.back()), aim_->x());
      }
    // Stop on NaN; the caller checks the residual.
    status_ = converged || !std::isfinite(relative) || iteration->getNumIters() >= aim_->last ? Belos::Passed : Belos::Failed;
    return status_;
  }
  Belos::StatusType getStatus() const override { return status_; }
  void reset() override { status_ = Belos::Undefined; }
  void print(std::ostream&, int) const override {}

  bool converged = false, enough = false;
  std::vector<double> norms, steps;

 private:
  const double leastEigenvalue_;
  const Aim* aim_ = nullptr;
  Belos::StatusType status_ = Belos::Undefined;
};

}  // namespace

/// State of conjugate gradients between two calls, including all objects that Belos refers to.
struct InnerSolver::Solve {
  MultiVectorPtr x;
  Teuchos::RCP<Belos::LinearProblem<double, MultiVector, Operator>> problem;
  Teuchos::RCP<PreconditionedNormTest> test;
  std::unique_ptr<ConjugateGradients> iteration;
  double norm = 0.0;  // norm of the right-hand side
};

InnerSolver::InnerSolver(int most) : most_(most) {}
InnerSolver::~InnerSolver() = default;
InnerSolver::InnerSolver(InnerSolver&&) noexcept = default;

double preconditionedNorm(const Preconditioner& preconditioner, const MultiVector& r) {
  const MultiVectorPtr z = preconditioner.space()->vector();
  preconditioner.apply(r, *z);
  return std::sqrt(std::max(dot(r, *z), 0.0));
}

InnerResult InnerSolver::solve(const Teuchos::RCP<const Operator>& matrix, const Teuchos::RCP<const Preconditioner>& preconditioner,
                               const MultiVector& b, MultiVector& x, double tolerance, double reference, Monitor& monitor,
                               const EnergyCriterion& energy) {
  solve_.reset();
  x.putScalar(0.0);
  auto made = std::make_unique<Solve>();
  made->x = preconditioner->space()->vector();
  made->test = Teuchos::rcp(new PreconditionedNormTest(preconditioner->leastEigenvalue()));
  const auto right = Teuchos::rcp(new MultiVector(b, Teuchos::Copy));
  made->problem = Teuchos::rcp(new Belos::LinearProblem<double, MultiVector, Operator>(matrix, made->x, right));
  made->problem->setInitResVec(right);  // x = 0: the residual is b, without applying the operator
  made->problem->setProblem();
  made->problem->setLeftPrec(preconditioner);  // after setProblem(), which would apply it to the residual, as the iteration does again
  made->problem->setLSIndex({0});

  Teuchos::ParameterList options;
  options.set("Max Size For Condest", 2 * most_);  // canGoOn() ensures that there are no more
  options.set("Assert Positive Definiteness", true);
  const auto output = Teuchos::rcp(new Belos::OutputManager<double>(Belos::Errors));
  made->iteration = std::make_unique<ConjugateGradients>(made->problem, output, made->test, options);
  made->iteration->setDoCondEst(true);
  Belos::CGIterationState<double, MultiVector> start;
  start.R = right;
  made->iteration->initializeCG(start);

  const double norm = residualNorm(*made->iteration);
  if (!std::isfinite(norm)) throw NumericalError("the right-hand side of the inner solver is not finite");
  if (reference <= 0.0) reference = norm;
  if (norm == 0.0 || norm / reference <= tolerance) {
    InnerResult result;
    result.reference = reference;
    result.residual = norm > 0.0 ? norm / reference : 0.0;
    result.history.push_back(result.residual);
    result.converged = true;
    const double lowest = lowestEigenvalue({}, energy.lowest, preconditioner->leastEigenvalue());
    if (norm == 0.0 || lowest > 0.0) result.energyErrors.push_back(norm > 0.0 ? norm / std::sqrt(lowest) : 0.0);
    return result;
  }
  made->norm = norm;
  solve_ = std::move(made);
  return iterate(x, tolerance, reference, monitor, energy);
}

bool InnerSolver::canGoOn() const { return solve_ && solve_->iteration->getNumIters() <= most_; }

InnerResult InnerSolver::goOn(MultiVector& x, double tolerance, double reference, Monitor& monitor, const EnergyCriterion& energy) {
  if (!canGoOn()) throw InternalError("there is no inner solve to resume");
  return iterate(x, tolerance, reference > 0.0 ? reference : solve_->norm, monitor, energy);
}

InnerResult InnerSolver::iterate(MultiVector& x, double tolerance, double reference, Monitor& monitor, const EnergyCriterion& energy) {
  PreconditionedNormTest& test = *solve_->test;
  const int before = solve_->iteration->getNumIters();
  const MultiVector start(*solve_->x, Teuchos::Copy);
  const auto added = [&]() -> const MultiVector& {
    x.update(1.0, *solve_->x, -1.0, start, 0.0);
    return x;
  };
  const double least = kLeastReduction * solve_->norm / reference;
  const PreconditionedNormTest::Aim aim{std::max(tolerance, least), reference, before + most_, monitor, energy, added};
  test.aimAt(aim);
  const double begin = Timers::now();
  try {
    solve_->iteration->iterate();
  } catch (const Belos::CGIterateFailure&) {
    throw NumericalError("conjugate gradients broke down in iteration " + std::to_string(solve_->iteration->getNumIters() + 1) +
                         ": the operator or the preconditioner is not positive definite");
  }
  InnerResult result;
  result.reference = reference;
  result.seconds = Timers::now() - begin;
  added();
  result.pcg = solve_->iteration->getNumIters() - before;
  result.converged = test.converged;
  result.enough = test.enough;
  for (std::size_t k = before; k < test.norms.size(); ++k) result.history.push_back(test.norms[k] / reference);
  result.residual = result.history.back();
  result.steps.assign(test.steps.begin() + before, test.steps.end());
  const RitzValues ritz = ritzValues(test.norms, test.steps);
  if (ritz.smallest > 0.0) {
    result.condition = ritz.largest / ritz.smallest;
    result.largestEigenvalue = ritz.largest;
    result.smallestEigenvalue = ritz.smallest;
  }
  if (const double lowest = test.lowest(energy); lowest > 0.0) result.energyErrors = energyErrors(test.norms, test.steps, lowest);
  return result;
}

}  // namespace suture
