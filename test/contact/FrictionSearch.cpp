#include "CondensedBody.hpp"

#include <Teuchos_UnitTestHarness.hpp>

namespace suture {
namespace {

using scenes::dry;

/// Forces of the frictionless problem.
Vector smoothForces(const CondensedBody& given) {
  CondensedBody smooth(given.dimension, given.nodes);
  smooth.stiffness = given.stiffness;
  smooth.load = given.load;
  smooth.gap = given.gap;
  smooth.begin({}, given.line);
  FrictionSearch search(*smooth.rigid, smooth.laws, smooth.sites, smooth, 100);
  const FrictionSearch::Result found = search.run(smooth.all(PairStatus::Slip));
  if (!found.converged) return {};
  return smooth.solve(found.states, 0).force.col(0).cwiseMax(0.0);
}

TEUCHOS_UNIT_TEST(FrictionSearch, SolvesRandomProblemsOfAllLaws) {
  std::mt19937 random(11);
  const SearchLaw tied = std::make_shared<Tied>(), guided = std::make_shared<NoSeparation>(), smooth = std::make_shared<Frictionless>();
  const std::vector<std::vector<SearchLaw>> choices{{dry(0, 0.1)},
                                                    {dry(0, 0.3)},
                                                    {dry(0.2, 0.0)},
                                                    {dry(0.1, 0.2), dry(0.0, 0.0)},
                                                    {dry(0, 0.3), tied, guided, smooth},
                                                    {dry(0, 0.3), smooth, dry(0.3, 0.0)}};
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
    const bool warm = trial % 3 == 0;
    FrictionSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const FrictionSearch::Result found =
        search.run(body.all(trial % 4 == 0 ? PairStatus::Slip : PairStatus::Stick), warm ? smoothForces(body) : Vector());
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
TEUCHOS_UNIT_TEST(FrictionSearch, HoldsLooseBodiesByFriction) {
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
    FrictionSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const FrictionSearch::Result found = search.run(body.all(PairStatus::Stick));
    solved += found.converged;
    if (!found.converged)
      out << "trial " << trial << " mu " << mu << ": " << found.alternating.size() << " alternate, slides " << found.slides.size() << "\n";
    if (!found.converged) continue;
    worst = std::max(worst, body.violation());
  }
  TEST_EQUALITY(solved, 100);
  TEST_COMPARE(worst, <, 1e-8);
}

TEUCHOS_UNIT_TEST(FrictionSearch, SaysThatABodySlidesAway) {
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
          FrictionSearch search(*body.rigid, body.laws, body.sites, body, 200);
          const FrictionSearch::Result found = search.run(body.all(PairStatus::Stick));
          TEST_EQUALITY(found.converged, push < 0.6);
          TEST_EQUALITY(found.slides.size() > 0, push > 0.6);
          if (found.slides.size() == 0) continue;
          // Along the push: 3/5 and 4/5 in 3D, either sign.
          TEST_EQUALITY(found.slides.size(), dimension);
          const Vector way = found.slides.normalized();
          TEST_COMPARE(std::abs(way(0)), <, 1e-8);
          if (dimension == 2) TEST_FLOATING_EQUALITY(std::abs(way(1)), 1.0, 1e-8);
          if (dimension == 3) TEST_COMPARE(std::abs(0.8 * way(1) - 0.6 * way(2)), >, 0.98);  // direction by a pyramid of 16 planes
        }
}

// A pair that opens loses its cohesion at once: there may be no solution. All 4^n states of n pairs are tried.
TEUCHOS_UNIT_TEST(FrictionSearch, FindsASolutionWithCohesionWhereThereIsOne) {
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
    FrictionSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const FrictionSearch::Result found = search.run(body.all(PairStatus::Stick));
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

TEUCHOS_UNIT_TEST(FrictionSearch, KnowsTheBoundsOfPairsThatStickFromTheStart) {
  std::mt19937 random(16);
  CondensedBody body(2, 4);
  body.random(random, false);
  for (int i = 0; i < 4; ++i) body.load(2 * i) = 5.0, body.load(2 * i + 1) = 0.01, body.gap(i) = 0.0;
  body.begin({dry(0.2, 0.9)}, std::vector<int>(4, 0));
  FrictionSearch search(*body.rigid, body.laws, body.sites, body, 300);
  const FrictionSearch::Result found = search.run(body.all(PairStatus::Stick));
  TEST_EQUALITY(found.solves, 1);
  for (const ContactState& state : found.states) {
    TEST_ASSERT(state.status == PairStatus::Stick);
    TEST_EQUALITY(state.bound, 0.2);
    TEST_EQUALITY(state.friction, 0.9);
  }
}

// One pair holds the body at first although others would do; trying all 4^n states of n pairs shows whether a solution exists.
TEUCHOS_UNIT_TEST(FrictionSearch, LetsAnotherPairHoldABody) {
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
    FrictionSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const FrictionSearch::Result found = search.run(start);
    solved += found.converged;
    solvable += solutions > 0;
    TEST_ASSERT(!found.converged || body.violation() < 1e-8);
  }
  out << solvable << " of 60 have a solution, " << solved << " were found\n";
  TEST_EQUALITY(solved, solvable);
  TEST_COMPARE(solvable, >, 30);
}

// Strong friction, strongly coupled: trying all 4^n states of n pairs shows whether there is a solution.
TEUCHOS_UNIT_TEST(FrictionSearch, FindsASolutionOfFewPairsWhereThereIsOne) {
  std::mt19937 random(20);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  int solvable = 0, solved = 0, many = 0, most = 0;
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
    FrictionSearch search(*body.rigid, body.laws, body.sites, body, 300);
    const FrictionSearch::Result found = search.run(body.all(PairStatus::Stick));
    TEST_ASSERT(!found.converged || body.violation() < 1e-7);
    solvable += solutions > 0;
    solved += found.converged;
    many += solutions > 1;
    most = std::max(most, found.solves);
    if (found.converged != (solutions > 0))
      out << "trial " << trial << ", mu " << mu << ": " << solutions << " solutions, slides " << found.slides.size() << " after "
          << found.solves << " violation " << body.violation() << " u " << body.u.cwiseAbs().maxCoeff() << "\n";
  }
  out << solvable << " of 400 have a solution, " << many << " more than one, " << solved << " were found, in " << most
      << " solves at most\n";
  TEST_EQUALITY(solved, solvable);
  TEST_COMPARE(solvable, >, 200);
}

