#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Errors.hpp>
#include <suture/monolithic/MonolithicContact.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>
#include <random>

namespace suture {
namespace {

// All solutions of the contact conditions by trying every one of the 2^p active sets on the full saddle point system.
struct Enumerated {
  int solutions = 0;
  Vector x, force;
};

Enumerated enumerate(const CondensedContact& problem) {
  const int n = int(problem.load.size()), p = int(problem.bounds.size());
  Matrix c = Matrix::Zero(p, n);
  for (int i = 0; i < p; ++i)
    for (std::size_t k = 0; k < problem.dofs[i].size(); ++k) c(i, problem.dofs[i][k]) += problem.coefficients[i][k];
  Enumerated found;
  for (int set = 0; set < (1 << p); ++set) {
    std::vector<int> a;
    for (int i = 0; i < p; ++i)
      if (set & (1 << i)) a.push_back(i);
    const int m = int(a.size());
    Matrix saddle = Matrix::Zero(n + m, n + m);
    Vector rhs(n + m);
    saddle.topLeftCorner(n, n) = problem.stiffness;
    saddle.bottomLeftCorner(m, n) = c(a, Eigen::all);
    saddle.topRightCorner(n, m) = c(a, Eigen::all).transpose();
    rhs << problem.load, Vector(problem.bounds(a));
    const Eigen::FullPivLU<Matrix> lu(saddle);
    if (lu.rank() < n + m) continue;
    const Vector solution = lu.solve(rhs);
    Vector force = Vector::Zero(p);
    force(a) = solution.tail(m);
    const Vector x = solution.head(n), gap = problem.bounds - c * x;
    if (force.minCoeff() < -1e-9 || gap.minCoeff() < -1e-9) continue;
    ++found.solutions;
    found.x = x;
    found.force = force;
  }
  return found;
}

// Two bodies of m dofs each, of random stiffness, each tied to the ground with `held` or loose in a random direction; p rows between them.
CondensedContact randomProblem(std::mt19937& random, int m, int p, bool loose, double jump) {
  std::normal_distribution<double> value;
  const auto matrix = [&](int rows, int columns) {
    Matrix a(rows, columns);
    for (double& x : a.reshaped()) x = value(random);
    return a;
  };
  CondensedContact problem;
  problem.blocks = {0, m, 2 * m};
  problem.stiffness = Matrix::Zero(2 * m, 2 * m);
  problem.kernel = Matrix::Zero(2 * m, loose ? 1 : 0);
  for (int body = 0; body < 2; ++body) {
    const Matrix a = matrix(m, m + 2);
    Matrix s = a * a.transpose() + 0.1 * Matrix::Identity(m, m);
    if (body == 1 && loose) {
      Vector z = Vector::Ones(m);  // all rows push the second body the same way: it can be held
      z.normalize();
      const Matrix away = Matrix::Identity(m, m) - z * z.transpose();
      s = away * s * away;
      problem.kernel.col(0).tail(m) = z;
    }
    problem.stiffness.block(body * m, body * m, m, m) = (body == 0 ? jump : 1.0) * s;
  }
  problem.load = matrix(2 * m, 1);
  if (loose) problem.load.tail(m).array() -= problem.load.tail(m).mean() + 0.3;  // pressed against the first
  problem.bounds = 0.3 * matrix(p, 1);
  for (int i = 0; i < p; ++i) {  // u_A - u_B <= gap
    problem.dofs.push_back({i % m, m + (i * 7 + i / m) % m});
    problem.coefficients.push_back({1.0, -1.0});
  }
  return problem;
}

ContactSolution solveQuietly(const CondensedContact& problem, std::vector<char> start = {}) {
  return solveCondensedContact(problem, std::move(start), 1000, [](const ActiveSetStep&) {});
}

TEUCHOS_UNIT_TEST(MonolithicContact, AgreesWithTheEnumerationOfAllActiveSets) {
  std::mt19937 random(1);
  int open = 0, closed = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const int p = 1 + trial % 9;
    const double jump = trial % 3 == 0 ? 1e4 : 1.0;
    const CondensedContact problem = randomProblem(random, 9, p, false, jump);
    const Enumerated expected = enumerate(problem);
    TEST_EQUALITY(expected.solutions, 1);
    const ContactSolution found = solveQuietly(problem);
    TEST_ASSERT(found.converged);
    TEST_COMPARE((found.x - expected.x).norm(), <, 1e-9 * expected.x.norm());
    TEST_COMPARE((found.force - expected.force).norm(), <, 1e-9 * (1 + expected.force.norm()));
    for (int i = 0; i < p; ++i) {
      TEST_EQUALITY(found.active[i] != 0, expected.force[i] > 0);
      (found.active[i] ? closed : open) += 1;
    }
  }
  TEST_COMPARE(std::min(open, closed), >, 100);  // the cases are neither all open nor all closed
}

TEUCHOS_UNIT_TEST(MonolithicContact, AgreesWithTheEnumerationWhenOnlyContactHoldsABody) {
  std::mt19937 random(2);
  int open = 0, closed = 0;
  for (int trial = 0; trial < 120; ++trial) {
    const int p = 1 + trial % 9;
    const CondensedContact problem = randomProblem(random, 9, p, true, trial % 3 == 0 ? 1e4 : 1.0);
    const Enumerated expected = enumerate(problem);
    TEST_EQUALITY(expected.solutions, 1);
    const ContactSolution found = solveQuietly(problem);
    TEST_ASSERT(found.converged);
    if (!found.converged) continue;
    TEST_COMPARE((found.x - expected.x).norm(), <, 1e-9 * expected.x.norm());
    TEST_COMPARE((found.force - expected.force).norm(), <, 1e-9 * (1 + expected.force.norm()));
    for (int i = 0; i < p; ++i) (found.active[i] ? closed : open) += 1;
  }
  TEST_COMPARE(std::min(open, closed), >, 100);
}

TEUCHOS_UNIT_TEST(MonolithicContact, EveryStartLeadsToTheSameSolution) {
  std::mt19937 random(3);
  for (const bool loose : {false, true})
    for (int trial = 0; trial < 20; ++trial) {
      const int p = 8;
      const CondensedContact problem = randomProblem(random, 9, p, loose, 1.0);
      const ContactSolution reference = solveQuietly(problem);
      for (int start = 0; start < 8; ++start) {
        std::vector<char> active(p);
        for (char& a : active) a = char(random() % 2);
        const ContactSolution found = solveQuietly(problem, start == 0 ? std::vector<char>(p, 0) : active);
        TEST_ASSERT(found.converged);
        TEST_COMPARE((found.x - reference.x).norm(), <, 1e-10 * reference.x.norm());
        TEST_ASSERT(found.active == reference.active);
      }
    }
}

TEUCHOS_UNIT_TEST(MonolithicContact, EnergyOfTheLastStepIsThatOfTheSolution) {
  std::mt19937 random(5);
  for (const bool loose : {false, true}) {
    const CondensedContact problem = randomProblem(random, 9, 7, loose, 1.0);
    double energy = 0;
    const ContactSolution found = solveCondensedContact(problem, {}, 1000, [&](const ActiveSetStep& step) { energy = step.energy; });
    const double direct = 0.5 * found.x.dot(problem.stiffness * found.x) - problem.load.dot(found.x);
    TEST_COMPARE(std::abs(energy - direct), <, 1e-11 * std::abs(direct));
  }
}

TEUCHOS_UNIT_TEST(MonolithicContact, SolvesCompliancesFarFromDiagonallyDominant) {
  std::mt19937 random(6);
  std::normal_distribution<double> value;
  for (int trial = 0; trial < 10; ++trial) {
    const int n = 40;
    Matrix a(n, n);
    for (double& x : a.reshaped()) x = value(random);
    CondensedContact problem;
    problem.stiffness = (a * a.transpose() + 1e-3 * Matrix::Identity(n, n)).inverse();
    problem.stiffness = (0.5 * (problem.stiffness + problem.stiffness.transpose())).eval();
    problem.blocks = {0, n};
    problem.kernel.resize(n, 0);
    problem.load.resize(n);
    for (double& f : problem.load) f = value(random);
    problem.bounds = Vector::Zero(n);
    for (int i = 0; i < n; ++i) {
      problem.dofs.push_back({i});
      problem.coefficients.push_back({1.0});
    }
    const ContactSolution found = solveCondensedContact(problem, {}, 100000, [](const ActiveSetStep&) {});
    TEST_ASSERT(found.converged);
    if (!found.converged) continue;
    const Vector residual = problem.stiffness * found.x - problem.load + found.force;
    TEST_COMPARE(residual.norm(), <, 1e-8 * problem.load.norm());
    TEST_COMPARE(found.x.maxCoeff(), <, 1e-9 * found.x.norm());
    TEST_COMPARE(found.force.minCoeff(), >=, 0.0);
    TEST_COMPARE(std::abs(found.force.dot(found.x)), <, 1e-9 * found.force.norm() * found.x.norm());
  }
}

TEUCHOS_UNIT_TEST(MonolithicContact, MeetsNoSetTwiceWhereChangingAllWrongRowsAtOnceCycles) {
  // Example of Curtis, Han and Robinson (2015) for the cycling of primal-dual active sets.
  CondensedContact problem;
  problem.stiffness = (Matrix(3, 3) << 4, 5, -5, 5, 9, -5, -5, -5, 7).finished();
  problem.blocks = {0, 3};
  problem.kernel.resize(3, 0);
  problem.load = (Vector(3) << -2, -1, 3).finished();
  problem.bounds = Vector::Zero(3);
  problem.dofs = {{0}, {1}, {2}};
  problem.coefficients = {{1.0}, {1.0}, {1.0}};
  const Enumerated expected = enumerate(problem);
  int most = 0;
  for (int set = 0; set < 8; ++set) {
    int steps = 0;
    const std::vector<char> start{char(set & 1), char((set >> 1) & 1), char((set >> 2) & 1)};
    const ContactSolution found = solveCondensedContact(problem, start, 100, [&](const ActiveSetStep&) { ++steps; });
    TEST_ASSERT(found.converged);
    TEST_COMPARE((found.x - expected.x).norm(), <, 1e-12);
    most = std::max(most, steps);
  }
  TEST_COMPARE(most, <=, 8);  // no set twice
}

TEUCHOS_UNIT_TEST(MonolithicContact, RowsThatRepeatEachOtherShareTheirForce) {
  CondensedContact problem;
  problem.stiffness = Matrix::Constant(1, 1, 2.0);
  problem.blocks = {0, 1};
  problem.kernel.resize(1, 0);
  problem.load = Vector::Constant(1, 5.0);
  problem.bounds = Vector::Constant(2, 1.0);
  problem.dofs = {{0}, {0}};
  problem.coefficients = {{1.0}, {1.0}};
  const ContactSolution found = solveQuietly(problem);
  TEST_ASSERT(found.converged);
  TEST_FLOATING_EQUALITY(found.x[0], 1.0, 1e-10);
  TEST_FLOATING_EQUALITY(found.force.sum(), 3.0, 1e-10);
}

TEUCHOS_UNIT_TEST(MonolithicContact, NamesTheMotionThatContactDoesNotHold) {
  CondensedContact problem;  // two dofs that move together freely; a row that compares them with each other
  problem.stiffness = (Matrix(2, 2) << 1, -1, -1, 1).finished();
  problem.blocks = {0, 2};
  problem.kernel = Vector::Ones(2).normalized();
  problem.load = Vector::Zero(2);
  problem.bounds = Vector::Constant(1, 0.5);
  problem.dofs = {{0, 1}};
  problem.coefficients = {{1.0, -1.0}};
  const ContactSolution found = solveQuietly(problem);
  TEST_ASSERT(found.converged);
  TEST_ASSERT(found.force.isZero(0.0));
  problem.load = Vector::Ones(2);  // pushes it along that motion
  TEST_THROW(solveQuietly(problem), NumericalError);
}

}  // namespace
}  // namespace suture
