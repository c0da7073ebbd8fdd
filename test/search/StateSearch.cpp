#include <support/CondensedBody.hpp>

#include <suture/search/StateSearch.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <support/LinearComplementarity.hpp>

namespace suture {
namespace {

using scenes::dry;

TEUCHOS_UNIT_TEST(StateSearch, SolvesRandomProblemsOfAllLaws) {
  std::mt19937 random(11);
  const SearchLaw tied = std::make_shared<Tied>(), guided = std::make_shared<NoSeparation>(), smooth = std::make_shared<Frictionless>();
  const std::vector<std::vector<SearchLaw>> choices{{dry(0, 0.1)},
                                                    {dry(0, 0.3)},
                                                    {dry(0.2, 0.0)},
                                                    {dry(0.1, 0.2), dry(0.0, 0.0)},
                                                    {dry(0, 0.3), tied, guided, smooth},
                                                    {dry(0, 0.3), smooth, dry(0.3, 0.0)},
                                                    {tied, smooth, guided, smooth}};
  int solved = 0, most = 0, open = 0, slip = 0, stick = 0;
  double worst = 0.0;
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<SearchLaw>& laws = choices[trial % choices.size()];
    CondensedBody body(2 + trial % 2, 3 + trial % 8);
    body.random(random, false);
    // Cohesion is lost where a pair opens, which leaves problems without solution: pressed together.
    const std::size_t choice = trial % choices.size();
    if (choice == 2 || choice == 3 || choice == 5)
      for (int i = 0; i < body.nodes; ++i) body.load(body.dimension * i) += 3.0;
    std::vector<int> lines;
    for (int i = 0; i < body.nodes; ++i) lines.push_back(i % int(laws.size()));
    body.begin(laws, lines);
    StateSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const StateSearch::Result found =
        search.run(trial % 3 == 0 ? search.start() : body.all(trial % 4 == 0 ? PairStatus::Slip : PairStatus::Stick));
    TEST_EQUALITY(found.solves, body.solves);
    TEST_ASSERT(!body.strange);
    solved += found.converged;
    if (!found.converged)
      out << "trial " << trial << ": " << found.alternating.size() << " pairs alternate, slides " << found.slides.size() << "\n";
    if (!found.converged) continue;
    worst = std::max(worst, body.violation());
    if (body.violation() > 1e-8) out << "trial " << trial << ": violates by " << body.violation() << "\n";
    most = std::max(most, found.solves);
    for (const ContactState& state : found.states)
      ++(state.status == PairStatus::Open ? open : state.status == PairStatus::Slip ? slip : stick);
  }
  out << "most solves " << most << ", open " << open << ", slip " << slip << ", stick " << stick << ", worst " << worst << "\n";
  TEST_EQUALITY(solved, 300);
  TEST_COMPARE(worst, <, 1e-8);
  TEST_COMPARE(std::min({open, slip, stick}), >, 100);
}

// Loads inside the cones hold a body that nothing else holds.
TEUCHOS_UNIT_TEST(StateSearch, HoldsLooseBodiesByFriction) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  int solved = 0;
  double worst = 0.0;
  for (int trial = 0; trial < 100; ++trial) {
    const double mu = 0.05 + 0.25 * std::abs(value(random));
    CondensedBody body(2 + trial % 2, 3 + trial % 6);
    body.random(random, true);
    for (double& x : body.gap) x *= 0.05;
    // Force sums inside nine tenths of the cone, spread over the nodes; self-balanced forces between nodes stay.
    const Vector sums = body.kernel.transpose() * body.load;
    body.load -= body.kernel * sums / body.nodes;
    body.load *= 0.3;
    const double along = 0.9 * mu * std::abs(value(random)), angle = M_PI * value(random);
    for (int i = 0; i < body.nodes; ++i) {
      body.load(body.dimension * i) += 2.0;
      body.load(body.dimension * i + 1) += 2.0 * along * (body.dimension == 2 ? 1.0 : std::cos(angle));
      if (body.dimension == 3) body.load(3 * i + 2) += 2.0 * along * std::sin(angle);
    }
    body.begin({dry(0.0, mu)}, std::vector<int>(body.nodes, 0));
    StateSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const StateSearch::Result found = search.run(body.all(PairStatus::Stick));
    solved += found.converged;
    if (!found.converged)
      out << "trial " << trial << " mu " << mu << ": " << found.alternating.size() << " alternate, slides " << found.slides.size() << "\n";
    if (!found.converged) continue;
    worst = std::max(worst, body.violation());
  }
  TEST_EQUALITY(solved, 100);
  TEST_COMPARE(worst, <, 1e-8);
}

