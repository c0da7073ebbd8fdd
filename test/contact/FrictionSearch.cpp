#include <Teuchos_UnitTestHarness.hpp>
#include <support/DenseAlgebra.hpp>
#include <support/DryLaw.hpp>
#include <suture/contact/FrictionSearch.hpp>

#include <cmath>
#include <random>

namespace suture {
namespace {

using scenes::dry;
using SearchLaw = std::shared_ptr<const ContactLaw>;

/// Nodes of one body before a rigid ground, condensed to them: K u + f = load, u_n <= gap. Components of a node: normal, tangents.
struct CondensedBody : FrictionOracle {
  int dimension, nodes;
  Matrix stiffness, kernel;
  Vector load, gap;
  ContactLaws laws;
  std::vector<int> line;
  std::vector<FrictionSite> sites;
  std::unique_ptr<RigidContact> rigid;
  int solves = 0;
  bool strange = false;  // a pair was given a state that its law does not have
  Vector u;              // solution of the last solve

  CondensedBody(int dims, int count) : dimension(dims), nodes(count), gap(Vector::Zero(count)) {
    stiffness = Matrix::Zero(dims * count, dims * count);
    kernel = Matrix(dims * count, 0);
    load = Vector::Zero(dims * count);
    line.assign(count, 0);
  }

  void random(std::mt19937& engine, bool loose) {
    std::normal_distribution<double> value;
    const int m = nodes * dimension;
    Matrix a(m, m + 2);
    for (double& x : a.reshaped()) x = value(engine);
    stiffness = (a * a.transpose() + 3.0 * m * Matrix::Identity(m, m)) / m;
    for (double& x : load) x = value(engine);
    for (double& x : gap) x = 0.2 * value(engine);
    if (!loose) return;
    kernel = Matrix::Zero(m, dimension);  // translations
    for (int i = 0; i < m; ++i) kernel(i, i % dimension) = 1.0;
    const Matrix away = Matrix::Identity(m, m) - kernel * kernel.transpose() / nodes;
    stiffness = (away * stiffness * away).eval();
  }

  /// After all else is set.
  void begin(std::vector<SearchLaw> all, const std::vector<int>& lines) {
    laws = ContactLaws(std::move(all));
    line = lines;
    RigidContact::Pairs pairs;
    const auto motions = kernel.cols();
    pairs.rows = Matrix::Zero(nodes, motions);
    pairs.tangents.assign(dimension - 1, Matrix::Zero(nodes, motions));
    pairs.work = kernel.transpose() * load;
    pairs.penetration = -gap;
    pairs.stiffness = Vector::Ones(nodes);
    pairs.line = line;
    pairs.bodies.assign(nodes, {0});
    pairs.able.assign(nodes, 1);
    pairs.bound.assign(nodes, 0);
    pairs.surfaces = dimension == 3;
    for (int i = 0; i < nodes; ++i) {
      pairs.rows.row(i) = kernel.row(dimension * i);
      for (int k = 1; k < dimension; ++k) pairs.tangents[k - 1].row(i) = kernel.row(dimension * i + k);
      pairs.stiffness(i) = stiffness(dimension * i, dimension * i);
      sites.push_back({{0.1 * i, 0, 0}, 1.0, stiffness(dimension * i + 1, dimension * i + 1)});
      if (laws.of(line[i]).separates()) continue;
      pairs.able[i] = 0;
      pairs.bound[i] = 1;
    }
    rigid = std::make_unique<RigidContact>(std::move(pairs));
  }

  PairStates all(PairStatus status) const {
    PairStates states(nodes, status);
    for (int i = 0; i < nodes; ++i)
      if (!laws.of(line[i]).separates() || laws.of(line[i]).rows(dimension) == 1) states[i] = laws.of(line[i]).pressed();
    return states;
  }

  // One linear system in displacements and forces; unknown forces of rows that do not hold are given by the states.
  FrictionAnswer solve(const PairStates& states, double) override {
    ++solves;
    for (int i = 0; i < nodes; ++i) strange = strange || (laws.of(line[i]).rows(dimension) == 1 && states[i].status == PairStatus::Stick);
    const int n = nodes * dimension;
    Matrix a = Matrix::Zero(2 * n, 2 * n);
    Vector b = Vector::Zero(2 * n);
    a.topLeftCorner(n, n) = stiffness;
    a.topRightCorner(n, n).setIdentity();
    b.head(n) = load;
    for (int i = 0; i < nodes; ++i) {
      const ContactState& state = states[i];
      for (int k = 0; k < dimension; ++k) {
        const int row = dimension * i + k;
        if (state.holds(k)) {
          a(n + row, row) = 1.0;
          b(n + row) = k == 0 ? gap(i) : 0.0;
          continue;
        }
        a(n + row, n + row) = 1.0;
        if (k == 0 || !state.closed()) continue;
        a(n + row, n + dimension * i) = -state.friction * state.direction[k];
        b(n + row) = state.bound * state.direction[k];
        const Point across{0.0, -state.direction[2], state.direction[1]};
        for (int j = 1; j < dimension; ++j) a(n + row, dimension * i + j) -= state.across * across[k] * across[j];
      }
    }
    FrictionAnswer answer;
    if (dense::rank(a) < 2 * n) {
      answer.solved = false;
      return answer;
    }
    const Vector x = dense::solve(a, b);
    u = x.head(n);
    answer.force = answer.jump = Matrix::Zero(nodes, 3);
    for (int i = 0; i < nodes; ++i)
      for (int k = 0; k < dimension; ++k) {
        answer.force(i, k) = x(n + dimension * i + k);
        if (!states[i].holds(k)) answer.jump(i, k) = u(dimension * i + k) - (k == 0 ? gap(i) : 0.0);
      }
    const double size = answer.force.rowwise().norm().maxCoeff();
    answer.forceTolerance = Vector::Constant(nodes, 1e-11 * size);
    answer.jumpTolerance = Vector::Constant(nodes, 1e-12 * (u.cwiseAbs().maxCoeff() + gap.cwiseAbs().maxCoeff()));
    force = answer.force;
    return answer;
  }

