// Contact with friction on the interface against dense algebra: states, tangents, forces and slips.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <interface/DenseSpace.hpp>
#include <interface/FrictionBlocks.hpp>
#include <support/DryLaw.hpp>
#include <suture/base/Point.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/constraints/ContactRows.hpp>

#include <cmath>
#include <random>
#include <set>

namespace suture {
namespace {

using namespace blocks;

/// Random states of pairs with friction.
PairStates randomStates(int pairs, int dimension, unsigned seed, bool drags) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> value(0.0, 1.0);
  PairStates states;
  for (int p = 0; p < pairs; ++p) {
    const double choice = value(random), angle = 2 * M_PI * value(random);
    if (choice < 0.2) {
      states.emplace_back(PairStatus::Open);
    } else if (choice < 0.5) {
      states.emplace_back(PairStatus::Stick);
      states.back().bound = value(random);
    } else {
      const Point direction = dimension == 2 ? Point{0, angle < M_PI ? 1.0 : -1.0, 0} : Point{0, std::cos(angle), std::sin(angle)};
      states.emplace_back(PairStatus::Slip, direction, 1e-3 * value(random), drags ? 0.4 * value(random) : 0.0);
      if (dimension == 3) states.back().transverseStiffness = 0.05 * value(random);
    }
  }
  return states;
}

/// The scene by dense algebra: the subdomains condensed to the interface, and rows of the pairs by component.
struct DenseFriction {
  Matrix s;
  Vector load;
  double constant = 0.0;
  std::vector<std::vector<Vector>> rows;  // pair, component
  std::vector<double> gaps;
  int dimension;

  DenseFriction(const Scene& scene, const DenseSpace& space) : dimension(scene.mesh.dimension) {
    const Blocks all(scene, alone(), std::vector<double>(), false);
    const Dense whole(all);
    const std::vector<int> boundary = whole.places(space.ids);
    s = denseSchur(whole.stiffness, boundary, whole.load, &load);
    const std::vector<int> interior = complement(int(whole.load.size()), boundary);
    const Matrix inside = whole.stiffness(interior, interior);
    const Vector f = whole.load(interior);
    constant = whole.constantEnergy - 0.5 * f.dot(solveSymmetric(inside, f).col(0));
    for (const ContactRow& row : contactRows(scene.mesh, scene.constraints)) {
      rows.emplace_back();
      gaps.push_back(row.normal().gap);
      for (const ContactRow::Equation& equation : row.equations) {
        rows.back().emplace_back(Vector::Zero(space.size()));
        for (std::size_t k = 0; k < equation.dofs.size(); ++k)
          rows.back().back()(space.place(equation.dofs[k])) += equation.coefficients[k];
      }
    }
  }
  Vector along(int pair, const Point& direction) const {
    Vector row = Vector::Zero(s.rows());
    for (int k = 1; k < dimension; ++k) row += direction[k] * rows[pair][k];
    return row;
  }

