#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Errors.hpp>
#include <suture/constraints/BuildConstraints.hpp>
#include <suture/monolithic/Monolithic.hpp>
#include <suture/pairs/FrictionLaws.hpp>
#include <suture/pairs/PairFrame.hpp>

#include <support/DryLaw.hpp>
#include <support/SmallScenes.hpp>

#include <cmath>
#include <map>
#include <memory>
#include <random>

namespace suture {
namespace {

using scenes::dry;
using scenes::Scene;
using LawPtr = std::shared_ptr<const ContactLaw>;

constexpr double kDegree = M_PI / 180.0;

MonolithicResult solved(const Scene& scene, const MonolithicOptions& options = {}) {
  Monitor quiet;
  return solveMonolithic(scene.mesh, scene.constraints, scene.model, options, quiet);
}

Scene with(Scene scene, LawPtr law) {
  scene.constraints.laws = ContactLaws({std::move(law)});
  return scene;
}

/// Pairs of a side with a rigid plane that it touches. \param normal  out of the body, into the plane
void restOn(Scene& scene, const std::string& group, const Point& normal) {
  std::map<int, double> share;  // tributary lengths and areas, of equal sides at each of their nodes
  for (const Side& side : scene.mesh.sideGroups.at(group)) {
    const auto nodes = scene.mesh.nodesOf(side);
    double size = norm(minus(scene.mesh.point(nodes[1]), scene.mesh.point(nodes[0])));
    if (scene.mesh.dimension == 3) size *= norm(minus(scene.mesh.point(nodes[2]), scene.mesh.point(nodes[1])));
    for (const int node : nodes) share[node] += size / double(nodes.size());
  }
  for (const auto& [node, size] : share) {
    ContactPair pair;
    pair.id = int(scene.constraints.pairs.size());
    pair.line = pair.piece = 0;
    pair.ends = {{node, 1.0}};
    pair.normal = normal;
    pair.length = size;
    pair.position = scene.mesh.point(node);
    scene.constraints.pairs.push_back(pair);
  }
}

struct Sums {
  Point force{0, 0, 0};  // force of the contact on the body of side A
  int stick = 0, closed = 0;
};

Sums sumsOf(const Scene& scene, const MonolithicResult& result) {
  Sums sums;
  for (const PairForce& pair : result.forces) {
    sums.force = minus(sums.force, plus(scaled(pair.force, scene.constraints.pairs[pair.id].normal), pair.tangential));
    sums.stick += pair.state.status == PairStatus::Stick;
    sums.closed += pair.state.closed();
  }
  return sums;
}

double distance(const Vector& a, const Vector& b) { return (a - b).cwiseAbs().maxCoeff() / b.cwiseAbs().maxCoeff(); }

/// Block of 2 x 1 on a rigid plane, its top moved down, tilted and to the right.
Scene pushedBlock(int n) {
  Box box;
  box.x1 = 2;
  box.nx = 2 * n;
  box.ny = n;
  Scene scene = scenes::fromBoxes({box}, 1.0, 0.3);
  restOn(scene, "body_bottom", {0, -1, 0});
  for (const int node : scene.nodesOf("body_top")) {
    scene.holdNode(node, 0, 0.02);
    scene.holdNode(node, 1, -0.03 + 0.01 * (scene.mesh.point(node)[0] - 1));
  }
  return scene;
}

// V19: values of an independent program (RESEARCH.md, B.2), which condensed the same mesh and iterated Tresca problems to a fixed point. It
// counts up to three more sticking pairs: it ends at 1e-8 and counts pairs 1e-9 below the bound as sticking, as some slipping pairs still
// are.
TEUCHOS_UNIT_TEST(FrictionScenes, PushesABlockOverAPlane) {
  struct Row {
    int n;
    double mu;
    int stick;
    double normal, tangential;
  };
  const Row rows[] = {
      {8, .1, 3, 6.946379e-02, -6.864639e-03},   {8, .3, 7, 7.193801e-02, -1.449440e-02},   {8, .6, 17, 7.344842e-02, -1.645933e-02},
      {8, 1., 17, 7.344842e-02, -1.645933e-02},  {16, .1, 3, 6.931226e-02, -6.843008e-03},  {16, .3, 12, 7.178182e-02, -1.441698e-02},
      {16, .6, 33, 7.315861e-02, -1.628169e-02}, {16, 1., 33, 7.315861e-02, -1.628169e-02}, {32, .1, 3, 6.924585e-02, -6.851310e-03},
      {32, .3, 24, 7.171734e-02, -1.438805e-02}, {32, .6, 65, 7.304492e-02, -1.622160e-02}, {32, 1., 65, 7.304492e-02, -1.622160e-02}};
  for (const Row& row : rows) {
    const Scene scene = with(pushedBlock(row.n), dry(0.0, row.mu));
    const MonolithicResult result = solved(scene);
    TEST_ASSERT(result.converged);
    const Sums sums = sumsOf(scene, result);
    TEST_COMPARE(sums.stick, <=, row.stick);
    TEST_COMPARE(sums.stick, >=, row.stick - 3);
    TEST_EQUALITY(sums.closed, 2 * row.n + 1);
    TEST_FLOATING_EQUALITY(sums.force[1], row.normal, 1e-6);
    TEST_FLOATING_EQUALITY(sums.force[0], row.tangential, 1e-6);
    TEST_COMPARE(result.balance.imbalance, <, 1e-12);
    TEST_COMPARE(result.iterations, <, 30);
  }
}

// V17, SSNV503 of Code_Aster: 300 N/mm2 on 40 mm press with 12 kN, of which .3 are 3600 N; a spring of 4 N/mm takes the excess.
TEUCHOS_UNIT_TEST(FrictionScenes, APadSlidesUntilItsSpringCarriesTheRest) {
  for (const double pull : {178.2, 181.8}) {
    Box box;
    box.x1 = 40;
    box.y1 = 20;
    box.nx = 8;
    box.ny = 4;
    Scene scene = scenes::fromBoxes({box}, 1e8, 0.0);
    restOn(scene, "body_bottom", {0, -1, 0});
    scene.pressure("body_top", 300.0);
    scene.traction("body_right", {pull, 0, 0});
    scene.model.supports.push_back({{"body_left"}, 4.0 / 20.0, 0.0});
    for (const Side& side : scene.mesh.sideGroups.at("body_left"))
      for (const int node : scene.mesh.nodesOf(side)) scene.constraints.springs.push_back({side.element, node, {1, 0, 0}});
    scene = with(scene, dry(0.0, 0.3));
    const MonolithicResult result = solved(scene);
    TEST_ASSERT(result.converged);
    const Sums sums = sumsOf(scene, result);
    // Statics alone determines the mean deflection of the springs; the rest is the deformation of the pad.
    const double slip = std::max(0.0, 20.0 * pull - 3600.0) / 4.0, deformation = 300.0 / 1e8 * 40.0;
    for (const int node : scene.nodesOf("body_bottom")) TEST_COMPARE(std::abs(result.displacement[2 * node] - slip), <, deformation);
    double mean = 0.0;
    for (const Side& side : scene.mesh.sideGroups.at("body_left"))
      for (const int node : scene.mesh.nodesOf(side)) mean += result.displacement[2 * node] / 8.0;
    if (slip > 0.0) TEST_FLOATING_EQUALITY(mean, slip, 1e-6);
    TEST_EQUALITY(sums.stick, pull < 180.0 ? sums.stick : 0);
    TEST_FLOATING_EQUALITY(sums.force[1], 12000.0, 1e-9);
    TEST_FLOATING_EQUALITY(-sums.force[0], std::min(3600.0, 20.0 * pull), 1e-6);
    TEST_COMPARE(result.balance.imbalance, <, 1e-9);
  }
}

TEUCHOS_UNIT_TEST(FrictionScenes, WithoutFrictionTheyAreFrictionless) {
  const Scene scene = pushedBlock(8);
  const MonolithicResult smooth = solved(scene), none = solved(with(scene, dry(0.0, 0.0)));
  TEST_ASSERT(none.converged);
  TEST_COMPARE(distance(none.displacement, smooth.displacement), <, 1e-11);
  for (std::size_t p = 0; p < smooth.forces.size(); ++p) {
    TEST_ASSERT(none.forces[p].state.status == smooth.forces[p].state.status);
    TEST_COMPARE(std::abs(none.forces[p].force - smooth.forces[p].force), <, 1e-12);
    TEST_COMPARE(norm(none.forces[p].tangential), <, 1e-14);
  }
  TEST_FLOATING_EQUALITY(none.rows.back().energy, smooth.rows.back().energy, 1e-11);
}

TEUCHOS_UNIT_TEST(FrictionScenes, EnergyOfTheLastStepIsThatOfTheSolution) {
  for (const double mu : {0.1, 0.3, 1.0}) {
    const MonolithicResult result = solved(with(pushedBlock(8), dry(0.0, mu)));
    TEST_FLOATING_EQUALITY(result.rows.back().energy, result.energy, 1e-10);
  }
}

TEUCHOS_UNIT_TEST(FrictionScenes, MuchFrictionIsTied) {
  const Scene scene = pushedBlock(8);
  const MonolithicResult rough = solved(with(scene, dry(0.0, 1e6))), tied = solved(with(scene, std::make_shared<Tied>()));
  TEST_ASSERT(rough.converged && tied.converged);
  TEST_COMPARE(distance(rough.displacement, tied.displacement), <, 1e-11);
  for (const PairForce& pair : tied.forces) TEST_ASSERT(pair.state.status == PairStatus::Stick);
}

TEUCHOS_UNIT_TEST(FrictionScenes, TwoTiedBlocksAreOne) {
  Scene two = scenes::twoBlocks(8, 4, 4, 2e6, 0.3);
  Box box;
  box.x0 = box.y0 = -1;
  box.nx = box.ny = 8;
  Scene one = scenes::fromBoxes({box}, 2e6, 0.3);
  for (Scene* scene : {&one, &two}) {
    const std::string bottom = scene == &one ? "body_bottom" : "lower_bottom", top = scene == &one ? "body_top" : "upper_top";
    scene->hold(bottom, 0, 0.0);
    scene->hold(bottom, 1, 0.0);
    scene->traction(top, {3e4, 1e4, 0});  // pulls up and along: only glue carries it
  }
  two = with(two, std::make_shared<Tied>());
  const MonolithicResult whole = solved(one), glued = solved(two);
  TEST_ASSERT(glued.converged);
  std::map<std::pair<long, long>, int> nodeAt;
  const auto key = [](const Point& p) { return std::make_pair(std::lround(1e6 * p[0]), std::lround(1e6 * p[1])); };
  for (int i = 0; i < one.mesh.nodes(); ++i) nodeAt[key(one.mesh.point(i))] = i;
  double worst = 0.0;
  for (int i = 0; i < two.mesh.nodes(); ++i)
    for (int k = 0; k < 2; ++k)
      worst = std::max(worst, std::abs(glued.displacement[2 * i + k] - whole.displacement[2 * nodeAt.at(key(two.mesh.point(i))) + k]));
  TEST_COMPARE(worst, <, 1e-11 * whole.displacement.cwiseAbs().maxCoeff());
  const Sums sums = sumsOf(two, glued);
  TEST_FLOATING_EQUALITY(sums.force[0], 6e4, 1e-10);
  TEST_FLOATING_EQUALITY(sums.force[1], 2e4, 1e-10);
  TEST_FLOATING_EQUALITY(glued.energy, whole.energy, 1e-10);
}

TEUCHOS_UNIT_TEST(FrictionScenes, SidesThatNeverPartPullAndSlide) {
  Scene scene = scenes::twoBlocks(8, 4, 4, 2e6, 0.0);
  scene.hold("lower_bottom", 0, 0.0);
  scene.hold("lower_bottom", 1, 0.0);
  scene.hold("upper_right", 0, 0.02);
  scene.traction("upper_top", {0, 1e4, 0});
  TEST_THROW(solved(scene), InputError);  // nothing holds the upper block that is pulled up
  scene = with(scene, std::make_shared<NoSeparation>());
  const MonolithicResult result = solved(scene);
  TEST_ASSERT(result.converged);
  for (int i = 0; i < scene.mesh.nodes(); ++i) {
    const Point p = scene.mesh.point(i);
    TEST_COMPARE(std::abs(result.displacement[2 * i] - (scene.mesh.bodyOfNode[i] == 0 ? 0.0 : 0.02)), <, 1e-12);
    TEST_COMPARE(std::abs(result.displacement[2 * i + 1] - 5e-3 * (p[1] + 1)), <, 1e-12);
  }
  for (const PairForce& pair : result.forces) {
    TEST_ASSERT(pair.state.status == PairStatus::Slip);
    TEST_FLOATING_EQUALITY(pair.force, -1e4 * scene.constraints.pairs[pair.id].length, 1e-9);
    TEST_EQUALITY(norm(pair.tangential), 0.0);
  }
}

/// A block that its weight of 2 x 1e4 pulls down an incline, in the frame of the incline.
Scene onIncline(double degrees, bool inSpace) {
  Box box;
  box.x1 = 2;
  box.nx = 8;
  box.ny = 4;
  if (inSpace) {
    box.ny = 2, box.nz = 2;
    box.nx = 4;
    box.cell = Cell::Hexahedron8;
  }
  Scene scene;
  scene = scenes::fromBoxes({box}, 2e6, 0.3);
  scene.model.dimension = inSpace ? 3 : 2;
  Point weight{1e4 * std::sin(degrees * kDegree), 0, 0}, down{0, 0, 0};
  down[inSpace ? 2 : 1] = -1.0;
  weight = plus(weight, scaled(1e4 * std::cos(degrees * kDegree), down));
  restOn(scene, "body_bottom", down);
  scene.model.loads.push_back(Load::bodyForce(weight));
  return scene;
}

TEUCHOS_UNIT_TEST(FrictionScenes, FrictionAloneHoldsABlockOnAnIncline) {
  for (const bool inSpace : {false, true}) {
    const Scene scene = with(onIncline(20.0, inSpace), dry(0.0, 0.5));
    const MonolithicResult result = solved(scene);
    TEST_ASSERT(result.converged);
    const Sums sums = sumsOf(scene, result);
    TEST_FLOATING_EQUALITY(-sums.force[0], 2e4 * std::sin(20.0 * kDegree), 1e-10);
    TEST_FLOATING_EQUALITY(sums.force[inSpace ? 2 : 1], 2e4 * std::cos(20.0 * kDegree), 1e-10);
    TEST_COMPARE(result.balance.imbalance, <, 1e-10);
    const auto refused = [](const Scene& slides, const std::string& says) {
      try {
        solved(slides);
      } catch (const std::exception& error) {
        return std::string(error.what()).find(says) != std::string::npos;
      }
      return false;
    };
    TEST_ASSERT(refused(with(scene, dry(0.0, 0.3)), "can move"));  // tan 20 = .364: known before the solve
    TEST_ASSERT(refused(with(scene, std::make_shared<Frictionless>()), "can move"));
    // A bound without pressure: the solver detects it. 3420 per unit area are needed.
    const MonolithicResult held = solved(with(scene, dry(4200.0, 0.0)));
    TEST_ASSERT(held.converged);
    TEST_ASSERT(refused(with(scene, dry(3300.0, 0.0)), "no equilibrium exists: body 'body' slides away"));
    TEST_ASSERT(solved(with(scene, dry(900.0, 0.3))).converged);  // 3420 - .3 x 9397 = 601
    TEST_ASSERT(refused(with(scene, dry(500.0, 0.3)), "no equilibrium exists"));
  }
}

/// 3D block on a rigid plane, its top moved down, tilted and sideways, everything rotated about the normal.
Scene turnedBlock(double angle, std::vector<int>* nodes = nullptr) {
  Box box;
  box.x1 = 2;
  box.nx = 6;
  box.ny = box.nz = 3;
  box.cell = Cell::Hexahedron8;
  Scene scene = scenes::fromBoxes({box}, 1.0, 0.3);
  scene.model.dimension = 3;
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turn = [&](const Point& p) { return Point{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]}; };
  for (const int node : scene.nodesOf("body_top")) {
    const Point p = scene.mesh.point(node);
    const Point u = turn({0.02 + 0.01 * p[1], 0.008 - 0.01 * p[0], -0.03 + 0.01 * (p[0] - 1)});
    for (int k = 0; k < 3; ++k) scene.holdNode(node, k, u[k]);
  }
  for (int i = 0; i < scene.mesh.nodes(); ++i) {
    const Point p = turn(scene.mesh.point(i));
    std::copy(p.begin(), p.end(), scene.mesh.coordinates.begin() + 3 * i);
  }
  restOn(scene, "body_bottom", {0, 0, -1});
  if (nodes) *nodes = scene.nodesOf("body_bottom");
  return scene;
}

TEUCHOS_UNIT_TEST(FrictionScenes, TheConeIn3DIsRound) {
  const double angle = 30.0 * kDegree, c = std::cos(angle), s = std::sin(angle);
  for (const LawPtr& law : {dry(0.0, 0.4), dry(0.015, 0.0), dry(0.005, 0.3)}) {
    const Scene straight = with(turnedBlock(0.0), law), turned = with(turnedBlock(angle), law);
    const MonolithicResult a = solved(straight), b = solved(turned);
    TEST_ASSERT(a.converged && b.converged);
    double worst = 0.0, largest = a.displacement.cwiseAbs().maxCoeff();
    for (int i = 0; i < straight.mesh.nodes(); ++i) {
      const Eigen::Vector3d u = a.displacement.segment<3>(3 * i), v = b.displacement.segment<3>(3 * i);
      worst = std::max(worst, (Eigen::Vector3d(c * u[0] - s * u[1], s * u[0] + c * u[1], u[2]) - v).norm());
    }
    TEST_COMPARE(worst, <, 1e-8 * largest);
    int slip = 0, stick = 0;
    for (std::size_t p = 0; p < a.forces.size(); ++p) {
      TEST_ASSERT(a.forces[p].state.status == b.forces[p].state.status);
      TEST_COMPARE(std::abs(norm(a.forces[p].tangential) - norm(b.forces[p].tangential)), <, 1e-10);
      slip += a.forces[p].state.status == PairStatus::Slip;
      stick += a.forces[p].state.status == PairStatus::Stick;
    }
    TEST_COMPARE(std::min(slip, stick), >, 0);
  }
}

TEUCHOS_UNIT_TEST(FrictionScenes, ASecondStepGoesOnFromTheSlipOfTheFirst) {
  // Solved again with its slip as that before the step, nothing slides any further: the slipping pairs stick.
  const Scene scene = with(pushedBlock(8), dry(0.0, 0.3));
  const MonolithicResult first = solved(scene);
  Scene next = scene;
  for (ContactPair& pair : next.constraints.pairs) {
    const Point tangent = pairFrame(pair.normal, 2)[1];
    const int node = pair.node();
    pair.past.slip = scaled(first.displacement[2 * node] * tangent[0] + first.displacement[2 * node + 1] * tangent[1], tangent);
  }
  const MonolithicResult second = solved(next);
  TEST_ASSERT(second.converged);
  TEST_COMPARE(distance(second.displacement, first.displacement), <, 1e-9);
  for (std::size_t p = 0; p < first.forces.size(); ++p)
    TEST_COMPARE(norm(minus(first.forces[p].tangential, second.forces[p].tangential)), <, 1e-10);
}

/// Two blocks of unit height in uniform pressure and shear, nu = 0, with the given number of cells along each, in 2D or 3D. The upper top
/// is moved so that the line between them slips by `slip`, under the shear stress that Hooke's law gives for `shear`.
struct Patch {
  static constexpr double young = 2e6, shear = 1e-2, along = 0.6, across = 0.8;
  Scene scene;
  double slip;