  /// Largest violation of the optimality conditions by the last solve, each by itself; relative to the largest force.
  double violation() const {
    const double size = force.cwiseAbs().maxCoeff() + 1e-300, length = u.cwiseAbs().maxCoeff() + gap.cwiseAbs().maxCoeff();
    double worst = 0.0;
    const auto atMost = [&](double value, double bound, double scale) { worst = std::max(worst, (value - bound) / scale); };
    Vector balance = stiffness * u - load;
    for (int i = 0; i < nodes; ++i) {
      const ContactLaw& law = laws.of(line[i]);
      const double normal = force(i, 0), open = gap(i) - u(dimension * i), tangential = std::hypot(force(i, 1), force(i, 2));
      for (int k = 0; k < dimension; ++k) balance(dimension * i + k) += force(i, k);
      double slip = 0.0, work = 0.0;
      for (int k = 1; k < dimension; ++k) {
        slip = std::hypot(slip, u(dimension * i + k));
        work += force(i, k) * u(dimension * i + k);
      }
      if (!law.separates()) {
        atMost(std::abs(open), 0.0, length);
        law.rows(dimension) > 1 ? atMost(slip, 0.0, length) : atMost(tangential, 0.0, size);
        continue;
      }
      atMost(-normal, 0.0, size);
      atMost(-open, 0.0, length);
      atMost(std::min(normal / size, open / length), 0.0, 1.0);
      double bound = 0.0;
      if (law.rows(dimension) > 1 && open < 1e-9 * length) {
        // The bound by a trial that slides without doubt.
        ContactTrial trial;
        trial.place = sites[i].place;
        trial.size = sites[i].size;
        trial.force[0] = std::max(normal, 1e-300);
        trial.jump[1] = 1e10;
        bound = law.project(trial, PairStatus::Slip).largest(normal);
      }
      atMost(tangential, bound, size);
      atMost(bound * slip - work, 0.0, size * length);  // at its bound, and along the slip, where it slips
    }
    atMost(balance.cwiseAbs().maxCoeff(), 0.0, size + load.cwiseAbs().maxCoeff());
    return worst;
  }

 private:
  Matrix force;
};

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

// Loads inside the cones hold a body that nothing else does.
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
    // Sums of forces inside nine tenths of the cone, spread over the nodes; what nodes pull at each other stays.
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
  TEST_COMPARE(solved, >=, 99);  // in one a pair alternates
  TEST_COMPARE(worst, <, 1e-8);
}

TEUCHOS_UNIT_TEST(FrictionSearch, SaysThatABodySlidesAway) {
  std::mt19937 random(13);
  for (const int dimension : {2, 3})
    for (const SearchLaw& law : {dry(0.0, 0.3), dry(0.6, 0.0)})  // both carry .6 a node under a normal force of 2
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
          // Along the push: 3/5 and 4/5 in space, either sense.
          TEST_EQUALITY(found.slides.size(), dimension);
          const Vector way = found.slides.normalized();
          TEST_COMPARE(std::abs(way(0)), <, 1e-8);
          if (dimension == 2) TEST_FLOATING_EQUALITY(std::abs(way(1)), 1.0, 1e-8);
          if (dimension == 3) TEST_COMPARE(std::abs(0.8 * way(1) - 0.6 * way(2)), >, 0.98);  // direction by a pyramid of 16 planes
        }
}

/// States of all pairs by digits of a number: open, stick, slip either way.
PairStates statesOfNumber(int number, int pairs, double cohesion, double mu) {
  PairStates states(pairs);
  for (int i = 0; i < pairs; ++i, number /= 4) {
    if (number % 4 == 1) states[i] = PairStatus::Stick;
    if (number % 4 > 1) states[i] = {PairStatus::Slip, {0.0, number % 4 == 2 ? 1.0 : -1.0, 0.0}, cohesion, mu};
  }
  return states;
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

// One pair holds the body at first, where others would do; all 4^n states of n pairs tell whether any do.
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
  TEST_COMPARE(solvable - solved, <=, 4);  // known shortfall: four that have a solution are not found
  TEST_COMPARE(solvable, >, 30);
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
