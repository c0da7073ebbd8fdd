#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/condensed/SpectralRadius.hpp>
#include <suture/condensed/SuccessiveApproximation.hpp>

#include <Teuchos_ParameterList.hpp>
#include <Tpetra_MultiVector.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace suture {

namespace {

constexpr int kAllGroups = -1;
constexpr std::size_t kMostGroups = 8;  // one eigenvalue per group; for more groups the bound lambda^2 <= mu is used

/// Contact part of an operator: all groups, or the one with the given id.
Teuchos::RCP<InterfaceOperator> groupsOf(const InterfaceOperator& whole, const InterfaceOperator& withoutContact, int id) {
  LocalProblems locals = whole.locals();
  for (std::size_t i = 0; i < locals.size(); ++i)
    if (withoutContact.locals()[i] || (id != kAllGroups && locals[i]->id() != id)) locals[i].reset();
  return Teuchos::rcp(new InterfaceOperator(whole.space(), std::move(locals)));
}

/// Sorted ids of the contact groups of all ranks. Collective.
std::vector<int> groupIds(const InterfaceOperator& whole, const InterfaceOperator& withoutContact) {
  std::vector<int> mine, all;
  for (std::size_t i = 0; i < whole.locals().size(); ++i)
    if (!withoutContact.locals()[i]) mine.push_back(whole.locals()[i]->id());
  Packer packer;
  packer.put(mine);
  for (const std::string& bytes : allGather(*whole.space()->comm(), packer.bytes()))
    for (const int id : Unpacker(bytes).get<std::vector<int>>()) all.push_back(id);
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace

Schema SuccessiveApproximation::schema() {
  Schema schema("Successive approximations (18)/(32) of the paper; they converge only if contact groups are soft compared with the rest.");
  schema.wordOrNumber("Relaxation", "Automatic", {"None", "Automatic"}, {0.0, 2.0, true, false, {}},
                      "Factor of the correction: None is 1 (the paper), Automatic 2 / (2 + 1.1 mu), halved when the energy rises.");
  schema.real("Inner Tolerance", 1e-3, "Tolerance of each linear solve, relative to the outer residual at its start.",
              {0.0, 1.0, true, true, {}});
  return schema;
}

SuccessiveApproximation::SuccessiveApproximation(const Parameters& own)
    : innerTolerance_(own.get<double>("Inner Tolerance")), relaxation_(own.get<std::string>("Relaxation")) {}

void SuccessiveApproximation::doSolve(Run& run) const {
  const Teuchos::RCP<InterfaceOperator> s0 = run.problem.withoutContact();
  if (s0.is_null()) throw InputError("Outer Solver/Type", "Successive Approximation needs the formulation Condensed Groups");
  if (const std::string why = whySingular(*s0); !why.empty())
    throw NumericalError("Successive Approximation cannot start: S_0 is singular, " + why + ". Use Semismooth Newton or Chord");
  const Teuchos::RCP<Preconditioner> preconditioner = run.settings.preconditioner();
  preconditioner->initialize(run.problem.space());
  preconditioner->compute(s0);

  // A few digits of the eigenvalues suffice.
  Monitor silent;
  const auto solveS0 = [&](const MultiVector& b, MultiVector& x) { run.inner.solve(s0, preconditioner, b, x, 1e-6, 0.0, silent); };
  const auto radius = [&](const InterfaceOperator& contactPart) {
    return largestEigenvalue(contactPart, solveS0, *run.evaluation.residual);
  };
  const double mu = radius(*groupsOf(*run.bilateral, *s0, kAllGroups));
  run.result.estimates["mu"] = mu;
  // (41) needs one lambda for all groups; their sum is S^0, so lambda^2 <= mu.
  const std::vector<int> groups = groupIds(*run.bilateral, *s0);
  double lambdaSquared = groups.size() > 1 && groups.size() <= kMostGroups ? 0.0 : mu;
  for (std::size_t g = 0; g < groups.size() && lambdaSquared < mu; ++g)
    lambdaSquared = std::max(lambdaSquared, radius(*groupsOf(*run.bilateral, *s0, groups[g])));
  const double bound = 2.0 * lambdaSquared * run.problem.pieces();
  run.result.estimates["contraction bound"] = bound;
  double theta = relaxation_ == "None" ? 1.0 : relaxation_ == "Automatic" ? 2.0 / (2.0 + 1.1 * mu) : std::stod(relaxation_);
  std::ostringstream text;
  text.precision(3);
  text << "successive approximations: mu = lambda_max(S_0^-1 S^0) = " << mu << ", 2 lambda^2 Pc = " << bound
       << (mu < 1.0 ? ": contracting" : ": not contracting without relaxation") << "; relaxation " << theta;
  if (bound < 1.0) text << "; error bound q^k/(1-q) ||U^0 - T U^0|| with q = " << bound;
  run.monitor.note(text.str());

  const MultiVectorPtr correction = run.problem.space()->vector();
  const double first = run.result.residual;
  while (run.goesOn()) {
    InnerResult cost = run.inner.solve(s0, preconditioner, *run.evaluation.residual, *correction, innerTolerance_, 0.0, run.monitor);
    run.learn(cost);
    if (!cost.converged) {
      run.result.pcgTotal += cost.pcg;
      run.result.failure = "a linear solve did not reach its tolerance";
      return;
    }
    InterfaceState next = run.result.state;
    next.trace = Teuchos::rcp(new MultiVector(*run.result.state.trace, Teuchos::Copy));
    run.problem.update(next, *correction, theta);
    InterfaceProblem::Evaluation at = run.problem.evaluate(next);
    const double rise = at.energy - run.evaluation.energy;
    if (relaxation_ == "Automatic" && rise > 1e-12 * std::abs(run.evaluation.energy)) {
      theta *= 0.5;
      run.monitor.note("the energy rose: relaxation halved");
    }
    const double residual = run.norm(at);
    const double energyError = run.energyErrorByTangent(next, at, residual, cost);
    run.accept(std::move(next), std::move(at), residual, cost, theta, energyError);
    if (!(run.result.residual < 1e3 * std::max(first, run.settings.tolerance))) {
      std::ostringstream why;
      why << "successive approximations diverge (mu = " << mu << "); use Relaxation = Automatic, or Semismooth Newton or Chord";
      run.result.failure = why.str();
      break;
    }
  }
  run.result.estimates["relaxation"] = theta;
  if (run.result.iterations > 0) {
    const auto tangent = run.problem.linearise(run.result.state).matrix;
    const double atSolution = radius(*groupsOf(*tangent, *s0, kAllGroups));
    run.result.estimates["radius"] = atSolution;
    std::ostringstream last;
    last.precision(3);
    last << "successive approximations: radius of S_0^-1 S_KON' at the last contact state " << atSolution;
    run.monitor.note(last.str());
  }
}

namespace {
const Registration<OuterSolver> registrationSuccessiveApproximation("Successive Approximation", SuccessiveApproximation::schema(),
                                                                    [](const Parameters& own) {
                                                                      return std::make_unique<SuccessiveApproximation>(own);
                                                                    });
}  // namespace

}  // namespace suture