  Patch(int dimension, int lowerCells, int upperCells, double strain, double slips, const LawPtr& law, bool swapped = false) : slip(slips) {
    Box lower, upper;
    lower.name = "lower", upper.name = "upper";
    (dimension == 2 ? lower.y0 : lower.z0) = -1;
    (dimension == 2 ? lower.y1 : lower.z1) = 0;
    for (Box* box : {&lower, &upper}) {
      box->nx = box->ny = box->nz = box == &lower ? lowerCells : upperCells;
      if (dimension == 3) box->cell = Cell::Hexahedron8;
    }
    scene = scenes::fromBoxes({lower, upper}, young, 0.0);
    scene.model.dimension = dimension;
    scene.constraints = swapped ? buildConstraints(scene.mesh, {}, {Contact::between("upper_bottom", "lower_top")})
                                : buildConstraints(scene.mesh, {}, {Contact::between("lower_top", "upper_bottom")});
    strain_ = strain;
    for (const char* side : {"lower_bottom", "upper_top"})
      for (const int node : scene.nodesOf(side)) {
        const Point u = exact(node);
        for (int k = 0; k < dimension; ++k) scene.holdNode(node, k, u[k]);
      }
    // Shear stresses on the other sides.
    const double stress = young / 2.0 * shear;
    for (const std::string body : {"lower", "upper"})
      for (const double sign : {-1.0, 1.0}) {
        Point ofX{0, 0, 0}, ofY{0, 0, 0};
        ofX[dimension - 1] = sign * stress * (dimension == 2 ? 1.0 : along);
        ofY[dimension - 1] = sign * stress * across;
        scene.traction(body + (sign < 0.0 ? "_left" : "_right"), ofX);
        if (dimension == 3) scene.traction(body + (sign < 0.0 ? "_front" : "_back"), ofY);
      }
    scene = with(scene, law);
  }

