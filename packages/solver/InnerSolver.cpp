#include <suture/solver/EnergyError.hpp>
#include <suture/solver/InnerSolver.hpp>

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

namespace suture {

namespace {

// Ritz values come down to the smallest eigenvalue from above, the error bound wants to be below it.
constexpr double kBelowRitz = 0.98;

double lowestEigenvalue(const RitzValues& ritz, double known) {
  const double found = ritz.smallest > 0.0 ? kBelowRitz * ritz.smallest : 0.0;
  if (known <= 0.0) return found;
  return found > 0.0 ? std::min(found, known) : known;
}

using Iteration = Belos::Iteration<double, MultiVector, Operator>;

/// Stops on sqrt(r.z), z = M^-1 r, which the iteration has anyway.
class PreconditionedNormTest : public Belos::StatusTest<double, MultiVector, Operator> {
 public:
  PreconditionedNormTest(double tolerance, double reference, int most, Monitor& monitor, const EnergyCriterion& energy,
                         const MultiVector& x)
      : tolerance_(tolerance), reference_(reference), most_(most), monitor_(monitor), energy_(energy), x_(x) {}

  Belos::StatusType checkStatus(Iteration* iteration) override {
    auto& cg = dynamic_cast<Belos::PseudoBlockCGIter<double, MultiVector, Operator>&>(*iteration);
    const auto state = cg.getState();
    const double norm = std::sqrt(std::max(dot(*state.R, *state.Z), 0.0)), relative = norm / reference_;
    if (const int k = iteration->getNumIters(); k > 0) {
      // The Lanczos matrix has 1 / step_k + b_(k-1) / step_(k-1) on its diagonal, b the ratio of successive squared norms.
      const double ratio = k > 1 ? norms[k - 1] / norms[k - 2] : 0.0;
      steps.push_back(1.0 / (cg.getDiag()[k - 1] - (k > 1 ? ratio * ratio / steps[k - 2] : 0.0)));
    }
    norms.push_back(norm);
    history.push_back(relative);
    if (monitor_.wantsInner()) monitor_.inner(iteration->getNumIters(), relative);
    converged = relative <= tolerance_;
    if (!converged && energy_.enough && std::isfinite(relative))
      if (const double lowest = lowestEigenvalue(ritzValues(norms, steps), energy_.lowest); lowest > 0.0) {
        const std::vector<double> errors = energyErrors(norms, steps, lowest);
        converged = enough = energy_.enough(errors.front(), errors.back(), x_);
      }
    // What is no number never becomes one: stop, and let the caller see.
    status_ = converged || !std::isfinite(relative) || iteration->getNumIters() >= most_ ? Belos::Passed : Belos::Failed;
    return status_;
  }
  Belos::StatusType getStatus() const override { return status_; }
  void reset() override { status_ = Belos::Undefined; }
  void print(std::ostream&, int) const override {}

  bool converged = false, enough = false;
  std::vector<double> history, norms, steps;

 private:
  double tolerance_, reference_;
  int most_;
  Monitor& monitor_;
  const EnergyCriterion& energy_;
  const MultiVector& x_;  // that the iteration works on
  Belos::StatusType status_ = Belos::Undefined;
};

}  // namespace

double preconditionedNorm(const Preconditioner& preconditioner, const MultiVector& r) {
  const MultiVectorPtr z = preconditioner.space()->vector();
  preconditioner.apply(r, *z);
  return std::sqrt(std::max(dot(r, *z), 0.0));
}

InnerResult InnerSolver::solve(const Teuchos::RCP<const Operator>& matrix, const Teuchos::RCP<const Preconditioner>& preconditioner,
                               const MultiVector& b, MultiVector& x, double tolerance, double reference, Monitor& monitor,
                               const EnergyCriterion& energy) const {
  InnerResult result;
  x.putScalar(0.0);
  const MultiVectorPtr z = preconditioner->space()->vector();
  preconditioner->apply(b, *z);
  const double norm = std::sqrt(std::max(dot(b, *z), 0.0));
  if (!std::isfinite(norm)) throw NumericalError("the inner solver was given a right-hand side that is no number");
  if (reference <= 0.0) reference = norm;
  result.residual = reference > 0.0 ? norm / reference : 0.0;
  result.history.push_back(result.residual);
  if (norm == 0.0 || result.residual <= tolerance) {
    result.converged = true;
    if (norm == 0.0 || energy.lowest > 0.0) result.energyErrors.push_back(norm > 0.0 ? norm / std::sqrt(energy.lowest) : 0.0);
    return result;
  }

  const auto right = Teuchos::rcp(new MultiVector(b, Teuchos::Copy));
  const auto left = Teuchos::rcpFromRef(x);
  const auto problem = Teuchos::rcp(new Belos::LinearProblem<double, MultiVector, Operator>(matrix, left, right));
  problem->setLeftPrec(preconditioner);
  problem->setInitResVec(right);  // x = 0: the residual is b, and need not be found by applying the operator
  problem->setInitPrecResVec(z);
  problem->setProblem();
  problem->setLSIndex({0});

  Teuchos::ParameterList options;
  options.set("Max Size For Condest", most_);
  options.set("Assert Positive Definiteness", true);
  const auto test = Teuchos::rcp(new PreconditionedNormTest(tolerance, reference, most_, monitor, energy, x));
  const auto output = Teuchos::rcp(new Belos::OutputManager<double>(Belos::Errors));
  Belos::PseudoBlockCGIter<double, MultiVector, Operator> iteration(problem, output, test, options);
  iteration.setDoCondEst(true);
  Belos::CGIterationState<double, MultiVector> start;
  start.R = right;
  try {
    iteration.initializeCG(start);
    iteration.iterate();
  } catch (const Belos::CGIterateFailure& failure) {
    throw NumericalError(std::string("conjugate gradients broke down: ") + failure.what());
  }
  result.pcg = iteration.getNumIters();
  result.converged = test->converged;
  result.history = test->history;
  result.enough = test->enough;
  result.residual = result.history.back();
  result.steps = test->steps;
  const RitzValues ritz = ritzValues(test->norms, test->steps);
  if (ritz.smallest > 0.0) {
    result.condition = ritz.largest / ritz.smallest;
    result.largestEigenvalue = ritz.largest;
    result.smallestEigenvalue = ritz.smallest;
  }
  if (const double lowest = lowestEigenvalue(ritz, energy.lowest); lowest > 0.0)
    result.energyErrors = energyErrors(test->norms, test->steps, lowest);
  return result;
}

}  // namespace suture