TEUCHOS_UNIT_TEST(StateSearch, SaysThatABodySlidesAway) {
  std::mt19937 random(13);
  for (const int dimension : {2, 3})
    for (const SearchLaw& law : {dry(0.0, 0.3), dry(0.6, 0.0)})  // both carry .6 per node under a normal force of 2
      for (const double push : {0.55, 0.65, 3.0})
        for (int trial = 0; trial < 5; ++trial) {
          CondensedBody body(dimension, 4);
          body.random(random, true);
          body.gap.setZero();
          body.load.setZero();
          for (int i = 0; i < body.nodes; ++i) {
            body.load(dimension * i) = 2.0;
            body.load(dimension * i + 1) = push * (dimension == 2 ? 1.0 : 0.8);
            if (dimension == 3) body.load(3 * i + 2) = -push * 0.6;
          }
          body.begin({law}, std::vector<int>(4, 0));
          StateSearch search(*body.rigid, body.laws, body.sites, body, 200);
          const StateSearch::Result found = search.run(body.all(PairStatus::Stick));
          TEST_EQUALITY(found.converged, push < 0.6);
          TEST_EQUALITY(found.slides.size() > 0, push > 0.6);
          if (found.slides.size() == 0) continue;
          // Along the push: 3/5 and 4/5 in 3D, either sign.
          TEST_EQUALITY(found.slides.size(), dimension);
          const Vector way = found.slides.normalized();
          TEST_COMPARE(std::abs(way(0)), <, 1e-8);
          if (dimension == 2) TEST_FLOATING_EQUALITY(std::abs(way(1)), 1.0, 1e-8);
          if (dimension == 3) TEST_COMPARE(std::abs(0.8 * way(1) - 0.6 * way(2)), >, 0.98);
        }
}

/// True if Lemke's pivots find forces and displacements that satisfy Coulomb's law of a held body in 2D, by the complementarity problem
///     0 <= f_n | gap - u_n >= 0,    0 <= f_+- | s -+ u_t >= 0,    0 <= s | mu f_n - f_+ - f_- >= 0,    u = K^-1 (load - f).
bool lemkeSolves(const CondensedBody& body, double mu) {
  const Eigen::Index n = body.nodes, forces = 3 * n;
  Matrix directions = Matrix::Zero(2 * n, forces);
  for (Eigen::Index i = 0; i < n; ++i) {
    directions(2 * i, 3 * i) = 1.0;
    directions(2 * i + 1, 3 * i + 1) = 1.0;
    directions(2 * i + 1, 3 * i + 2) = -1.0;
  }
  const Matrix compliance = dense::inverse(body.stiffness);
  Matrix m = Matrix::Zero(forces + n, forces + n);
  Vector q = Vector::Zero(forces + n);
  m.topLeftCorner(forces, forces) = directions.transpose() * compliance * directions;
  q.head(forces) = -directions.transpose() * compliance * body.load;
  for (Eigen::Index i = 0; i < n; ++i) {
    q(3 * i) += body.gap(i);
    m(3 * i + 1, forces + i) = m(3 * i + 2, forces + i) = 1.0;
    m(forces + i, 3 * i) = mu;
    m(forces + i, 3 * i + 1) = m(forces + i, 3 * i + 2) = -1.0;
  }
  return linearComplementarity(m, q).has_value();
}

