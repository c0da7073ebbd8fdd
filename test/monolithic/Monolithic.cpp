#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Errors.hpp>
#include <suture/monolithic/Monolithic.hpp>
#include <suture/monolithic/MonolithicSystem.hpp>

#include <support/SmallScenes.hpp>

#include <Eigen/Dense>
#include <cmath>

namespace suture {
namespace {

using scenes::Scene;

MonolithicResult solve(const Scene& scene) {
  Monitor quiet;
  return solveMonolithic(scene.mesh, scene.constraints, scene.model, {}, quiet);
}

// Largest distance of the displacement from a formula.
template <typename Formula>
double distance(const Scene& scene, const MonolithicResult& result, Formula formula) {
  double largest = 0;
  for (int i = 0; i < scene.mesh.nodes(); ++i) {
    const Point u = formula(scene.mesh.point(i), scene.mesh.bodyOfNode[i]);
    for (int k = 0; k < 2; ++k) largest = std::max(largest, std::abs(result.displacement[2 * i + k] - u[k]));
  }
  return largest;
}

double totalForce(const MonolithicResult& result) {
  double sum = 0;
  for (const PairResult& pair : result.pairs) sum += pair.force;
  return sum;
}

Scene pushed(double lower, double upper, double by) {
  Scene scene = scenes::twoBlocks(8, 4, 5);
  scene.model.materialOfBody[0].young = lower;
  scene.model.materialOfBody[1].young = upper;
  scene.fixLower();
  scene.hold("upper_top", 0, 0.0);
  scene.hold("upper_top", 1, -by);
  return scene;
}

TEUCHOS_UNIT_TEST(Monolithic, PassesThePatchTestForAnyRatioOfYoungModuli) {
  for (const double ratio : {1.0, 100.0, 1e-4, 1e8}) {
    const double lower = 2e6, upper = ratio * lower, by = 0.1, pressure = by / (1 / lower + 1 / upper);
    const MonolithicResult result = solve(pushed(lower, upper, by));
    TEST_ASSERT(result.converged);
    const double error = distance(pushed(lower, upper, by), result, [&](const Point& p, int body) {
      return Point{0, body == 0 ? -pressure / lower * (1 + p[1]) : -by + pressure / upper * (1 - p[1]), 0};
    });
    TEST_COMPARE(error, <, 1e-11 * by);
    for (const PairResult& pair : result.pairs) {
      TEST_FLOATING_EQUALITY(pair.pressure, pressure, 1e-11);
      TEST_ASSERT(pair.state == PairStatus::Slip);
      TEST_COMPARE(std::abs(pair.gap), <, 1e-12 * by);
    }
    // Forces and energy follow from the displacement, whose last digit corresponds to that force in a body so much stiffer.
    const double digits = std::max(1.0, 1e-3 * std::max(ratio, 1 / ratio));
    TEST_COMPARE(result.balance.imbalance, <, 1e-11 * digits);
    // energy of two uniformly compressed blocks of area 2
    const double energy = pressure * pressure * (1 / lower + 1 / upper);
    TEST_FLOATING_EQUALITY(result.energy, energy, 1e-10 * digits);
    TEST_FLOATING_EQUALITY(result.rows.back().energy, energy, 1e-10 * digits);
    TEST_EQUALITY(result.rows.back().pcg, 0);
  }
}

TEUCHOS_UNIT_TEST(Monolithic, ClosesAGapBeforeItPresses) {
  for (const double by : {0.04, 0.1}) {
    Scene scene = pushed(2e6, 2e6, by);
    scene.gap = 0.05;
    scene.pairUp();
    const MonolithicResult result = solve(scene);
    TEST_ASSERT(result.converged);
    const bool touches = by > scene.gap;
    for (const PairResult& pair : result.pairs) {
      TEST_ASSERT(pair.state == (touches ? PairStatus::Slip : PairStatus::Open));
      TEST_COMPARE(std::abs(pair.gap - std::max(0.0, scene.gap - by)), <, 1e-12);
      TEST_EQUALITY(pair.initialGap, scene.gap);
    }
    TEST_COMPARE(std::abs(totalForce(result) - 2 * std::max(0.0, 1e6 * (by - scene.gap))), <, 1e-6);
  }
}

TEUCHOS_UNIT_TEST(Monolithic, InterferencePressesWithoutLoad) {
  Scene scene = pushed(2e6, 2e6, 0.0);
  scene.gap = -0.02;
  scene.pairUp();
  const MonolithicResult result = solve(scene);
  TEST_ASSERT(result.converged);
  for (const PairResult& pair : result.pairs) TEST_FLOATING_EQUALITY(pair.pressure, 0.02 * 1e6, 1e-11);
}

TEUCHOS_UNIT_TEST(Monolithic, SolvesABodyHeldByContactOnly) {
  const double pressure = 3e4, young = 2e6;
  for (const bool onePoint : {false, true}) {
    Scene scene = scenes::twoBlocks(8, 4, 5);
    scene.fixLower();
    if (onePoint) {
      scene.holdNode(scene.constraints.pairs[0].ends[1].node, 0, 0.0);
    } else {
      scene.hold("upper_left", 0, 0.0);
    }
    scene.pressure("upper_top", pressure);
    const MonolithicResult result = solve(scene);
    TEST_ASSERT(result.converged);
    TEST_COMPARE(distance(scene, result, [&](const Point& p, int) { return Point{0, -pressure / young * (1 + p[1]), 0}; }), <, 1e-11);
    TEST_FLOATING_EQUALITY(totalForce(result), 2 * pressure, 1e-11);
    TEST_FLOATING_EQUALITY(result.balance.applied[1], -2 * pressure, 1e-13);
    TEST_FLOATING_EQUALITY(result.balance.reactions[1], 2 * pressure, 1e-11);
    TEST_COMPARE(result.balance.imbalance, <, 1e-11);
  }
}

TEUCHOS_UNIT_TEST(Monolithic, ALooseBodyMayLiftPartOfItsSeat) {
  // pressed at its left end only: moments about the seat decide which pairs stay closed; forces balance for any choice
  Scene scene = scenes::twoBlocks(16, 8, 8, 2e6, 0.3);
  scene.fixLower();
  scene.hold("upper_right", 0, 0.0);
  scene.traction("upper_left", {0, -1e4, 0});
  scene.pressure("upper_top", 2e4);
  const MonolithicResult result = solve(scene);
  TEST_ASSERT(result.converged);
  TEST_FLOATING_EQUALITY(totalForce(result), 1e4 + 2 * 2e4, 1e-10);
  for (const PairResult& pair : result.pairs) {
    TEST_COMPARE(pair.gap, >, -1e-13);
    TEST_COMPARE(pair.force, >=, 0.0);
    TEST_COMPARE(std::abs(pair.gap * pair.force), <, 1e-9);
  }
  TEST_COMPARE(result.balance.imbalance, <, 1e-10);
}

TEUCHOS_UNIT_TEST(Monolithic, OpensWhatTheEnumerationOfAllActiveSetsOpens) {
  int open = 0, closed = 0;
  for (int trial = 0; trial < 12; ++trial) {
    Scene scene = scenes::twoBlocks(6, 3, 3, 2e6, 0.3);
    scene.fixLower();
    scene.hold("upper_top", 0, 0.0);
    for (const int node : scene.nodesOf("upper_top")) {
      const double x = scene.mesh.point(node)[0];
      scene.holdNode(node, 1, -1e-3 * (0.3 + std::cos(3 * x + trial) + 0.5 * std::sin(7 * x * trial)));
    }
    for (ContactPair& pair : scene.constraints.pairs) pair.gap = 5e-4 * std::sin(5.0 * pair.id + trial);
    const MonolithicSystem system(scene.mesh, scene.constraints, scene.model);
    const Matrix k = system.stiffness().dense();
    const int n = system.dofs(), p = int(system.rows().size()), leading = n - system.contactDofs();
    Matrix c = Matrix::Zero(p, n);
    Vector bounds(p);
    for (int i = 0; i < p; ++i) {
      bounds[i] = system.rows()[i].bound;
      for (std::size_t e = 0; e < system.rows()[i].dofs.size(); ++e)
        c(i, leading + system.rows()[i].dofs[e]) = system.rows()[i].coefficients[e];
    }
    const Eigen::LDLT<Matrix> factor(k);
    const Vector freeSolution = factor.solve(system.load());
    const Matrix compliance = c * factor.solve(Matrix(c.transpose()));
    int solutions = 0;
    Vector expected, force;
    for (int set = 0; set < (1 << p); ++set) {
      std::vector<int> a;
      for (int i = 0; i < p; ++i)
        if (set & (1 << i)) a.push_back(i);
      Vector pressing = Vector::Zero(p);
      const Vector penetration = c * freeSolution - bounds;
      if (!a.empty()) pressing(a) = Vector(Matrix(compliance(a, a)).ldlt().solve(Vector(penetration(a))));
      const Vector gap = compliance * pressing - penetration;
      if (pressing.minCoeff() < -1e-7 || gap.minCoeff() < -1e-12) continue;
      ++solutions;
      force = pressing;
      expected = system.expand(freeSolution - factor.solve(Vector(c.transpose() * pressing)));
    }
    TEST_EQUALITY(solutions, 1);
    const MonolithicResult result = solve(scene);
    TEST_ASSERT(result.converged);
    TEST_COMPARE((result.displacement - expected).norm(), <, 1e-11 * expected.norm());
    for (int i = 0; i < p; ++i) {
      TEST_EQUALITY(result.pairs[i].state == PairStatus::Slip, force[i] > 0);
      TEST_COMPARE(std::abs(result.pairs[i].force - force[i]), <, 1e-9 * force.maxCoeff());
      (force[i] > 0 ? closed : open) += 1;
    }
  }
  TEST_COMPARE(std::min(open, closed), >, 10);
}

TEUCHOS_UNIT_TEST(Monolithic, AxesOfTheNodesDoNotMatter) {
  const auto build = [](bool rotated) {
    Scene scene = scenes::twoBlocks(8, 4, 4, 2e6, 0.3);
    scene.fixLower();
    scene.hold("upper_top", 0, 0.001);
    scene.hold("upper_top", 1, -0.002);
    scene.pressure("upper_left", 1e3);
    scene.pressure("lower_right", 5e2);
    for (ContactPair& pair : scene.constraints.pairs) {
      pair.normal = {0.28, 0.96, 0};
      if (!rotated) continue;
      for (const int node : {pair.ends[0].node, pair.ends[1].node})
        scene.ruleOf(node).axes = {{{0.28, 0.96, 0}, {-0.96, 0.28, 0}, {0, 0, 1}}};
    }
    return scene;
  };
  const MonolithicResult plain = solve(build(false)), rotated = solve(build(true));
  TEST_ASSERT(plain.converged && rotated.converged);
  TEST_EQUALITY(plain.contactDofs, 2 * rotated.contactDofs);  // one per node in the axes of its pair
  TEST_COMPARE((plain.displacement - rotated.displacement).norm(), <, 1e-11 * plain.displacement.norm());
  TEST_FLOATING_EQUALITY(totalForce(plain), totalForce(rotated), 1e-10);
}

TEUCHOS_UNIT_TEST(Monolithic, OrderingChangesTheFactorNotTheAnswer) {
  Scene scene = scenes::twoBlocks(24, 12, 12, 2e6, 0.3);
  scene.fixLower();
  scene.hold("upper_top", 0, 0.0);
  scene.pressure("upper_top", 1e4);
  for (ContactPair& pair : scene.constraints.pairs) pair.gap = 1e-3 * pair.position[0] * pair.position[0];
  const auto solved = [&](CholmodOptions::Ordering ordering) {
    MonolithicOptions options;
    options.ordering = ordering;
    Monitor quiet;
    return solveMonolithic(scene.mesh, scene.constraints, scene.model, options, quiet);
  };
  const MonolithicResult amd = solved(CholmodOptions::Ordering::Amd), metis = solved(CholmodOptions::Ordering::Metis);
  TEST_ASSERT(amd.converged && metis.converged);
  TEST_INEQUALITY(amd.factorEntries, metis.factorEntries);
  TEST_COMPARE((amd.displacement - metis.displacement).norm(), <, 1e-11 * amd.displacement.norm());
  for (std::size_t i = 0; i < amd.pairs.size(); ++i) {
    TEST_ASSERT(amd.pairs[i].state == metis.pairs[i].state);
    TEST_COMPARE(std::abs(amd.pairs[i].force - metis.pairs[i].force), <, 1e-9 * totalForce(amd));
  }
}

TEUCHOS_UNIT_TEST(Monolithic, ScalesTheRowOfANodeWithAPrescribedComponent) {
  // All nodes slide vertically between guides; the contact plane is inclined. Vertically the gap is g / n_y, and the wall takes the
  // horizontal force.
  const double gap = 0.01, by = 0.1, ny = 0.8, pressure = 1e6 * (by - gap / ny);
  Scene scene = pushed(2e6, 2e6, by);
  for (int i = 0; i < scene.mesh.nodes(); ++i) scene.holdNode(i, 0, 0.0);
  for (ContactPair& pair : scene.constraints.pairs) {
    pair.normal = {0.6, ny, 0};
    pair.gap = gap;
  }
  const MonolithicResult result = solve(scene);
  TEST_ASSERT(result.converged);
  for (const PairResult& pair : result.pairs) TEST_FLOATING_EQUALITY(pair.pressure, pressure / ny, 1e-11);
  TEST_COMPARE(distance(scene, result,
                        [&](const Point& p, int body) {
                          return Point{0, body == 0 ? -pressure / 2e6 * (1 + p[1]) : -by + pressure / 2e6 * (1 - p[1]), 0};
                        }),
               <, 1e-12);
  TEST_COMPARE(result.balance.imbalance, <, 1e-11);
}

TEUCHOS_UNIT_TEST(Monolithic, AnInclinedPrescribedValueEntersTheGap) {
  // the lower contact nodes are pushed up by a prescribed amount: their rows have dofs of the upper block only
  Scene scene = pushed(2e6, 2e6, 0.0);
  scene.hold("lower_top", 1, 0.03);
  const MonolithicResult result = solve(scene);
  TEST_ASSERT(result.converged);
  for (const PairResult& pair : result.pairs) TEST_FLOATING_EQUALITY(pair.pressure, 0.03 * 2e6, 1e-11);
}

TEUCHOS_UNIT_TEST(Monolithic, SolvesALinearSceneInOneStep) {
  Box bar;
  bar.name = "bar";
  bar.x1 = 4;
  bar.nx = 16;
  bar.ny = 4;
  Scene scene = scenes::fromBoxes({bar}, 1e5, 0.0);
  scene.hold("bar_left", 0, 0.0);
  scene.hold("bar_bottom", 1, 0.0);
  scene.traction("bar_right", {250, 0, 0});
  const MonolithicResult result = solve(scene);
  TEST_ASSERT(result.converged);
  TEST_EQUALITY(result.iterations, 0);
  TEST_COMPARE(distance(scene, result, [](const Point& p, int) { return Point{250 / 1e5 * p[0], 0, 0}; }), <, 1e-14);
  TEST_FLOATING_EQUALITY(result.energy, -0.5 * 250 * 250 / 1e5 * 4, 1e-12);
  TEST_FLOATING_EQUALITY(result.balance.reactions[0], -250.0, 1e-12);
}

TEUCHOS_UNIT_TEST(Monolithic, RefusesASceneWithoutSolution) {
  Scene scene = scenes::twoBlocks(4, 2, 2);
  scene.fixLower();
  scene.hold("upper_left", 0, 0.0);
  scene.pressure("upper_top", -1.0);
  TEST_THROW(solve(scene), InputError);
}

}  // namespace
}  // namespace suture
