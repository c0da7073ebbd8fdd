#include <Teuchos_UnitTestHarness.hpp>
#include <precond/CoarseElementsOf.hpp>
#include <precond/Preconditioners.hpp>
#include <suture/precond/coarse/ClusterCoarse.hpp>
#include <suture/precond/coarse/DirectCoarse.hpp>

using namespace suture;
using namespace suture::blocks;

namespace {

/// A body of square cells, each a coarse element.
struct Cells {
  Scene scene;
  Blocks spread, single;
  Dense whole;

  explicit Cells(int blocks, const std::vector<double>& young = {})
      : scene(clampedSquare(blocks, 1)), spread(scene, world(), young), single(scene, alone(), young), whole(single) {}

  ClusterCoarse solve(const Blocks& all, const CommPtr& comm, int clusters, double accuracy, int above) const {
    CoarseOptions levels;
    levels.solver = localSolver();
    levels.clusters = clusters;
    levels.accuracy = accuracy;
    levels.above = above;
    return ClusterCoarse(comm, coarseElementsOf(all, whole), int(single.subdomains.size()), levels);
  }
  ClusterCoarse solve(int clusters, double accuracy = 0.1, int above = 0) const {
    return solve(spread, world(), clusters, accuracy, above);
  }
  /// On every rank by itself, for dense work: many applications, which take long with messages.
  ClusterCoarse alike(int clusters, double accuracy = 0.1) const { return solve(single, alone(), clusters, accuracy, 0); }
};

Matrix matrixOf(const CoarseSolve& solve) {
  Matrix all(solve.size(), solve.size());
  for (int j = 0; j < solve.size(); ++j) all.col(j) = solve.solve(Vector::Unit(solve.size(), j));
  return all;
}

}  // namespace

TEUCHOS_UNIT_TEST(ClusterCoarse, OneClusterIsTheExactSolve) {
  const Cells cells(6);
  const ClusterCoarse one = cells.solve(1);
  TEST_EQUALITY(one.clusters(), 1);
  TEST_EQUALITY(one.steps(), 0);
  const Vector exact = random(one.size(), 1, 2);
  TEST_COMPARE(difference(one.solve(cells.whole.stiffness * exact / world()->getSize()), exact), <, 1e-11);
}

TEUCHOS_UNIT_TEST(ClusterCoarse, IsSymmetricAndWithinItsAccuracyOfTheInverse) {
  const Cells cells(12);
  for (const double accuracy : {0.5, 0.1, 1e-3}) {
    const ClusterCoarse level = cells.alike(9, accuracy);
    TEST_EQUALITY(level.clusters(), 9);
    const Matrix p = matrixOf(level);
    TEST_COMPARE(difference(p, p.transpose()), <, 1e-11);
    const Vector values = eigenvaluesOfProduct(0.5 * (p + p.transpose()), cells.whole.stiffness);
    out << accuracy << ": " << level.steps() << " steps, eigenvalues " << values.minCoeff() << " to " << values.maxCoeff() << "\n";
    TEST_COMPARE(values.minCoeff(), >, 1.0 - accuracy - 1e-10);
    TEST_COMPARE(values.maxCoeff(), <, 1.0 + accuracy + 1e-10);
    TEST_COMPARE((values.array() - 1.0).abs().maxCoeff(), >, 0.01 * accuracy);  // and no better than it is asked to be: few steps
  }
}

TEUCHOS_UNIT_TEST(ClusterCoarse, IsTheSameOnAnyNumberOfRanks) {
  const Cells cells(10);
  const ClusterCoarse spread = cells.solve(8), single = cells.alike(8);
  const Vector load = random(spread.size(), 1, 3);
  TEST_COMPARE(difference(spread.solve(load / world()->getSize()), single.solve(load)), <, 1e-10);
}

TEUCHOS_UNIT_TEST(ClusterCoarse, ConditionStaysBoundedForManyElements) {
  for (const int blocks : {8, 16, 32}) {
    const ClusterCoarse level = Cells(blocks).solve(0);
    out << blocks * blocks << " elements: " << level.clusters() << " clusters, largest eigenvalue " << level.largest() << "\n";
    TEST_EQUALITY(level.clusters(), std::max(blocks, world()->getSize()));
    TEST_COMPARE(level.largest(), >, 1.0);
    TEST_COMPARE(level.largest(), <, 4.0);
  }
}