// Twelve pairs have too many states to try them all; Lemke's pivots find a solution for any friction.
TEUCHOS_UNIT_TEST(StateSearch, SolvesWhatLemkesPivotsSolve) {
  std::mt19937 random(41);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  int both = 0, most = 0, slips = 0;
  double worst = 0.0;
  for (int trial = 0; trial < 60; ++trial) {
    const double mu = 0.1 + 1.2 * std::abs(value(random));
    CondensedBody body(2, 12);
    body.random(random, false);
    const Matrix root = Matrix::NullaryExpr(24, 26, [&] { return value(random); });
    body.stiffness = root * root.transpose() + 0.2 * Matrix::Identity(24, 24);  // coupling as strong as the diagonal
    body.begin({dry(0.0, mu)}, std::vector<int>(12, 0));
    StateSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const StateSearch::Result found = search.run(search.start());
    const bool lemke = lemkeSolves(body, mu);
    TEST_ASSERT(lemke);  // a held body always has a solution
    both += lemke && found.converged;
    if (!found.converged) continue;
    most = std::max(most, found.solves);
    worst = std::max(worst, body.violation());
    for (const ContactState& state : found.states) slips += state.status == PairStatus::Slip;
  }
  out << both << " of 60 solved, in " << most << " solves at most, worst " << worst << ", " << slips << " slip\n";
  TEST_EQUALITY(both, 60);
  TEST_COMPARE(worst, <, 1e-7);
  TEST_COMPARE(slips, >, 50);
}

/// Solves whose displacements and forces of the first pair are wrong by more than their tolerance says, towards an open pair.
struct RoughBody : CondensedBody {
  using CondensedBody::CondensedBody;
  double loosest() const override { return 1e-2; }
  double tightest() const override { return 1e-8; }
  ContactAnswer solve(const PairStates& states, double tolerance) override {
    ContactAnswer answer = CondensedBody::solve(states, tolerance);
    if (tolerance <= tightest()) return answer;
    answer.jump(0, 0) -= states[0].closed() ? 0.0 : 2.0 * tolerance;
    answer.force(0, 0) -= states[0].closed() ? 2.0 * tolerance : 0.0;
    return answer;
  }
};

// Inaccurate solves find a pair open that accurate ones find closed. They are not asked again and again.
TEUCHOS_UNIT_TEST(StateSearch, DoesNotReturnToWhatAnAccurateSolveDisproved) {
  for (const int dimension : {2, 3})
    for (const double penetrates : {1e-5, 1e-6, 1e-7}) {
      RoughBody body(dimension, 2);
      body.stiffness = Matrix::Identity(2 * dimension, 2 * dimension);
      body.load.setZero();
      body.load(0) = penetrates;
      body.load(dimension) = 1.0;
      body.begin({dry(0.0, 0.3)}, {0, 0});
      StateSearch search(*body.rigid, body.laws, body.sites, body, 60);
      const StateSearch::Result found = search.run(search.start());
      out << penetrates << ": " << found.solves << " solves\n";
      TEST_ASSERT(found.converged);
      TEST_ASSERT(found.states[0].closed() && found.states[1].closed());
      TEST_COMPARE(found.solves, <=, 16);
    }
}

// A pair that opens loses its cohesion at once: there may be no solution. All 4^n states of n pairs are tried.
TEUCHOS_UNIT_TEST(StateSearch, FindsASolutionWithCohesionWhereThereIsOne) {
  std::mt19937 random(15);
  const double cohesion = 0.4, mu = 0.3;
  int solvable = 0, solved = 0, opens = 0;
  for (int trial = 0; trial < 60; ++trial) {
    CondensedBody body(2, 4);
    body.random(random, false);
    body.begin({dry(cohesion, mu)}, std::vector<int>(4, 0));
    int solutions = 0;
    for (int number = 0; number < 256; ++number)
      solutions += body.solve(statesOfNumber(number, 4, cohesion, mu), 0).solved && body.violation() < 1e-8;
    StateSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const StateSearch::Result found = search.run(body.all(PairStatus::Stick));
    TEST_ASSERT(!found.converged || body.violation() < 1e-8);
    TEST_ASSERT(!found.converged || solutions > 0);
    solvable += solutions > 0;
    solved += found.converged;
    for (const ContactState& state : found.states) opens += !state.closed();
  }
  out << solvable << " of 60 have a solution, " << solved << " were found\n";
  TEST_EQUALITY(solved, solvable);
  TEST_COMPARE(solvable, >, 30);
  TEST_COMPARE(opens, >, 30);
}