  /// The linear problem of states: rows that hold, the same with induced tangential forces, springs, loads of known forces.
  struct Linear {
    Matrix holds, drags, stiffness;
    Vector right, gaps;
    std::vector<std::pair<int, int>> of;  // pair and component of each row
  };
  Linear linear(const PairStates& states) const {
    Linear result;
    result.stiffness = s;
    result.right = load;
    std::vector<Vector> holds, drags;
    std::vector<double> gap;
    for (int p = 0; p < int(states.size()); ++p) {
      const ContactState& state = states[p];
      if (!state.closed()) continue;
      const bool slips = state.status == PairStatus::Slip;
      for (int k = 0; k < (slips ? 1 : dimension); ++k) {
        holds.push_back(rows[p][k]);
        drags.push_back(rows[p][k]);
        if (slips) drags.back() += state.friction * along(p, state.direction);
        gap.push_back(k == 0 ? gaps[p] : 0.0);
        result.of.emplace_back(p, k);
      }
      if (!slips) continue;
      const Vector across = along(p, {0, -state.direction[2], state.direction[1]});
      result.stiffness += state.transverseStiffness * across * across.transpose();
      result.right -= state.bound * along(p, state.direction);
    }
    result.holds = result.drags = Matrix(Eigen::Index(holds.size()), s.rows());
    for (std::size_t i = 0; i < holds.size(); ++i)
      result.holds.row(Eigen::Index(i)) = holds[i], result.drags.row(Eigen::Index(i)) = drags[i];
    result.gaps = Eigen::Map<Vector>(gap.data(), Eigen::Index(gap.size()));
    return result;
  }
};

void tangentIsPetrovGalerkin(const Scene& scene, bool coulomb, bool& success, Teuchos::FancyOStream& out) {
  const OnInterface one(scene, world());
  const DenseSpace space(*one.problem.space());
  const DenseFriction reference(scene, space);
  const int pairs = int(scene.constraints.pairs.size()), dimension = scene.mesh.dimension;
  const ContactProblem& friction = *one.problem.contact();
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const PairStates states = randomStates(pairs, dimension, seed, coulomb);
    const DenseFriction::Linear expected = reference.linear(states);
    InterfaceState state = friction.stateWith(states);
    one.problem.conform(state);
    state.memory.reset();
    const InterfaceProblem::Linearisation linear = one.problem.linearise(state);
    const bool drags = std::any_of(states.begin(), states.end(), [](const ContactState& own) { return own.couplesToNormal(); });
    TEST_EQUALITY(linear.matrix->symmetric(), !drags);
    const DenseSpace derived(*linear.matrix->space());
    const Matrix t = derived.gathered();
    TEST_COMPARE((expected.holds * t).norm(), <, 1e-11 * t.norm());
    std::vector<int> expressed, free;
    for (int j = 0; j < t.cols(); ++j) (t.col(j).norm() == 0.0 ? expressed : free).push_back(j);
    TEST_EQUALITY(Eigen::Index(expressed.size()), expected.holds.rows());
    // Virtual displacements: the same unknowns expressed, by the rows whose normal forces induce tangential ones.
    Matrix dual = Matrix::Zero(t.rows(), t.cols());
    for (const int j : free) dual(j, j) = 1.0;
    if (!expressed.empty()) {
      const Matrix solved = -solve(expected.drags(Eigen::all, expressed), expected.drags(Eigen::all, free));
      for (std::size_t a = 0; a < expressed.size(); ++a)
        for (std::size_t b = 0; b < free.size(); ++b) dual(expressed[a], free[b]) = solved(Eigen::Index(a), Eigen::Index(b));
    }
    const double size = reference.s.norm() * t.norm() * dual.norm();
    const Matrix a = derived.dense(static_cast<const Operator&>(*linear.matrix));
    TEST_COMPARE((a - dual.transpose() * expected.stiffness * t).norm(), <, 1e-12 * size);
    if (!drags) TEST_COMPARE((a - a.transpose()).norm(), <, 1e-12 * size);
    if (drags) TEST_COMPARE((a - a.transpose()).norm(), >, 1e-6 * a.norm());
    const Vector u = space.dense(*state.trace);
    const Vector right = dual.transpose() * (expected.right - expected.stiffness * u);
    TEST_COMPARE((derived.dense(*linear.load) - right).norm(), <,
                 1e-11 * (dual.norm() * (reference.load.norm() + reference.s.norm() * u.norm())));
  }
}

TEUCHOS_UNIT_TEST(InterfaceContact, TangentsOfTrescaAreSymmetricWithSpringsAcross) {
  for (const int dimension : {2, 3})
    for (const Sides sides : {Sides::Matching, Sides::Mortar, Sides::Obstacle})
      for (const double angle : {0.0, 0.78})
        tangentIsPetrovGalerkin(rubbedBlocks(dimension, sides, scenes::dry(0.1, 0.0), 2, false, angle), false, success, out);
}

TEUCHOS_UNIT_TEST(InterfaceContact, TangentsOfCoulombTestWithTheDraggedRows) {
  for (const int dimension : {2, 3})
    for (const Sides sides : {Sides::Matching, Sides::Mortar, Sides::Obstacle})
      for (const double angle : {0.0, 0.78})
        tangentIsPetrovGalerkin(rubbedBlocks(dimension, sides, scenes::dry(0.1, 0.3), 2, false, angle), true, success, out);
}

