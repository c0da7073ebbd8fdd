#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/DensePair.hpp>
#include <precond/Preconditioners.hpp>
#include <support/Cases.hpp>

#include <random>

namespace suture {
namespace {

using namespace blocks;

void isSymmetricWithNoEigenvalueBelowOne(const Teuchos::RCP<const InterfaceOperator>& matrix, bool& success, Teuchos::FancyOStream& out) {
  for (const char* edges : {"None", "Averages", "Rigid Modes"}) {
    const DensePair pair(*matrix, *bddc(matrix, edges));
    TEST_COMPARE(std::abs(pair.idle), <, 1e-12 * pair.m.norm());
    TEST_COMPARE(difference(pair.m, pair.m.transpose()), <, 1e-10);
    const Vector values = pair.eigenvalues();
    out << edges << ": " << values(0) << " .. " << values(values.size() - 1) << "\n";
    TEST_COMPARE(values(0), >, 1.0 - 1e-9);
    TEST_COMPARE(values(0), <, 1.0 + 1e-8);
  }
}

TEUCHOS_UNIT_TEST(Bddc, HasNoEigenvalueBelowOneWithoutContact) {
  isSymmetricWithNoEigenvalueBelowOne(Twins(clampedSquare(3, 3)).spread.linearised.matrix, success, out);
}

TEUCHOS_UNIT_TEST(Bddc, HasNoEigenvalueBelowOneWithClosedAndOpenPairs) {
  for (const Scene& scene : casesOf({turned(crossingBlocks(), 0.5), pressedBlocks(), heldOnTheLine()}))
    for (const int open : {0, 3}) {
      const OnInterface one(scene, world());
      isSymmetricWithNoEigenvalueBelowOne(one.matrix(scene, open), success, out);
    }
}

TEUCHOS_UNIT_TEST(Bddc, HasNoEigenvalueBelowOneOnCondensedGroups) {
  for (const Scene& scene : {pressedBlocks(), stackedBlocks(2)})
    isSymmetricWithNoEigenvalueBelowOne(Twins(scene).spread.linearised.matrix, success, out);
}

// Two subdomains, a seam of three nodes: its ends are corners, both components of the middle one are edge constraints.
TEUCHOS_UNIT_TEST(Bddc, IsTheInverseWhenAllUnknownsArePrimal) {
  Box box;
  box.nx = 6;
  box.ny = 2;
  box.blocksX = 2;
  Scene scene = scenes::fromBoxes({box}, 3.0, 0.3);
  scene.hold("body_left", 0, 0.0);
  scene.hold("body_left", 1, 0.0);
  const Twins t(scene);
  const auto m = bddc(t.spread.linearised.matrix);
  TEST_EQUALITY(m->coarseSize(), 6);
  const DensePair pair(t.spread.matrix(), *m);
  TEST_EQUALITY(pair.s.rows(), 6);
  TEST_COMPARE((pair.m * pair.s - Matrix::Identity(6, 6)).norm(), <, 1e-11);
}

TEUCHOS_UNIT_TEST(Bddc, CoarseProblemCountsCornersAndEdges) {
  const Twins t(clampedSquare(3, 4));  // 12 edges; 4 cross points and 8 ends of seams, two of them held
  TEST_EQUALITY(bddc(t.spread.linearised.matrix, "None")->coarseSize(), 2 * (4 + 6));
  TEST_EQUALITY(bddc(t.spread.linearised.matrix, "Averages")->coarseSize(), 2 * (4 + 6) + 2 * 12);
  TEST_EQUALITY(bddc(t.spread.linearised.matrix, "Rigid Modes")->coarseSize(), 2 * (4 + 6) + 3 * 12);
}

Lanczos condition(const Scene& scene, const std::string& edges, const std::string& weighting = "Stiffness Diagonal",
                  const std::vector<double>& youngOf = {}) {
  const Twins t(scene, youngOf);
  const auto m = bddc(t.spread.linearised.matrix, edges, weighting);
  return conjugateGradients(t.spread.matrix(), *m, *t.spread.space, *t.toSpread(random(t.size(), 1, 5)));
}

TEUCHOS_UNIT_TEST(Bddc, ConditionDoesNotFeelAnAlignedJumpOf1e6) {
  const Scene scene = clampedSquare(4, 4, 1.0, 0.25);
  for (const bool columns : {true, false})
    for (const char* weighting : {"Stiffness Diagonal", "Young"}) {
      const double found = condition(scene, "Rigid Modes", weighting, board(4, 1e6, columns)).condition;
      out << (columns ? "columns, " : "chess board, ") << weighting << ": condition " << found << "\n";
      TEST_COMPARE(found, <, 2.0);
    }
}

// Clamped squares of mixed elements, their inner lines bent so that averages along the seams differ from the flux through them. Ragged:
// nodes moved at random, too, so that stiffness weights change from node to node.
Scene softSquare(Cell cell, double poisson, bool ragged = false) {
  Box box;
  box.nx = box.ny = 16;
  box.blocksX = box.blocksY = 4;
  box.cell = cell;
  Scene scene = scenes::fromBoxes({box}, 2 * (1 + poisson), poisson);
  scene.model.materialOfBody[0].element = ElementForm::Mixed;
  std::mt19937 next(3);
  for (int node = 0; node < scene.mesh.nodes(); ++node) {
    double* x = &scene.mesh.coordinates[2 * node];
    const bool inside = x[0] > 0 && x[0] < 1 && x[1] > 0 && x[1] < 1;
    const double bump = std::sin(3.14159265358979 * x[0]) * std::sin(3.14159265358979 * x[1]);
    x[0] += 0.06 * bump;
    x[1] -= 0.04 * bump;
    for (int k = 0; ragged && inside && k < 2; ++k) x[k] += 0.4 / box.nx * (next() / 4294967295.0 - 0.5);
  }
  scene.hold("body_left", 0, 0.0);
  scene.hold("body_left", 1, 0.0);
  return scene;
}

TEUCHOS_UNIT_TEST(Bddc, ConditionOfMixedElementsDoesNotGrowAsPoissonsRatioTendsToOneHalf) {
  // Quadrilateral4: a subdomain of a structured mesh is also stiff against its checkerboard modes, which have no flux.
  for (const Cell cell : casesOf({Cell::Quadrilateral4, Cell::Triangle6, Cell::Quadrilateral8, Cell::Quadrilateral9})) {
    const Lanczos easy = condition(softSquare(cell, 0.3), "Rigid Modes");
    for (const double poisson : {0.4999, 0.499999}) {
      const Lanczos hard = condition(softSquare(cell, poisson), "Rigid Modes");
      out << cellInfo(cell).name << ": condition " << easy.condition << " at 0.3, " << hard.condition << " at 0.5 - " << 0.5 - poisson
          << "; iterations " << easy.iterations << ", " << hard.iterations << "\n";
      TEST_COMPARE(hard.condition, <, (cell == Cell::Quadrilateral4 ? 1.5 : 1.3) * easy.condition);
      TEST_COMPARE(hard.iterations, <=, easy.iterations + 3);
    }
  }
}

TEUCHOS_UNIT_TEST(Bddc, WeightsThatChangeAlongAnEdgeDoNotLetVolumeThrough) {
  // Node-by-node weighting gives a jump without flux a flux, whose energy scales with the bulk modulus (470 at 0.499999 where only the flux
  // is constrained).
  for (const char* weighting : casesOf({"Deluxe", "Stiffness Diagonal"}))
    for (const char* edges : {"Averages", "Rigid Modes"}) {
      const Lanczos easy = condition(softSquare(Cell::Quadrilateral4, 0.3, true), edges, weighting);
      for (const double poisson : {0.4999, 0.499999}) {
        const Lanczos hard = condition(softSquare(Cell::Quadrilateral4, poisson, true), edges, weighting);
        out << weighting << ", " << edges << ": condition " << easy.condition << " at 0.3, " << hard.condition << " at 0.5 - "
            << 0.5 - poisson << "; iterations " << easy.iterations << ", " << hard.iterations << "\n";
        TEST_COMPARE(hard.condition, <, 3.5);
        TEST_COMPARE(hard.iterations, <, 2 * easy.iterations);
      }
    }
}

TEUCHOS_UNIT_TEST(Bddc, ConditionDoesNotFeelPoissonsRatioAcrossContactLines) {
  // Two blocks of quadrilaterals, three subdomains wide and two high, in contact; the groups of the paper, and pairs on the interface.
  const auto blocks = [](double poisson) {
    std::vector<Box> all(2);
    const char* names[2] = {"lower", "upper"};
    for (int k = 0; k < 2; ++k) {
      all[k].name = names[k];
      all[k].x1 = 3;
      all[k].y0 = 2 * k, all[k].y1 = 2 * k + 2;
      all[k].nx = 12, all[k].ny = 8;
      all[k].blocksX = 3, all[k].blocksY = 2;
      all[k].cell = Cell::Quadrilateral4;
    }
    Scene scene = scenes::fromBoxes(all, 2 * (1 + poisson), poisson);
    for (Material& material : scene.model.materialOfBody) material.element = ElementForm::Mixed;
    scene.sideA = "lower_top";
    scene.sideB = "upper_bottom";
    scene.pairUp();
    for (const char* side : {"lower_bottom", "upper_top"})
      for (int k = 0; k < 2; ++k) scene.hold(side, k, 0.0);
    return scene;
  };
  const auto largest = [](const Teuchos::RCP<const InterfaceOperator>& matrix) {
    const Vector values = DensePair(*matrix, *bddc(matrix)).eigenvalues();
    return values(values.size() - 1);
  };
  for (const bool groups : {true, false}) {
    std::vector<double> found;
    for (const double poisson : {0.3, 0.4999, 0.499999}) {
      const Scene scene = blocks(poisson);
      found.push_back(groups ? largest(Twins(scene).spread.linearised.matrix) : largest(OnInterface(scene, world()).matrix(scene, 3)));
    }
    out << (groups ? "groups: " : "on the interface: ") << found[0] << ", " << found[1] << ", " << found[2] << "\n";
    TEST_COMPARE(found[1], <, 2.5 * found[0]);
    TEST_COMPARE(found[2], <, 1.2 * found[1]);
  }
}

TEUCHOS_UNIT_TEST(Bddc, AdaptiveEdgesKeepTheirThresholdAsPoissonsRatioTendsToOneHalf) {
  for (const Cell cell : casesOf({Cell::Quadrilateral4, Cell::Triangle6})) {
    const Lanczos easy = condition(softSquare(cell, 0.3), "Adaptive");
    for (const double poisson : {0.4999, 0.499999, 0.49999999}) {
      const Lanczos hard = condition(softSquare(cell, poisson), "Adaptive");
      out << cellInfo(cell).name << ": condition " << easy.condition << " at 0.3, " << hard.condition << " at 0.5 - " << 0.5 - poisson
          << "; iterations " << easy.iterations << ", " << hard.iterations << "\n";
      TEST_COMPARE(hard.condition, <, 12.0);  // the threshold, with a margin
      TEST_COMPARE(hard.iterations, <, 1.5 * easy.iterations);
    }
  }
}

TEUCHOS_UNIT_TEST(Bddc, MoreConstraintsGiveALowerCondition) {
  const Scene scene = clampedSquare(4, 8, 1.0, 0.25);
  const double none = condition(scene, "None").condition, averages = condition(scene, "Averages").condition,
               all = condition(scene, "Rigid Modes").condition;
  out << "None " << none << ", Averages " << averages << ", Rigid Modes " << all << "\n";
  TEST_COMPARE(all, <, averages);
  TEST_COMPARE(averages, <, 0.5 * none);
  TEST_COMPARE(all, <, 3.0);
}

// If few constraints of many unknowns change, inverses are updated, otherwise rebuilt.
TEUCHOS_UNIT_TEST(Bddc, ComputesAgainForAnotherStatus) {
  for (const auto& [refinement, updates] : {std::pair(1, false), std::pair(12, true)}) {
    const OnInterface one(pressedBlocks(refinement), world());
    const auto withOpen = [&](std::map<int, ContactState> status) {
      return one.problem.linearise(one.problem.stateOf(zeros(one.all), status)).matrix;
    };
    const auto closed = withOpen({}), partly = withOpen({{1, PairStatus::Open}, {4, PairStatus::Open}}),
               others = withOpen({{1, PairStatus::Open}, {3, PairStatus::Open}});
    const auto again = bddc(closed), fresh = bddc(partly);
    for (const auto& matrix : {others, partly, closed, partly}) {  // there and back
      again->initialize(matrix->space());
      again->compute(matrix);
    }
    TEST_COMPARE(difference(DensePair(*partly, *again).m, DensePair(*partly, *fresh).m), <, 1e-9);
    double more = again->bytesRead() - fresh->bytesRead(), all = 0.0;
    Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, more, Teuchos::outArg(all));
    TEST_EQUALITY(all > 0.0, updates);
    again->initialize(closed->space());
    again->compute(closed);  // the first set again: nothing remains of the updates
    TEST_EQUALITY(again->bytesRead(), bddc(closed)->bytesRead());
  }
}

TEUCHOS_UNIT_TEST(Bddc, IsTheSameWithSparseLocalInverses) {
  for (const Scene& scene : casesOf({turned(crossingBlocks(), 0.5), heldOnTheLine(), pressedBlocks(2)}))
    for (const char* edges : {"None", "Rigid Modes"}) {
      const OnInterface one(scene, world());
      const auto matrix = one.matrix(scene, 3);
      const std::string choice = std::string("Edge Constraints=") + edges;
      const auto dense = bddcWith(matrix, {choice, "Local Inverses=Dense"}), sparse = bddcWith(matrix, {choice, "Local Inverses=Sparse"});
      TEST_COMPARE(difference(DensePair(*matrix, *sparse).m, DensePair(*matrix, *dense).m), <, 1e-9);
      TEST_EQUALITY(sparse->coarseSize(), dense->coarseSize());
      TEST_EQUALITY(bddcWith(matrix, {choice})->bytesRead(), dense->bytesRead());  // Automatic in 2D
    }
}

}  // namespace
}  // namespace suture