  Point exact(int node) const {
    const int dimension = scene.mesh.dimension;
    const double height = scene.mesh.point(node)[dimension - 1] + 1.0;
    const double by = shear * height + (scene.mesh.bodyOfNode[node] == 1 ? slip : 0.0);
    Point u{by, 0, 0};
    if (dimension == 3) u = {along * by, across * by, 0};
    u[dimension - 1] = strain_ * height;
    return u;
  }

  double error(const MonolithicResult& result) const {
    double worst = 0.0;
    for (int node = 0; node < scene.mesh.nodes(); ++node)
      for (int k = 0; k < scene.mesh.dimension; ++k)
        worst = std::max(worst, std::abs(result.displacement[Eigen::Index(node) * scene.mesh.dimension + k] - exact(node)[k]));
    return worst / shear;
  }

 private:
  double strain_ = 0.0;
};

TEUCHOS_UNIT_TEST(FrictionScenes, MatchingAndMortarPassThePatchTest) {
  const double stress = Patch::young / 2.0 * Patch::shear, pressure = Patch::young * 0.02;
  for (const int dimension : {2, 3})
    for (const int upper : {4, 3})
      for (const bool swapped : {false, true}) {
        const std::pair<LawPtr, double> cases[] = {{std::make_shared<Tied>(), 0.0},           // pulled apart
                                                   {dry(0.0, 1.1 * stress / pressure), 0.0},  // sticks
                                                   {dry(0.0, stress / pressure), 0.003},      // slips
                                                   {dry(stress, 0.0), 0.003},
                                                   {dry(0.4 * stress, 0.6 * stress / pressure), 0.003}};
        for (const auto& [law, slip] : cases) {
          const Patch patch(dimension, 4, upper, law->separates() ? -0.02 : 0.02, slip, law, swapped);
          const MonolithicResult result = solved(patch.scene);
          TEST_ASSERT(result.converged);
          TEST_COMPARE(patch.error(result), <, 1e-9);
          TEST_COMPARE(result.balance.imbalance, <, 1e-10);
          for (const PairForce& pair : result.forces) {
            const ContactPair& place = patch.scene.constraints.pairs[pair.id];
            TEST_FLOATING_EQUALITY(pair.force, (law->separates() ? 1.0 : -1.0) * pressure * place.length, 1e-8);
            TEST_FLOATING_EQUALITY(norm(pair.tangential), stress * place.length, 1e-8);
            TEST_ASSERT(pair.state.status == (slip > 0.0 ? PairStatus::Slip : PairStatus::Stick));
          }
        }
      }
}

TEUCHOS_UNIT_TEST(FrictionScenes, RandomPushesAndLoadsAreAllSolved) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  int most = 0, open = 0, slip = 0, stick = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const bool inSpace = trial % 5 == 0, loose = trial % 2 == 0;
    const double mu = 0.75 * (1.0 + value(random));
    Scene scene = inSpace ? turnedBlock(0.0) : pushedBlock(8);
    const int dimension = scene.mesh.dimension;
    Point push{0, 0, 0}, tilt{0, 0, 0};
    for (int k = 0; k + 1 < dimension; ++k) push[k] = 0.05 * value(random), tilt[k] = 0.05 * value(random);
    scene.constraints.rules.clear();
    if (loose) {  // a load on the top inside the cone, off the middle
      push[dimension - 1] = -0.08;
      for (int k = 0; k + 1 < dimension; ++k) push[k] *= 1.1 * mu / std::sqrt(dimension - 1.0);
      Load load = Load::traction("body_top", push);
      load.place = {1, inSpace ? 0.5 : 1.0, inSpace ? 1.0 : 0.0};
      load.spin = {0.02 * value(random) * inSpace, 0.0, inSpace ? 0.0 : 0.02 * value(random)};
      scene.model.loads.push_back(load);
    }
    for (const int node : scene.nodesOf("body_top")) {
      if (loose) break;
      const Point p = scene.mesh.point(node);
      for (int k = 0; k + 1 < dimension; ++k) scene.holdNode(node, k, push[k]);
      scene.holdNode(node, dimension - 1, -0.03 + tilt[0] * (p[0] - 1) + tilt[1] * (p[1] - 0.5));
    }
    scene = with(scene, dry(0.0, mu));
    const MonolithicResult result = solved(scene);
    TEST_ASSERT(result.converged);
    if (!result.converged) out << "trial " << trial << " mu " << mu << ": " << result.failure << "\n";
    most = std::max(most, result.iterations);
    TEST_COMPARE(result.balance.imbalance, <, 1e-10);
    double largest = 0.0;
    for (const PairForce& pair : result.forces) largest = std::max(largest, pair.force);
    for (const PairForce& pair : result.forces) {
      const Vector own = result.displacement.segment(Eigen::Index(scene.constraints.pairs[pair.id].node()) * dimension, dimension);
      const double gap = own[dimension - 1], slips = own.head(dimension - 1).norm(), bound = mu * pair.force, size = norm(pair.tangential);
      TEST_COMPARE(gap, >, -1e-10);
      TEST_COMPARE(pair.force, >=, 0.0);
      TEST_COMPARE(std::min(gap, pair.force / largest), <, 1e-9);
      TEST_COMPARE(size, <, bound + 1e-9 * largest);
      if (bound - size > 1e-8 * largest) TEST_COMPARE(slips, <, 1e-9);  // u_A - u_B is the displacement: along the force where it slips
      if (slips > 1e-9 && bound > 1e-9 * largest)
        for (int k = 0; k + 1 < dimension; ++k) TEST_COMPARE(std::abs(pair.tangential[k] / size - own[k] / slips), <, 1e-5);
      ++(pair.state.status == PairStatus::Open ? open : pair.state.status == PairStatus::Slip ? slip : stick);
    }
  }
  TEST_COMPARE(most, <, 80);
  TEST_COMPARE(std::min({open, slip, stick}), >, 200);
}

}  // namespace
}  // namespace suture
