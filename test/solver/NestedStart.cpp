// A fine mesh that starts from the answer of a coarse one.
#include <Teuchos_UnitTestHarness.hpp>
#include <answer/SolidScenes.hpp>
#include <interface/DenseSpace.hpp>
#include <solver/ContactMethods.hpp>
#include <suture/base/Point.hpp>
#include <suture/solver/SolveInterface.hpp>
#include <suture/solver/nested/NestedStart.hpp>

namespace suture {
namespace {

using namespace blocks;

/// A displacement of each body, linear in the coordinates.
Point linear(int body, const Point& p) {
  return {0.3 - body + 2.0 * p[0] - 0.7 * p[1], 0.1 + 0.4 * body - (1.0 + body) * p[0] + 0.9 * p[1], 0};
}

Vector linear(const SubdomainMesh& mesh) {
  Vector u(2 * mesh.nodes());
  for (int node = 0; node < mesh.nodes(); ++node)
    for (int k = 0; k < 2; ++k) u(2 * node + k) = linear(mesh.body, mesh.point(node))[k];
  return u;
}

CoarseAnswer linearAnswer(const Blocks& coarse) {
  CoarseAnswer answer;
  answer.meshes = coarse.meshes;
  for (const SubdomainMesh& mesh : coarse.meshes) answer.solution.displacement.push_back(linear(mesh));
  return answer;
}

/// Two blocks of other cells than in pressedBlocks(), with non-matching nodes.
Scene quadrilaterals() {
  std::vector<Box> all = twoBoxes(9, 5, 3, 1);
  for (Box& box : all) box.cell = Cell::Quadrilateral4;
  Scene scene = scenes::fromBoxes(all);
  scene.pairUp();
  return scene;
}

TEUCHOS_UNIT_TEST(NestedStart, InterpolatesLinearFieldsOfEachBodyExactly) {
  const Blocks fine(pressedBlocks(2), world(), 7, 3, false);  // partitioned differently from the coarse one: points are on other ranks
  std::vector<Point> points;
  std::vector<int> bodies;
  for (const SubdomainMesh& mesh : fine.meshes)
    for (int node = 0; node < mesh.nodes(); ++node) {
      points.push_back(mesh.point(node));
      bodies.push_back(mesh.body);                                              // bodies of two points on the line, one of each
      points.push_back({1.02 * points.back()[0], 1.02 * points.back()[1], 0});  // just outside, where linear fields continue
      bodies.push_back(mesh.body);
    }
  for (const Scene& scene : {pressedBlocks(), quadrilaterals()}) {
    const Blocks coarse(scene, world(), std::vector<double>(), false);
    const Matrix values = interpolate(*world(), linearAnswer(coarse), points, bodies);
    TEST_EQUALITY(values.rows(), int(points.size()));
    double error = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int k = 0; k < 2; ++k) error = std::max(error, std::abs(values(int(i), k) - linear(bodies[i], points[i])[k]));
    TEST_COMPARE(error, <, 1e-12);
  }
}

/// Between 3D meshes of other cells; points just outside, too.
TEUCHOS_UNIT_TEST(NestedStart, InterpolatesLinearFieldsIn3DExactly) {
  const auto field = [](const Point& p) { return Point{1 + p[0] - 2 * p[1] + p[2], 0.5 * p[0] + p[2], p[1] - 3 * p[2]}; };
  const auto fine = solids::distributed(solids::fromBoxes({solids::cube(Cell::Hexahedron20, 4, 2)}, 1.0, 0.3));
  std::vector<Point> points;
  for (const SubdomainMesh& mesh : fine)
    for (int node = 0; node < mesh.nodes(); ++node)
      for (const double size : {1.0, 1.05}) points.push_back(scaled(size, mesh.point(node)));
  for (const Cell cell : solids::cells()) {
    scenes::Scene scene = solids::fromBoxes({solids::cube(cell, 3)}, 1.0, 0.3);
    solids::distort(scene.mesh, 0.03);
    CoarseAnswer coarse;
    coarse.meshes = solids::distributed(scene);
    coarse.solution.displacement = solids::atNodes(coarse.meshes, field);
    const Matrix values = interpolate(*world(), coarse, points, std::vector<int>(points.size(), 0));
    double error = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      for (int k = 0; k < 3; ++k) error = std::max(error, std::abs(values(int(i), k) - field(points[i])[std::size_t(k)]));
    TEST_COMPARE(error, <, 1e-11);
  }
}

TEUCHOS_UNIT_TEST(NestedStart, BeginsWithTheDisplacementsOnTheInterface) {
  const Blocks coarse(pressedBlocks(), world(), std::vector<double>(), false);
  const OnInterface fine(pressedBlocks(3), world());
  const InterfaceState state = stateOf(nestedStart(*world(), linearAnswer(coarse), fine.all.meshes), fine.problem, fine.all.subdomains);
  std::vector<Vector> exact;
  for (std::size_t s = 0; s < fine.all.subdomains.size(); ++s)
    exact.push_back(fine.all.subdomains[s]->freeValues(linear(fine.all.meshes[s])));
  std::map<int, ContactState> closed;  // no pairs in the coarse answer
  const InterfaceState expected = fine.problem.stateOf(exact, closed);
  const DenseSpace all(*fine.problem.space());
  TEST_COMPARE(all.dense(*expected.trace).norm(), >, 1.0);
  TEST_COMPARE(difference(all.dense(*state.trace), all.dense(*expected.trace)), <, 1e-12);
  TEST_ASSERT(fine.problem.differing(state.status, expected.status).empty());
}

TEUCHOS_UNIT_TEST(NestedStart, FinePairsBetweenTwoOfOneStatusHaveIt) {
  const Scene coarseScene = pressedBlocks(), fineScene = pressedBlocks(3);
  const Blocks coarse(coarseScene, world(), std::vector<double>(), false);
  CoarseAnswer answer = linearAnswer(coarse);
  std::map<int, ContactState> coarseStatus;
  const std::vector<ContactState> pattern{{PairStatus::Slip, {1, 0, 0}, 2.5},
                                          PairStatus::Slip,
                                          PairStatus::Open,
                                          PairStatus::Open,
                                          PairStatus::Open,
                                          PairStatus::Slip,
                                          PairStatus::Open};
  TEST_EQUALITY(coarseScene.constraints.pairs.size(), pattern.size());
  for (const ContactPair& pair : coarseScene.constraints.pairs) {
    PairResult result;
    result.id = pair.id;
    result.line = pair.line;
    result.arc = pair.arc;
    result.position = pair.position;
    result.state = coarseStatus[pair.id] = pattern.at(pair.id);
    if (world()->getRank() == 0) answer.solution.pairs.push_back(result);  // as recover() returns it
  }
  // Three fine steps per coarse step: fine pair 3 c + k lies between the coarse pairs c and c + 1, nearer to c for k = 1.
  std::map<int, ContactState> expected;
  for (const ContactPair& pair : fineScene.constraints.pairs) {
    const int before = pair.id / 3, k = pair.id % 3;
    expected[pair.id] = pattern.at(k == 2 ? before + 1 : before);
    TEST_FLOATING_EQUALITY(1.0 + pair.arc, 1.0 + coarseScene.constraints.pairs[before].arc + k / 9.0, 1e-12);
  }
  const OnInterface fine(fineScene, world());
  const InterfaceState state = stateOf(nestedStart(*world(), answer, fine.all.meshes), fine.problem, fine.all.subdomains);
  TEST_ASSERT(fine.problem.differing(state.status, fine.problem.stateOf(zeros(fine.all), expected).status).empty());
  TEST_EQUALITY(fine.problem.differing(state.status, fine.problem.initialState().status).size(),
                std::size_t(std::count_if(expected.begin(), expected.end(), [](const auto& e) { return e.second != PairStatus::Slip; })));
}

TEUCHOS_UNIT_TEST(NestedStart, LeadsToTheSameSolutionInFewerSteps) {
  const OnInterface coarse(pressedBlocks(8), world()), fine(pressedBlocks(16), world());
  const OuterResult onCoarse = solveWith("Active Set", coarse.problem);
  TEST_ASSERT(onCoarse.converged);
  Parameters scene;
  scene.sublist("Outer Solver").set("Type", std::string("Active Set"));
  const CoarseAnswer answer{coarse.all.meshes, recover(*world(), coarse.problem, onCoarse, coarse.all.subdomains, scene)};
  const InterfaceState start = stateOf(nestedStart(*world(), answer, fine.all.meshes), fine.problem, fine.all.subdomains);

  const OuterResult from = solveWith("Active Set", fine.problem, 1e-10, "BDDC", &start), plain = solveWith("Active Set", fine.problem);
  TEST_ASSERT(from.converged && plain.converged);
  TEST_ASSERT(fine.problem.differing(from.state.status, plain.state.status).empty());
  const DenseSpace all(*fine.problem.space());
  TEST_COMPARE(difference(all.dense(*from.state.trace), all.dense(*plain.state.trace)), <, 1e-7);
  const std::size_t wrong = fine.problem.differing(start.status, plain.state.status).size();
  out << "steps " << from.iterations << " and " << plain.iterations << ", PCG " << from.pcgTotal << " and " << plain.pcgTotal << " + "
      << plain.auxiliary.pcg << "; pairs wrong at the start " << wrong << "\n";
  TEST_COMPARE(wrong, <=, 4);  // one fine pair next to each end of a closed part
  TEST_COMPARE(fine.problem.differing(fine.problem.initialState().status, plain.state.status).size(), >, 4);
  TEST_COMPARE(from.iterations, <, plain.iterations);
}

}  // namespace
}  // namespace suture
