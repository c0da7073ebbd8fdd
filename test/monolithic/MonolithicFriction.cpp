#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/dense/NonnegativeLeastSquares.hpp>
#include <suture/monolithic/MonolithicFriction.hpp>
#include <suture/pairs/FrictionLaws.hpp>

#include <support/DryLaw.hpp>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

namespace suture {
namespace {

using scenes::dry;
using LawPtr = std::shared_ptr<const ContactLaw>;

/// A user's law: the bound of the tangential force is a root of the normal one, with its derivative as the state's friction.
class Rooted : public ContactLaw {
 protected:
  bool doRestrictsSliding() const override { return true; }
  ContactState doProject(const ContactTrial& trial, const ContactState& now) const override {
    const double normal = trial.force[0] + trial.jump[0];
    if (normal < 0.0 || (normal == 0.0 && !now.closed())) return PairStatus::Open;
    const double root = std::sqrt(1.0 + normal), largest = 0.4 * (root - 1.0), slope = 0.2 / root;
    const double t1 = trial.force[1] + trial.jump[1], t2 = trial.force[2] + trial.jump[2], size = std::hypot(t1, t2);
    if (size <= largest) return PairStatus::Stick;
    return {PairStatus::Slip, Point{0, t1 / size, t2 / size}, largest - slope * normal, slope};
  }
};

/// Two random bodies with a frame at each of their `nodes`, one of them on the ground; the other too, or free to move.
struct Random {
  CondensedContact problem;
  std::vector<LawPtr> laws;

  Random(std::mt19937& random, int dimension, int nodes, bool loose, const std::vector<LawPtr>& choice, int repeated = 0) {
    std::normal_distribution<double> value;
    const auto matrix = [&](int rows, int columns) {
      Matrix a(rows, columns);
      for (double& x : a.reshaped()) x = value(random);
      return a;
    };
    const int m = nodes * dimension;
    problem.blocks = {0, m, 2 * m};
    problem.stiffness = Matrix::Zero(2 * m, 2 * m);
    problem.kernel = Matrix::Zero(2 * m, loose ? dimension : 0);
    for (int body = 0; body < 2; ++body) {
      const Matrix a = matrix(m, m + 2);
      Matrix s = a * a.transpose() + 3.0 * m * Matrix::Identity(m, m);
      if (body == 1 && loose) {
        Matrix z = Matrix::Zero(m, dimension);  // translations
        for (int i = 0; i < m; ++i) z(i, i % dimension) = 1.0 / std::sqrt(double(nodes));
        const Matrix away = Matrix::Identity(m, m) - z * z.transpose();
        s = (away * s * away).eval();
        problem.kernel.bottomRows(m) = z;
      }
      problem.stiffness.block(body * m, body * m, m, m) = s / m;
    }
    problem.load = matrix(2 * m, 1);
    problem.surfaces = dimension == 3;
    std::vector<double> bounds;
    for (int node = 0; node < nodes; ++node) {
      // The normal: the last axis, slightly rotated.
      Matrix frame = 0.2 * matrix(dimension, dimension);
      for (int k = 0; k < dimension; ++k) frame(k, (k + dimension - 1) % dimension) += 1.0;
      const Matrix q = Eigen::HouseholderQR<Matrix>(frame.transpose()).householderQ();
      for (int copy = 0; copy <= (node < repeated ? 1 : 0); ++copy) {
        laws.push_back(choice[(node + copy) % choice.size()]);
        const int rows = laws.back()->rows(dimension);
        problem.pairs.push_back({int(bounds.size()), rows, laws.back().get(), {0, 0, 0}, 1.0});
        for (int k = 0; k < rows; ++k) {
          problem.dofs.emplace_back();
          problem.coefficients.emplace_back();
          const double sign = k == 0 && q(dimension - 1, 0) < 0.0 ? -1.0 : 1.0;
          for (const int body : {0, 1})
            for (int c = 0; c < dimension; ++c) {
              problem.dofs.back().push_back(body * m + node * dimension + c);
              problem.coefficients.back().push_back((body == 0 ? 1.0 : -1.0) * sign * q(c, k));
            }
          bounds.push_back(k > 0 ? 0.0 : copy == 1 ? bounds[problem.pairs[problem.pairs.size() - 2].first] : 0.2 * value(random));
        }
      }
    }
    problem.bounds = Eigen::Map<Vector>(bounds.data(), Eigen::Index(bounds.size()));
    if (loose)  // pressed on the first: the sum exceeds the tangential pull
      for (int node = 0; node < nodes; ++node) problem.load[m + node * dimension + dimension - 1] -= 4.0;
  }
};

/// Largest violation of the conditions of a solution, each separately: the solver's equations are not used.
double violation(const CondensedContact& problem, const ContactSolution& found) {
  Vector forces = problem.stiffness * found.x - problem.load, gap = problem.bounds;
  for (Eigen::Index i = 0; i < gap.size(); ++i)
    for (std::size_t k = 0; k < problem.dofs[i].size(); ++k) {
      forces[problem.dofs[i][k]] += problem.coefficients[i][k] * found.force[i];
      gap[i] -= problem.coefficients[i][k] * found.x[problem.dofs[i][k]];
    }
  double worst = forces.cwiseAbs().maxCoeff();
  const auto atMost = [&](double value, double bound) { worst = std::max(worst, value - bound); };
  for (std::size_t p = 0; p < problem.pairs.size(); ++p) {
    const CondensedContact::Pair& pair = problem.pairs[p];
    const ContactState& state = found.states[p];
    const double normal = found.force[pair.first];
    if (pair.law->separates()) {
      atMost(-normal, 0.0);
      atMost(-gap[pair.first], 0.0);
      atMost(std::abs(normal * gap[pair.first]), 0.0);
    } else {
      atMost(std::abs(gap[pair.first]), 0.0);
    }
    if (pair.rows == 1) continue;
    const Vector tangential = found.force.segment(pair.first + 1, pair.rows - 1), slip = -gap.segment(pair.first + 1, pair.rows - 1);
    if (!pair.law->separates()) {
      atMost(slip.norm(), 0.0);
      continue;
    }
    // The bound from a trial that certainly slides, at the computed normal force.
    ContactTrial trial;
    trial.size = 1.0;
    trial.force[0] = normal;
    trial.jump[1] = 1e10;
    const double bound = state.closed() ? pair.law->project(trial, PairStatus::Slip).largest(normal) : 0.0;
    atMost(tangential.norm(), bound);
    atMost(std::abs(tangential.dot(slip) - bound * slip.norm()), 0.0);  // equals the bound where the pair slips, along the slip
    if (state.status == PairStatus::Stick) atMost(slip.norm(), 0.0);
  }
  return worst;
}

struct Counts {
  int solved = 0, open = 0, slip = 0, stick = 0;
  double worst = 0.0, contraction = 0.0;