TEUCHOS_UNIT_TEST(FrictionSearch, GoesOnFromItsOwnSolutionWithOneSolve) {
  std::mt19937 random(14);
  for (int trial = 0; trial < 20; ++trial) {
    CondensedBody body(2, 4 + trial % 4);
    body.random(random, false);
    body.begin({dry(0.05, 0.3)}, std::vector<int>(body.nodes, 0));
    FrictionSearch search(*body.rigid, body.laws, body.sites, body, 300), again(*body.rigid, body.laws, body.sites, body, 300);
    const FrictionSearch::Result first = search.run(body.all(PairStatus::Stick));
    TEST_ASSERT(first.converged);
    const FrictionSearch::Result second = again.run(first.states);
    TEST_ASSERT(second.converged);
    TEST_EQUALITY(second.solves, 1);
    for (int i = 0; i < body.nodes; ++i) TEST_ASSERT(second.states[i].status == first.states[i].status);
  }
}

/// Rows of a block's corners on a plane: motions are three displacements and three rotations about the middle of its lower side.
TEUCHOS_UNIT_TEST(FrictionSearch, StatesOfPairsLeaveTheMotionsThatTheyDoNotHold) {
  RigidContact::Pairs pairs;
  pairs.rows = Matrix::Zero(4, 6);
  pairs.tangents.assign(2, Matrix::Zero(4, 6));
  for (int i = 0; i < 4; ++i) {
    const double x = i % 2 == 0 ? -1.0 : 1.0, y = i < 2 ? -1.0 : 1.0;
    pairs.rows.row(i) << 0, 0, 1, y, -x, 0;
    pairs.tangents[0].row(i) << 1, 0, 0, 0, 0, -y;
    pairs.tangents[1].row(i) << 0, 1, 0, 0, 0, x;
  }
  pairs.work = Vector::Zero(6);
  pairs.penetration = Vector::Zero(4);
  pairs.stiffness = Vector::Ones(4);
  pairs.line.assign(4, 0);
  pairs.able.assign(4, 1);
  pairs.surfaces = true;
  const RigidContact rigid(pairs);
  const ContactState open, slip(PairStatus::Slip, {0, 1, 0}, 1.0), stick(PairStatus::Stick);
  ContactState guided(PairStatus::Slip, {0, 1, 0}, 1.0);
  guided.across = 2.0;
  const auto left = [&](const PairStates& states) { return int(rigid.loose(states).cols()); };
  TEST_EQUALITY(left({open, open, open, open}), 6);
  TEST_EQUALITY(left({slip, open, open, open}), 5);
  TEST_EQUALITY(left({slip, slip, slip, slip}), 3);    // slides and spins
  TEST_EQUALITY(left({stick, slip, slip, slip}), 1);   // spins about the one that sticks
  TEST_EQUALITY(left({stick, stick, open, open}), 1);  // tilts about the edge
  TEST_EQUALITY(left({stick, slip, stick, slip}), 0);
  TEST_EQUALITY(left({guided, slip, slip, slip}), 2);
  TEST_EQUALITY(left({guided, guided, slip, slip}), 1);
  const Vector along = rigid.loose(PairStates{guided, guided, guided, guided}).col(0);  // along the direction of slip
  TEST_FLOATING_EQUALITY(std::abs(along(0)), 1.0, 1e-12);
  const Vector spin = rigid.loose(PairStates{stick, slip, slip, slip}).col(0);  // the corner (-1, -1) stays where it is
  TEST_COMPARE(std::abs(spin(0) + spin(5)) + std::abs(spin(1) - spin(5)) + std::abs(spin(2)), <, 1e-12);
}

}  // namespace
}  // namespace suture