// A ball between two plates: the pairs at its poles stick, and do not resist its rotation about the line through them. The others are open;
// a rotation by thousands of gaps would close them.
TEUCHOS_UNIT_TEST(StateSearch, LeavesABodyThatCanTurnWhereItIs) {
  std::mt19937 random(18);
  for (int trial = 0; trial < 20; ++trial) {
    const int dimension = 2 + trial % 2;
    CondensedBody body(dimension, 6);
    body.random(random, false);
    body.kernel = Matrix::Zero(6 * dimension, 1);
    for (int i = 2; i < 6; ++i) {
      body.kernel(dimension * i, 0) = i % 2 == 0 ? 1e-3 : -1e-3;  // facets
      body.kernel(dimension * i + 1, 0) = 1.0;
      body.gap(i) = 10.0;
    }
    const Matrix away = Matrix::Identity(6 * dimension, 6 * dimension) - body.kernel * body.kernel.transpose() / body.kernel.squaredNorm();
    body.stiffness = (away * body.stiffness * away).eval();
    body.load = (away * body.load).eval();
    for (int i = 0; i < 2; ++i) body.gap(i) = 0.0, body.load(dimension * i) = 50.0;
    body.begin({dry(0.0, 0.8)}, std::vector<int>(6, 0));
    StateSearch search(*body.rigid, body.laws, body.sites, body, 100);
    const StateSearch::Result found = search.run(search.start());
    TEST_ASSERT(found.converged);
    TEST_COMPARE(body.violation(), <, 1e-8);
    TEST_COMPARE(body.u.cwiseAbs().maxCoeff(), <, 50.0);  // 10,000 if a rotation closes an open pair
    for (int i = 0; i < 6; ++i) {
      TEST_EQUALITY(found.states[i].closed(), i < 2);
      TEST_ASSERT(found.states[i].closed() || found.states[i] == ContactState());
    }
    const PairStates own = found.states;
    TEST_COMPARE(body.rigid->loose(own).cols(), ==, 1);
  }
}

TEUCHOS_UNIT_TEST(StateSearch, KnowsTheBoundsOfPairsThatStickFromTheStart) {
  std::mt19937 random(16);
  CondensedBody body(2, 4);
  body.random(random, false);
  for (int i = 0; i < 4; ++i) body.load(2 * i) = 5.0, body.load(2 * i + 1) = 0.01, body.gap(i) = 0.0;
  body.begin({dry(0.2, 0.9)}, std::vector<int>(4, 0));
  StateSearch search(*body.rigid, body.laws, body.sites, body, 300);
  const StateSearch::Result found = search.run(body.all(PairStatus::Stick));
  TEST_EQUALITY(found.solves, 1);
  for (const ContactState& state : found.states) {
    TEST_ASSERT(state.status == PairStatus::Stick);
    TEST_EQUALITY(state.bound, 0.2);
    TEST_EQUALITY(state.friction, 0.9);
  }
}