  void add(const CondensedContact& problem, const ContactSolution& found) {
    if (!found.converged) return;
    ++solved;
    worst = std::max(worst, violation(problem, found));
    contraction = std::max(contraction, found.contraction);
    for (const ContactState& state : found.states)
      ++(state.status == PairStatus::Open ? open : state.status == PairStatus::Slip ? slip : stick);
  }
};

ContactSolution solved(const CondensedContact& problem) {
  return solveFriction(problem, {}, 1000, [](const ActiveSetStep&) {});
}

/// True if forces inside the cones of Coulomb's laws balance the loads of a loose body; rigid-body statics decides.
bool canHold(const CondensedContact& problem) {
  constexpr int edges = 64;
  std::vector<Vector> generators;
  for (const CondensedContact::Pair& pair : problem.pairs) {
    Matrix rows = Matrix::Zero(pair.rows, problem.kernel.cols());
    for (int k = 0; k < pair.rows; ++k)
      for (std::size_t d = 0; d < problem.dofs[pair.first + k].size(); ++d)
        rows.row(k) += problem.coefficients[pair.first + k][d] * problem.kernel.row(problem.dofs[pair.first + k][d]);
    ContactTrial trial;
    trial.size = 1.0;
    trial.force[0] = 1.0;
    trial.jump[1] = 1e10;
    const double mu = pair.law->project(trial, PairStatus::Slip).friction;
    for (int edge = 0; edge < edges; ++edge) {
      Vector force = Vector::Zero(pair.rows);
      force[0] = 1.0;
      const double angle = 2.0 * M_PI * edge / edges;
      if (pair.rows == 2) force[1] = edge % 2 == 0 ? mu : -mu;
      if (pair.rows == 3) force.tail(2) << mu * std::cos(angle), mu * std::sin(angle);
      generators.push_back(rows.transpose() * force);
    }
  }
  Matrix all(problem.kernel.cols(), Eigen::Index(generators.size()));
  for (std::size_t g = 0; g < generators.size(); ++g) all.col(Eigen::Index(g)) = generators[g];
  const Vector work = problem.kernel.transpose() * problem.load;
  return (all * nonnegativeLeastSquares(all, work) - work).norm() < 1e-10 * work.norm();
}

/// 2D solutions by trying every combination of states (open, stuck, slipping either way): linear equations each.
std::vector<Vector> enumeratedForces(const CondensedContact& problem) {
  const int n = int(problem.load.size()), rows = int(problem.bounds.size()), m = int(problem.pairs.size());
  Matrix c = Matrix::Zero(rows, n);
  for (int i = 0; i < rows; ++i)
    for (std::size_t k = 0; k < problem.dofs[i].size(); ++k) c(i, problem.dofs[i][k]) += problem.coefficients[i][k];
  std::vector<Vector> found;
  for (int code = 0; code < (1 << (2 * m)); ++code) {
    Matrix a = Matrix::Zero(n + rows, n + rows);
    Vector b(n + rows);
    a.topLeftCorner(n, n) = problem.stiffness;
    a.topRightCorner(n, rows) = c.transpose();
    b.head(n) = problem.load;
    std::vector<double> cohesion(m), friction(m);
    for (int p = 0; p < m; ++p) {
      const int state = code >> (2 * p) & 3, normal = problem.pairs[p].first, tangent = normal + 1;
      ContactTrial trial;
      trial.size = 1.0;
      trial.force[0] = 1.0;
      trial.jump[1] = 1e10;
      const ContactState slips = problem.pairs[p].law->project(trial, PairStatus::Slip);
      cohesion[p] = slips.bound, friction[p] = slips.friction;
      const auto noForce = [&](int row) { a(n + row, n + row) = 1.0, b[n + row] = 0.0; };
      const auto noJump = [&](int row) { a.row(n + row).head(n) = c.row(row), b[n + row] = problem.bounds[row]; };
      state == 0 ? noForce(normal) : noJump(normal);
      if (state == 0) noForce(tangent);
      if (state == 1) noJump(tangent);
      if (state < 2) continue;
      const double sign = state == 2 ? 1.0 : -1.0;
      a(n + tangent, n + tangent) = 1.0;
      a(n + tangent, n + normal) = -sign * friction[p];
      b[n + tangent] = sign * cohesion[p];
    }
    const Eigen::FullPivLU<Matrix> lu(a);
    if (lu.rank() < n + rows) continue;
    const Vector x = lu.solve(b), force = x.tail(rows), jump = c * x.head(n) - problem.bounds;
    bool holds = true;
    for (int p = 0; p < m; ++p) {
      const int state = code >> (2 * p) & 3, normal = problem.pairs[p].first, tangent = normal + 1;
      holds = holds && force[normal] > -1e-9 && jump[normal] < 1e-9 &&
              std::abs(force[tangent]) < (state == 0 ? 0.0 : cohesion[p] + friction[p] * force[normal]) + 1e-9 &&
              (state < 2 || jump[tangent] * force[tangent] > -1e-9);
    }
    if (holds) found.push_back(force);
  }
  return found;
}

TEUCHOS_UNIT_TEST(MonolithicFriction, AgreesWithTheEnumerationOfAllStates) {
  std::mt19937 random(5);
  int solutions = 0, none = 0;
  for (int trial = 0; trial < 80; ++trial) {
    const LawPtr laws[] = {dry(0, 0.3), dry(0, 0.8), dry(0.1, 0.4), dry(0.2, 0.0)};
    const Random given(random, 2, 2 + trial % 4, trial % 5 == 0, {laws[trial % 4]});
    const std::vector<Vector> expected = enumeratedForces(given.problem);
    const ContactSolution found = solved(given.problem);
    if (found.converged != !expected.empty()) out << "trial " << trial << " solutions " << expected.size() << " " << found.failure << "\n";
    TEST_EQUALITY(found.converged, !expected.empty());
    (expected.empty() ? none : solutions) += 1;
    if (!found.converged) continue;
    double nearest = 1e300;
    for (const Vector& force : expected) nearest = std::min(nearest, (force - found.force).norm());
    TEST_COMPARE(nearest, <, 1e-9 * (1.0 + found.force.norm()));
  }
  TEST_COMPARE(solutions, >, 60);
  TEST_COMPARE(none, >, 0);  // that there is none is detected, too
}

TEUCHOS_UNIT_TEST(MonolithicFriction, FulfilsTheConditionsOfRandomProblems) {
  std::mt19937 random(1);
  const LawPtr tied = std::make_shared<Tied>(), bonded = std::make_shared<NoSeparation>(), smooth = std::make_shared<Frictionless>(),
               rooted = std::make_shared<Rooted>();
  // Cohesion on bodies that are held: a bound without pressure that is lost where a pair opens leaves some problems without solution.
  const std::vector<std::vector<LawPtr>> choices{
      {dry(0, 0.3)},   {dry(0, 0.6), dry(0, 0.1)},        {dry(0, 0.3), tied, bonded, smooth}, {rooted},
      {dry(0.1, 0.4)}, {dry(0.3, 0.2), dry(0, 0), rooted}};
  for (const int dimension : {2, 3}) {
    Counts counts;
    int expected = 0;
    for (int trial = 0; trial < 120; ++trial) {
      const std::size_t choice = trial % choices.size();
      const bool loose = choice < 3 && trial % 4 == 0;
      const Random given(random, dimension, 3 + trial % 7, loose, choices[choice]);
      if (loose && choice < 2 && !canHold(given.problem)) continue;
      ++expected;
      const int before = counts.solved;
      counts.add(given.problem, solved(given.problem));
      if (counts.solved == before) out << "not solved: trial " << trial << "\n";
    }
    TEST_EQUALITY(counts.solved, expected);
    TEST_COMPARE(expected, >, 110);
    TEST_COMPARE(counts.worst, <, 1e-9);
    TEST_COMPARE(std::min({counts.open, counts.slip, counts.stick}), >, 50);  // no state is rare
  }
}

TEUCHOS_UNIT_TEST(MonolithicFriction, RowsThatRepeatEachOtherShareTheirForce) {
  std::mt19937 random(3);
  for (const int dimension : {2, 3})
    for (const LawPtr& law : {dry(0, 0.3), LawPtr(std::make_shared<Tied>())}) {
      Counts counts;
      int expected = 0;
      for (int trial = 0; trial < 20; ++trial) {
        const Random given(random, dimension, 4, trial % 2 == 0, {law}, 2);
        if (trial % 2 == 0 && law->separates() && !canHold(given.problem)) continue;
        ++expected;
        counts.add(given.problem, solved(given.problem));
      }
      TEST_EQUALITY(counts.solved, expected);
      TEST_COMPARE(counts.worst, <, 1e-8);
    }
}

TEUCHOS_UNIT_TEST(MonolithicFriction, StatesToStartFromLeadToTheSameSolution) {
  std::mt19937 random(4);
  for (int trial = 0; trial < 30; ++trial) {
    const Random given(random, 2 + trial % 2, 5, trial % 3 == 0, {dry(0, 0.3)});
    const ContactSolution cold = solved(given.problem);
    int steps = 0;
    const ContactSolution warm = solveFriction(given.problem, cold.states, 100, [&](const ActiveSetStep&) { ++steps; });
    const ContactSolution other =
        solveFriction(given.problem, std::vector<ContactState>(5, PairStatus::Stick), 100, [](const ActiveSetStep&) {});
    TEST_COMPARE((warm.force - cold.force).norm(), <, 1e-9 * (1.0 + cold.force.norm()));
    TEST_COMPARE((other.force - cold.force).norm(), <, 1e-9 * (1.0 + cold.force.norm()));
    if (given.problem.pairs.front().rows == 2) TEST_COMPARE(steps, <=, 1);  // in 2D the states are linear equations
  }
}

TEUCHOS_UNIT_TEST(MonolithicFriction, FindsThatABodySlidesAway) {
  // one block of two nodes, pressed down by 1 on each: friction carries 2 mu
  for (const double along : {0.5, 0.7}) {
    CondensedContact problem;
    problem.blocks = {0, 4};
    Vector stretch(4);
    stretch << 1, 0, -1, 0;
    problem.stiffness = stretch * stretch.transpose();
    problem.kernel = Matrix::Zero(4, 3);
    problem.kernel.col(0) << std::sqrt(0.5), 0, std::sqrt(0.5), 0;
    problem.kernel(1, 1) = problem.kernel(3, 2) = 1.0;
    problem.load = Vector(4);
    problem.load << along, -1, 0, -1;
    problem.bounds = Vector::Zero(4);
    const LawPtr law = dry(0, 0.3);
    for (const int node : {0, 1}) {
      problem.pairs.push_back({2 * node, 2, law.get(), {0, 0, 0}, 1.0});
      for (const int k : {1, 0}) {
        problem.dofs.push_back({2 * node + k});
        problem.coefficients.push_back({k == 1 ? -1.0 : 1.0});
      }
    }
    const ContactSolution found = solved(problem);
    TEST_EQUALITY(found.converged, along < 0.6);
    TEST_EQUALITY(found.slides.size() > 0, along > 0.6);
    if (found.converged) {
      TEST_FLOATING_EQUALITY(found.force[1] + found.force[3], along, 1e-11);
    } else {
      TEST_FLOATING_EQUALITY(found.slides[0], found.slides[2], 1e-6);
      TEST_COMPARE(found.slides[0], >, 0.0);
    }
  }
}

}  // namespace
}  // namespace suture