// For a trace that solves the linear problem of some states, forces, slips and penetrations equal those of the saddle-point system.
TEUCHOS_UNIT_TEST(InterfaceContact, ForcesAndSlipsAreThoseOfTheSaddlePointProblem) {
  for (const int dimension : {2, 3})
    for (const Sides sides : {Sides::Matching, Sides::Mortar, Sides::Obstacle}) {
      const Scene scene = rubbedBlocks(dimension, sides, scenes::dry(0.1, 0.3));
      const OnInterface one(scene, world());
      const ContactProblem& friction = *one.problem.contact();
      const DenseSpace space(*one.problem.space());
      const DenseFriction reference(scene, space);
      const PairStates states = randomStates(int(scene.constraints.pairs.size()), dimension, 5, true);
      const DenseFriction::Linear linear = reference.linear(states);
      const Eigen::Index n = space.size(), m = linear.holds.rows();
      Matrix whole = Matrix::Zero(n + m, n + m);
      whole.topLeftCorner(n, n) = linear.stiffness;
      whole.topRightCorner(n, m) = linear.drags.transpose();
      whole.bottomLeftCorner(m, n) = linear.holds;
      Vector right(n + m);
      right << linear.right, linear.gaps;
      const Vector solution = solve(whole, right), u = solution.head(n), f = solution.tail(m);
      InterfaceState state = friction.stateWith(states);
      state.trace = space.vector(u);
      state.memory.reset();
      const PairValues values = friction.valuesOf(state);
      TEST_COMPARE(space.dense(*values.residual).norm(), <, 1e-9 * (linear.right.norm() + reference.s.norm() * u.norm()));
      TEST_FLOATING_EQUALITY(values.energy, 0.5 * u.dot(reference.s * u) - u.dot(reference.load) + reference.constant, 1e-9);
      Matrix force = Matrix::Zero(Eigen::Index(states.size()), 3), jump = force;
      for (Eigen::Index i = 0; i < m; ++i) force(linear.of[std::size_t(i)].first, linear.of[std::size_t(i)].second) = f(i);
      for (int p = 0; p < int(states.size()); ++p) {
        const ContactState& own = states[p];
        if (!own.closed()) jump(p, 0) = reference.rows[p][0].dot(u) - reference.gaps[p];
        for (int k = 1; k < dimension && own.status != PairStatus::Stick; ++k) jump(p, k) = reference.rows[p][k].dot(u);
        if (own.status != PairStatus::Slip) continue;
        const Point across{0, -own.direction[2], own.direction[1]};
        const double spring = own.transverseStiffness * reference.along(p, across).dot(u);
        for (int k = 1; k < dimension; ++k) force(p, k) = (own.bound + own.friction * force(p, 0)) * own.direction[k] + spring * across[k];
      }
      TEST_COMPARE((values.force - force).norm(), <, 1e-8 * force.norm());
      TEST_COMPARE((values.jump - jump).norm(), <, 1e-10 * jump.norm());
      // Reported values of the pairs: Cartesian tangential forces of the same size, in the contact plane.
      const InterfaceProblem::Recovered found = one.problem.recover(state);
      double worst = 0.0;
      for (const PairForce& pair : found.pairs) {
        worst = std::max(worst, std::abs(pair.force - force(pair.id, 0)));
        worst = std::max(worst, std::abs(norm(pair.tangential) - force.row(pair.id).tail(2).norm()));
        worst = std::max(worst, std::abs(pair.tangential[dimension - 1]));
      }
      TEST_COMPARE(worst, <, 1e-8 * force.norm());
    }
}

TEUCHOS_UNIT_TEST(InterfaceContact, GoThroughTheFormulationUnchanged) {
  for (const int dimension : {2, 3})
    for (const Sides sides : {Sides::Matching, Sides::Mortar, Sides::Obstacle}) {
      const Scene scene = rubbedBlocks(dimension, sides, scenes::dry(0.1, 0.3));
      const OnInterface one(scene, world());
      const ContactProblem& friction = *one.problem.contact();
      const int pairs = int(scene.constraints.pairs.size());
      for (unsigned seed = 1; seed <= 5; ++seed) {
        const PairStates states = randomStates(pairs, dimension, seed, true);
        const ContactStates status = friction.statusOf(states);
        TEST_ASSERT(friction.statesOf(status) == states);
        TEST_ASSERT(friction.statesOf(friction.stateWith(states).status) == states);
        // By the ids of pairs, as in a checkpoint.
        std::map<int, ContactState> kept;
        for (int p = 0; p < pairs; ++p) kept[p] = states[p];
        TEST_ASSERT(friction.statesOf(one.problem.stateOf(zeros(one.all), kept).status) == states);
        // Two lists differ where a state differs.
        const PairStates others = randomStates(pairs, dimension, seed + 100, true);
        std::vector<int> expected;
        for (int p = 0; p < pairs; ++p)
          if (states[p] != others[p]) expected.push_back(p);
        TEST_ASSERT(one.problem.differing(status, friction.statusOf(others)) == expected);
      }
    }
}