// One pair holds the body at first although others would do; trying all 4^n states of n pairs shows whether a solution exists.
TEUCHOS_UNIT_TEST(StateSearch, LetsAnotherPairHoldABody) {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  int solvable = 0, solved = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const double mu = 0.02 + 0.2 * std::abs(value(random));
    CondensedBody body(2, 4);
    body.random(random, true);
    for (double& x : body.gap) x = 0.3 * std::abs(value(random));
    const Vector sums = body.kernel.transpose() * body.load;
    body.load -= body.kernel * sums / body.nodes;
    for (int i = 0; i < body.nodes; ++i) {
      body.load(2 * i) += 0.5;
      body.load(2 * i + 1) += 0.45 * mu * value(random);
    }
    body.begin({dry(0.0, mu)}, std::vector<int>(body.nodes, 0));
    int solutions = 0;
    for (int number = 0; number < 256; ++number)
      solutions += body.solve(statesOfNumber(number, 4, 0.0, mu), 0).solved && body.violation() < 1e-8;
    PairStates start(body.nodes);
    start[trial % 4] = PairStatus::Stick;
    StateSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const StateSearch::Result found = search.run(start);
    solved += found.converged;
    solvable += solutions > 0;
    TEST_ASSERT(!found.converged || body.violation() < 1e-8);
  }
  out << solvable << " of 60 have a solution, " << solved << " were found\n";
  TEST_EQUALITY(solved, solvable);
  TEST_COMPARE(solvable, >, 30);
}

// Strong friction, strongly coupled: trying all 4^n states of n pairs shows whether there is a solution.
TEUCHOS_UNIT_TEST(StateSearch, FindsASolutionOfFewPairsWhereThereIsOne) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  int solvable = 0, solved = 0, many = 0, most = 0, missedWithLess = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const double mu = 0.1 + 1.4 * std::abs(value(random));
    CondensedBody body(2, 4);
    body.random(random, trial % 2 == 0);
    // Coupling between normals and tangents is as strong as the diagonal.
    const Matrix root = Matrix::NullaryExpr(8, 9, [&] { return value(random); });
    Matrix stiffness = root * root.transpose() + 0.05 * Matrix::Identity(8, 8);
    const Matrix away = Matrix::Identity(8, 8) - body.kernel * body.kernel.transpose() / body.nodes;
    body.stiffness = away * stiffness * away;
    if (trial % 2 == 0)
      for (int i = 0; i < body.nodes; ++i) {
        body.load(2 * i) += 0.7;
        body.load(2 * i + 1) += 0.5 * mu * value(random);
      }
    body.begin({dry(0.0, mu)}, std::vector<int>(body.nodes, 0));
    int solutions = 0;
    for (int number = 0; number < 256; ++number)
      solutions += body.solve(statesOfNumber(number, 4, 0.0, mu), 0).solved && body.violation() < 1e-8;
    StateSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const StateSearch::Result found = search.run(body.all(PairStatus::Stick));
    TEST_ASSERT(!found.converged || body.violation() < 1e-7);
    solvable += solutions > 0;
    solved += found.converged;
    many += solutions > 1;
    most = std::max(most, found.solves);
    missedWithLess += solutions > 0 && !found.converged && mu < 0.95;
    if (found.converged != (solutions > 0))
      out << "trial " << trial << ", mu " << mu << ": " << solutions << " solutions, slides " << found.slides.size() << " after "
          << found.solves << " violation " << body.violation() << " u " << body.u.cwiseAbs().maxCoeff() << "\n";
  }
  out << solvable << " of 400 have a solution, " << many << " more than one, " << solved << " were found, in " << most
      << " solves at most\n";
  TEST_EQUALITY(missedWithLess, 0);
  TEST_COMPARE(solved, >=, solvable - 9);  // 5 to 9 with ratios of successive steps from .5 to .8, all with coefficients of .97 and more
  TEST_COMPARE(solvable, >, 200);
}

