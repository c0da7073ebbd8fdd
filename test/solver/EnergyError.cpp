// The error of conjugate gradients in the energy norm, estimated from their coefficients, against the true one.
#include <suture/solver/accuracy/EnergyError.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <Tpetra_MultiVector.hpp>
#include <solver/ContactMethods.hpp>

namespace suture {
namespace {

using namespace blocks;

// Conjugate gradients on a dense matrix, as published; the error of every iterate is known.
struct Textbook {
  std::vector<double> norms, steps, errors;

  Textbook(const Matrix& a, const Matrix& m, const Vector& b, int iterations) {
    const Vector solution = solveSymmetric(a, b);
    Vector x = Vector::Zero(b.size()), r = b, z = m * r, p = z;
    const auto keep = [&] {
      norms.push_back(std::sqrt(r.dot(z)));
      errors.push_back(std::sqrt((solution - x).dot(a * (solution - x))));
    };
    keep();
    for (int k = 0; k < iterations; ++k) {
      const double before = r.dot(z), step = before / p.dot(a * p);
      x += step * p;
      r -= step * (a * p);
      z = m * r;
      p = z + r.dot(z) / before * p;
      steps.push_back(step);
      keep();
    }
  }
};

TEUCHOS_UNIT_TEST(EnergyError, IsAnUpperBoundAndExactForWhatIsBehind) {
  const int n = 40;
  const Matrix q = orthogonal(random(n, n));
  Vector eigenvalues(n);
  for (int i = 0; i < n; ++i) eigenvalues(i) = 1.0 + 30.0 * i * i / double(n * n);
  const Matrix a = q * eigenvalues.asDiagonal() * q.transpose();
  const Textbook run(a, Matrix::Identity(n, n), random(n, 1, 3), 15);
  const RitzValues ritz = ritzValues(run.norms, run.steps);
  TEST_COMPARE(ritz.smallest, >, 1.0 - 1e-10);
  TEST_COMPARE(ritz.smallest, <, 1.2);
  TEST_COMPARE(ritz.largest, <, eigenvalues(n - 1) + 1e-10);
  TEST_COMPARE(ritz.largest, >, 0.9 * eigenvalues(n - 1));
  const std::vector<double> bound = energyErrors(run.norms, run.steps, 1.0 - 1e-12);
  TEST_EQUALITY(bound.size(), run.errors.size());
  for (std::size_t k = 0; k < bound.size(); ++k) {
    TEST_COMPARE(bound[k], >, (1 - 1e-9) * run.errors[k]);
    TEST_COMPARE(bound[k], <, 1.5 * run.errors[k]);
    // Hestenes and Stiefel: the energy gained by the iterations in between.
    const double known = bound[k] * bound[k] - bound.back() * bound.back();
    const double truth = run.errors[k] * run.errors[k] - run.errors.back() * run.errors.back();
    TEST_COMPARE(std::abs(known - truth), <, 1e-10 * run.errors[0] * run.errors[0]);
  }
}

double energyNorm(const InterfaceOperator& matrix, const MultiVector& x) {
  const MultiVectorPtr image = matrix.space()->vector();
  matrix.apply(x, *image);
  return std::sqrt(dot(x, *image));
}

TEUCHOS_UNIT_TEST(EnergyError, FollowsTheTrueErrorOfEveryPreconditioner) {
  Scene scene = clampedSquare(4, 8);
  scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.3, -1.0, 0}});
  const OnInterface one(scene, world());
  Monitor silent;
  for (const char* name : {"BDDC", "Neumann-Neumann"}) {
    const auto linear = one.problem.linearise(one.problem.initialState());
    const auto made = preconditioner(name)();
    made->initialize(linear.matrix->space());
    made->compute(linear.matrix);
    const MultiVectorPtr solution = one.problem.space()->vector();
    InnerSolver(200).solve(linear.matrix, made, *linear.load, *solution, 1e-13, 0.0, silent);
    for (const double tolerance : {0.3, 1e-1, 1e-2, 1e-3, 1e-5, 1e-7}) {
      const MultiVectorPtr x = one.problem.space()->vector();
      const InnerResult result = InnerSolver(200).solve(linear.matrix, made, *linear.load, *x, tolerance, 0.0, silent);
      TEST_EQUALITY(result.energyErrors.size(), std::size_t(result.pcg + 1));
      TEST_FLOATING_EQUALITY(result.energyErrors.front(), energyNorm(*linear.matrix, *solution), 0.1 * tolerance);
      x->update(-1.0, *solution, 1.0);
      const double truth = energyNorm(*linear.matrix, *x);
      out << name << ", " << tolerance << ": " << result.pcg << " iterations, estimate over truth " << result.energyErrors.back() / truth
          << "\n";
      TEST_COMPARE(result.energyErrors.back(), >, 0.9 * truth);
      TEST_COMPARE(result.energyErrors.back(), <, 1.6 * truth);
    }
  }
}

TEUCHOS_UNIT_TEST(EnergyError, EndsASolveWhereItIsSmallEnough) {
  Scene scene = clampedSquare(4, 8);
  scene.model.loads.push_back({Load::Kind::BodyForce, "", {0.3, -1.0, 0}});
  const OnInterface one(scene, world());
  Monitor silent;
  const auto linear = one.problem.linearise(one.problem.initialState());
  const auto made = preconditioner("BDDC")();
  made->initialize(linear.matrix->space());
  made->compute(linear.matrix);
  const MultiVectorPtr x = one.problem.space()->vector();
  const InnerResult whole = InnerSolver(200).solve(linear.matrix, made, *linear.load, *x, 1e-10, 0.0, silent);
  const double target = 1e-3 * whole.energyErrors.front();
  EnergyCriterion criterion;
  criterion.enough = [&](double start, double error, const MultiVector& now) {
    TEST_COMPARE(start, >=, error);
    // The reported gain of an iterate is exact: |x|^2 = |x - 0|^2 - |error|^2.
    const double norm = energyNorm(*linear.matrix, now);
    const double truth = std::sqrt(std::max(std::pow(whole.energyErrors.front(), 2) - norm * norm, 0.0));
    TEST_COMPARE(std::abs(error - truth), <, 0.6 * truth + 1e-7 * whole.energyErrors.front());
    return error <= target;
  };
  const InnerResult result = InnerSolver(200).solve(linear.matrix, made, *linear.load, *x, 1e-10, 0.0, silent, criterion);
  TEST_ASSERT(result.converged && result.enough);
  TEST_COMPARE(result.pcg, <, whole.pcg);
  TEST_COMPARE(whole.energyErrors[result.pcg], <, target);
  TEST_COMPARE(whole.energyErrors[result.pcg - 1], >, 0.9 * target);
}

}  // namespace
}  // namespace suture
