#include <suture/base/Dense.hpp>
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

using Iteration = Belos::Iteration<double, MultiVector, Operator>;

/// Stops on sqrt(r.z), z = M^-1 r, which the iteration has anyway.
class PreconditionedNormTest : public Belos::StatusTest<double, MultiVector, Operator> {
 public:
  PreconditionedNormTest(double tolerance, double reference, int most, Monitor& monitor)
      : tolerance_(tolerance), reference_(reference), most_(most), monitor_(monitor) {}

  Belos::StatusType checkStatus(Iteration* iteration) override {
    const auto state = dynamic_cast<Belos::CGIteration<double, MultiVector, Operator>&>(*iteration).getState();
    const double square = dot(*state.R, *state.Z);
    const double relative = std::sqrt(std::max(square, 0.0)) / reference_;
    history.push_back(relative);
    if (monitor_.wantsInner()) monitor_.inner(iteration->getNumIters(), relative);
    converged = relative <= tolerance_;
    // What is no number never becomes one: stop, and let the caller see.
    status_ = converged || !std::isfinite(relative) || iteration->getNumIters() >= most_ ? Belos::Passed : Belos::Failed;
    return status_;
  }
  Belos::StatusType getStatus() const override { return status_; }
  void reset() override { status_ = Belos::Undefined; }
  void print(std::ostream&, int) const override {}

  bool converged = false;
  std::vector<double> history;

 private:
  double tolerance_, reference_;
  int most_;
  Monitor& monitor_;
  Belos::StatusType status_ = Belos::Undefined;
};

}  // namespace

double preconditionedNorm(const Preconditioner& preconditioner, const MultiVector& r) {
  const MultiVectorPtr z = preconditioner.space()->vector();
  preconditioner.apply(r, *z);
  return std::sqrt(std::max(dot(r, *z), 0.0));
}

InnerResult InnerSolver::solve(const Teuchos::RCP<const Operator>& matrix, const Teuchos::RCP<const Preconditioner>& preconditioner,
                               const MultiVector& b, MultiVector& x, double tolerance, double reference, Monitor& monitor) const {
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
  const auto test = Teuchos::rcp(new PreconditionedNormTest(tolerance, reference, most_, monitor));
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
  result.residual = result.history.back();
  const auto diagonal = iteration.getDiag();
  const auto offDiagonal = iteration.getOffDiag();
  const std::vector<double> d(diagonal.begin(), diagonal.begin() + result.pcg);
  const std::vector<double> o(offDiagonal.begin(), offDiagonal.begin() + std::max(result.pcg - 1, 0));
  // d_k = 1 / step_k + b_(k-1) / step_(k-1), b the ratio of successive squared norms, which the history has.
  for (int k = 0; k < result.pcg; ++k) {
    const double ratio = k > 0 ? result.history[k] / result.history[k - 1] : 0.0;
    result.steps.push_back(1.0 / (d[k] - (k > 0 ? ratio * ratio / result.steps[k - 1] : 0.0)));
  }
  const std::vector<double> eigenvalues = tridiagonalEigenvalues(d, o);
  if (!eigenvalues.empty() && eigenvalues.front() > 0.0) {
    result.condition = eigenvalues.back() / eigenvalues.front();
    result.largestEigenvalue = eigenvalues.back();
  }
  return result;
}

}  // namespace suture