TEUCHOS_UNIT_TEST(InterfaceContact, SitesAreThoseOfThePairs) {
  for (const int dimension : {2, 3}) {
    const Scene scene = rubbedBlocks(dimension, Sides::Mortar, scenes::dry(0.1, 0.3));
    const OnInterface one(scene, world());
    const std::vector<FrictionSite>& sites = one.problem.contact()->sites();
    TEST_EQUALITY(sites.size(), scene.constraints.pairs.size());
    for (std::size_t p = 0; p < sites.size(); ++p) {
      TEST_EQUALITY(norm(minus(sites[p].place, scene.constraints.pairs[p].position)), 0.0);
      TEST_EQUALITY(sites[p].size, scene.constraints.pairs[p].length);
      TEST_COMPARE(sites[p].tangential, >, 0.0);
    }
  }
}

TEUCHOS_UNIT_TEST(InterfaceContact, HasNoTangentialStiffnessWithoutFriction) {
  const OnInterface smooth(rubbedBlocks(2, Sides::Matching, std::make_shared<Frictionless>()), world());
  for (const FrictionSite& site : smooth.problem.contact()->sites()) TEST_EQUALITY(site.tangential, 0.0);
  const OnInterface guided(rubbedBlocks(2, Sides::Matching, std::make_shared<NoSeparation>()), world());
  TEST_ASSERT(guided.problem.contact() == nullptr);  // no pair can change
}

/// Three loose stacked blocks, the lower contact with one law, the upper with another.
struct LooseStack {
  Scene scene;

  LooseStack(int dimension, std::vector<std::shared_ptr<const ContactLaw>> laws) {
    std::vector<Box> boxes(3);
    for (int k = 0; k < 3; ++k) {
      Box& box = boxes[k];
      box.name = std::string("block") + char('a' + k);
      box.nx = box.ny = box.nz = 2;
      (dimension == 2 ? box.y0 : box.z0) = k;
      (dimension == 2 ? box.y1 : box.z1) = k + 1;
      if (dimension == 3) box.cell = Cell::Hexahedron8;
    }
    scene = scenes::fromBoxes(boxes, 1.0, 0.3);
    scene.model.dimension = dimension;
    scene.constraints = buildConstraints(
        scene.mesh, {}, {Contact::between("blocka_top", "blockb_bottom"), Contact::between("blockb_top", "blockc_bottom")});
    applyLaws(ContactLaws(std::move(laws)), scene.mesh, scene.constraints);
  }
  /// Rigid motions that the pairs leave free.
  int motions() {
    const Blocks blocks(scene, world(), 3, 1, false);
    std::vector<const SubdomainMesh*> meshesOf;
    for (const SubdomainMesh& mesh : blocks.meshes) meshesOf.push_back(&mesh);
    const ContactBodies bodies(*world(), meshesOf, scene.constraints.laws);
    return bodies.rigid().motions();
  }
};

TEUCHOS_UNIT_TEST(InterfaceContact, BodiesThatNeverPartMoveTogether) {
  using OneLaw = std::shared_ptr<const ContactLaw>;
  const OneLaw tied = std::make_shared<Tied>(), guided = std::make_shared<NoSeparation>(), smooth = std::make_shared<Frictionless>();
  using Laws = std::vector<OneLaw>;
  const struct {
    Laws laws;
    int plane, space;
  } cases[] = {{{smooth, smooth}, 9, 18}, {{scenes::dry(0.0, 0.3), smooth}, 9, 18},
               {{tied, smooth}, 6, 12},   {{tied, tied}, 3, 6},
               {{guided, smooth}, 7, 15}, {{guided, guided}, 5, 12},
               {{tied, guided}, 4, 9}};
  for (const auto& of : cases) {
    TEST_EQUALITY(LooseStack(2, of.laws).motions(), of.plane);
    TEST_EQUALITY(LooseStack(3, of.laws).motions(), of.space);
  }
}

}  // namespace
}  // namespace suture