// The tolerance of normal forces, times a coefficient above one, is more than that of tangential forces: a pair whose nodes cannot slide is
// at its bound exactly and must not alternate between stick and slip.
TEUCHOS_UNIT_TEST(StateSearch, KeepsAPairAtItsBoundWithLargeFriction) {
  const double mu = 1.5, size = 1e-3;
  RigidBodyModel::Pairs pairs;
  pairs.rows = SparseRows(1, 0);
  pairs.tangents.assign(2, SparseRows(1, 0));
  pairs.work = Vector(0);
  pairs.penetration = Vector::Zero(1);
  pairs.stiffness = Vector::Ones(1);
  pairs.line = {0};
  pairs.canChange = {1};
  const RigidBodyModel rigid(pairs);
  const ContactLaws laws({dry(0.0, mu)});
  const std::vector<FrictionSite> sites{{{0, 0, 0}, 1.0, 1.0}};
  const LawProjection projection(rigid, laws, sites);
  ContactAnswer answer;
  answer.force = answer.jump = Matrix::Zero(1, 3);
  answer.force.row(0) << 2.0, 3.0 * 0.6, -3.0 * 0.8;
  answer.forceTolerance = answer.jumpTolerance = Vector::Constant(1, size);
  for (const double beyond : {-0.5, 0.0, 0.5}) {
    answer.force.row(0).tail(2) = (3.0 + beyond * size) * Eigen::RowVector2d(0.6, -0.8);
    for (const PairStatus status : {PairStatus::Slip, PairStatus::Stick}) {
      const PairStates now{{status, {0.0, 0.6, -0.8}, 0.0, mu}};
      TEST_ASSERT(projection.atSolution(now, answer)[0].status == status);
    }
  }
  answer.force.row(0).tail(2) = 3.1 * Eigen::RowVector2d(0.6, -0.8);
  TEST_ASSERT(projection.atSolution({PairStatus::Stick}, answer)[0].status == PairStatus::Slip);
  answer.force.row(0).tail(2) = 2.9 * Eigen::RowVector2d(0.6, -0.8);
  TEST_ASSERT(projection.atSolution({{PairStatus::Slip, {0.0, 0.6, -0.8}, 0.0, mu}}, answer)[0].status == PairStatus::Stick);
}

TEUCHOS_UNIT_TEST(StateSearch, GoesOnFromItsOwnSolutionWithOneSolve) {
  std::mt19937 random(14);
  for (int trial = 0; trial < 20; ++trial) {
    CondensedBody body(2, 4 + trial % 4);
    body.random(random, false);
    body.begin({dry(0.05, 0.3)}, std::vector<int>(body.nodes, 0));
    StateSearch search(*body.rigid, body.laws, body.sites, body, 300);
    StateSearch again(*body.rigid, body.laws, body.sites, body, 300);
    const StateSearch::Result first = search.run(body.all(PairStatus::Stick));
    TEST_ASSERT(first.converged);
    const StateSearch::Result second = again.run(first.states);
    TEST_ASSERT(second.converged);
    TEST_EQUALITY(second.solves, 1);
    for (int i = 0; i < body.nodes; ++i) TEST_ASSERT(second.states[i].status == first.states[i].status);
  }
}

/// Records the accuracies that a search requests.
struct Inexact : CondensedBody {
  std::vector<double> tolerances;
  using CondensedBody::CondensedBody;
  double loosest() const override { return 1e-2; }
  double tightest() const override { return 1e-8; }
  ContactAnswer solve(const PairStates& states, double tolerance) override {
    tolerances.push_back(tolerance);
    return CondensedBody::solve(states, tolerance);
  }
};

TEUCHOS_UNIT_TEST(StateSearch, SolvesAsAccuratelyAsTheStartIsNear) {
  std::mt19937 random(51);
  for (const auto& [start, first] : {std::make_pair(StateSearch::Start::Guess, 1e-2), std::make_pair(StateSearch::Start::Near, 3.16228e-4),
                                     std::make_pair(StateSearch::Start::Solution, 1e-8)}) {
    Inexact body(2, 6);
    body.random(random, false);
    body.begin({dry(0.0, 0.3)}, std::vector<int>(6, 0));
    StateSearch search(*body.rigid, body.laws, body.sites, body, 100);
    TEST_ASSERT(search.run(body.all(PairStatus::Stick), start).converged);
    TEST_FLOATING_EQUALITY(body.tolerances.front(), first, 1e-5);
    TEST_EQUALITY(body.tolerances.back(), 1e-8);
  }
}

}  // namespace
}  // namespace suture