TEUCHOS_UNIT_TEST(ClusterCoarse, FollowsJumpsThatClustersDoNotKnowOf) {
  const Cells cells(8, board(8, 1e4, false));
  const ClusterCoarse level = cells.alike(6);
  const Matrix p = matrixOf(level);
  const Vector values = eigenvaluesOfProduct(0.5 * (p + p.transpose()), cells.whole.stiffness);
  out << "steps " << level.steps() << ", largest " << level.largest() << "\n";
  TEST_COMPARE(values.minCoeff(), >, 0.9 - 1e-6);
  TEST_COMPARE(values.maxCoeff(), <, 1.1 + 1e-6);
}

TEUCHOS_UNIT_TEST(ClusterCoarse, TakesAsManyClustersAsElements) {
  const Cells cells(5);  // most clusters have no interior
  const ClusterCoarse level = cells.alike(1000);
  TEST_EQUALITY(level.clusters(), 25);
  const Matrix p = matrixOf(level);
  const Vector values = eigenvaluesOfProduct(0.5 * (p + p.transpose()), cells.whole.stiffness);
  TEST_COMPARE((values.array() - 1.0).abs().maxCoeff(), <, 0.1 + 1e-10);
}

TEUCHOS_UNIT_TEST(ClusterCoarse, MayHaveALevelOfItsOwn) {
  const Cells cells(16);
  const ClusterCoarse level = cells.solve(32, 0.1, 8);  // 256 elements, 32 clusters, then 6 of them
  const Vector exact = random(level.size(), 1, 4);
  const Vector load = cells.whole.stiffness * exact;
  const Vector answer = level.solve(load / world()->getSize());
  const Vector error = answer - exact;
  const double relative = std::sqrt(error.dot(cells.whole.stiffness * error) / exact.dot(load));
  out << "error in energy " << relative << "\n";
  TEST_COMPARE(relative, <, 0.2);   // the third level is inexact, too, and the estimate sees it
  TEST_COMPARE(relative, >, 1e-6);  // it is not the exact one
}

TEUCHOS_UNIT_TEST(ClusterCoarse, GivesBddcAsManyIterationsAsTheExactCoarseSolve) {
  const Twins t(clampedSquare(8, 4));
  const MultiVectorPtr load = t.toSpread(random(t.size(), 1, 5));
  const auto exact = bddcWith(t.spread.linearised.matrix, {"Coarse Level Above=1000"});
  const auto level = bddcWith(t.spread.linearised.matrix, {"Coarse Level Above=0"});
  const Lanczos with = conjugateGradients(t.spread.matrix(), *exact, *t.spread.space, *load);
  const Lanczos without = conjugateGradients(t.spread.matrix(), *level, *t.spread.space, *load);
  out << "iterations " << with.iterations << " and " << without.iterations << ", condition " << with.condition << " and "
      << without.condition << "\n";
  TEST_COMPARE(without.iterations, <=, with.iterations + 2);
  TEST_COMPARE(without.condition, <, 1.3 * with.condition);
  TEST_EQUALITY(level->coarseSize(), exact->coarseSize());
}

TEUCHOS_UNIT_TEST(ClusterCoarse, InBddcTendsToTheExactPreconditioner) {
  const Twins t(clampedSquare(4, 3));
  const auto exact = bddcWith(t.spread.linearised.matrix, {"Coarse Level Above=1000"});
  const auto close = bddcWith(t.spread.linearised.matrix, {"Coarse Level Above=0", "Coarse Clusters=4", "Coarse Accuracy=1e-10"});
  const auto rough = bddcWith(t.spread.linearised.matrix, {"Coarse Level Above=0", "Coarse Clusters=4"});
  const MultiVectorPtr r = t.toSpread(random(t.size(), 4, 6)), z = t.spread.space->vector(4), other = t.spread.space->vector(4);
  exact->apply(*r, *z);
  close->apply(*r, *other);
  TEST_COMPARE(difference(t.toDense(*other), t.toDense(*z)), <, 1e-8);
  rough->apply(*r, *other);
  TEST_COMPARE(difference(t.toDense(*other), t.toDense(*z)), >, 1e-6);
  const Matrix products = t.toDense(*r).transpose() * t.toDense(*other);
  TEST_COMPARE(difference(products, products.transpose()), <, 1e-11);
  TEST_COMPARE(eigenvalues(products)(0), >, 0.0);
}
