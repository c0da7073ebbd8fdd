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
  Blocks single;
  Dense whole;

  explicit Cells(int blocks, const std::vector<double>& young = {})
      : scene(clampedSquare(blocks, 1)), single(scene, alone(), young), whole(single) {}

  CoarseOptions options(int clusters, double accuracy) const {
    CoarseOptions levels;
    levels.solver = localSolver();
    levels.clusters = clusters;
    levels.accuracy = accuracy;
    levels.above = 0;
    return levels;
  }
};

/// A coarse solve as a map between vectors of all unknowns.
struct Level {
  CoarseElements coarse;
  CoarseParts parts;
  ClusterCoarse solve;

  Level(const Cells& cells, const CommPtr& comm, const CoarseOptions& options)
      : coarse(stripOf(coarseElementsOf(cells.single, cells.whole), *comm)),
        parts{comm, namesIn(coarse.elements), coarse.size},
        solve(comm, coarse, int(cells.single.subdomains.size()), options) {}
  Level(const Cells& cells, int clusters, double accuracy = 0.1) : Level(cells, world(), cells.options(clusters, accuracy)) {}

  /// Each rank has some columns of cells.
  static CoarseElements stripOf(CoarseElements all, const Comm& comm) {
    std::vector<double> x;
    for (const CoarseElement& element : all.elements) {
      x.push_back(0.0);
      for (const int unknown : element.unknowns) x.back() += all.unknowns[unknown].point[0] / double(element.unknowns.size());
    }
    std::vector<CoarseElement> own;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (int(x[i] * comm.getSize()) == comm.getRank()) own.push_back(std::move(all.elements[i]));
    all.elements = std::move(own);
    return all;
  }

  Vector operator()(const Vector& load) const { return parts.joined(solve.solve(parts.partOf(load))); }
  Matrix matrix() const {
    Matrix all(solve.size(), solve.size());
    for (int j = 0; j < solve.size(); ++j) all.col(j) = (*this)(Vector::Unit(solve.size(), j));
    return all;
  }
};

/// On every rank separately, for dense work: many applications, which would need many messages.
Level alike(const Cells& cells, int clusters, double accuracy = 0.1) { return Level(cells, alone(), cells.options(clusters, accuracy)); }

}  // namespace

TEUCHOS_UNIT_TEST(ClusterCoarse, OneClusterIsTheExactSolve) {
  const Cells cells(6);
  const Level one = alike(cells, 1);
  TEST_EQUALITY(one.solve.clusters(), 1);
  TEST_EQUALITY(one.solve.steps(), 0);
  const Vector exact = random(one.solve.size(), 1, 2);
  TEST_COMPARE(difference(one(cells.whole.stiffness * exact), exact), <, 1e-11);
}

TEUCHOS_UNIT_TEST(ClusterCoarse, IsSymmetricAndWithinItsAccuracyOfTheInverse) {
  const Cells cells(12);
  for (const double accuracy : {0.5, 0.1, 1e-3}) {
    const Level level = alike(cells, 9, accuracy);
    TEST_EQUALITY(level.solve.clusters(), 9);
    const Matrix p = level.matrix();
    TEST_COMPARE(difference(p, p.transpose()), <, 1e-11);
    const Vector values = eigenvaluesOfProduct(0.5 * (p + p.transpose()), cells.whole.stiffness);
    out << accuracy << ": " << level.solve.steps() << " steps, eigenvalues " << values.minCoeff() << " to " << values.maxCoeff() << "\n";
    TEST_COMPARE(values.minCoeff(), >, 1.0 - accuracy - 1e-10);
    TEST_COMPARE(values.maxCoeff(), <, 1.0 + accuracy + 1e-10);
    TEST_COMPARE((values.array() - 1.0).abs().maxCoeff(), >, 0.01 * accuracy);  // and no more accurate than required: few steps
  }
}

// Clusters depend on the ranks; the accuracy of the level does not.
TEUCHOS_UNIT_TEST(ClusterCoarse, IsSymmetricAndWithinItsAccuracyOnAnyNumberOfRanks) {
  const Cells cells(8);
  const Level level(cells, 8);
  TEST_EQUALITY(level.solve.clusters(), 8);
  const Matrix p = level.matrix();
  TEST_COMPARE(difference(p, p.transpose()), <, 1e-11);
  const Vector values = eigenvaluesOfProduct(0.5 * (p + p.transpose()), cells.whole.stiffness);
  TEST_COMPARE(values.minCoeff(), >, 0.9 - 1e-10);
  TEST_COMPARE(values.maxCoeff(), <, 1.1 + 1e-10);
}

/// Average displacements of each edge; counts the calls.
class CountedAverages : public MomentConstraints {
 public:
  explicit CountedAverages(int& calls) : MomentConstraints(First::Nowhere), calls_(calls) {}

 protected:
  PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems& locals, const Weighting& weighting) const override {
    ++calls_;
    return MomentConstraints::doChoose(space, locals, weighting);
  }

 private:
  int& calls_;
};

TEUCHOS_UNIT_TEST(ClusterCoarse, ClustersHaveTheStrategiesOfTheFirstLevel) {
  const Cells cells(10);
  int calls = 0;
  CoarseOptions options = cells.options(10, 0.1);
  const Level usual(cells, alone(), options);
  options.primal = [&] { return std::make_unique<CountedAverages>(calls); };
  const Level averages(cells, alone(), options);
  TEST_COMPARE(calls, >, 0);
  TEST_COMPARE(averages.solve.largest(), >, 1.01 * usual.solve.largest());  // fewer constraints
}

TEUCHOS_UNIT_TEST(ClusterCoarse, ConditionStaysBoundedForManyElements) {
  for (const int blocks : {8, 16, 32}) {
    const Cells cells(blocks);
    const Level level(cells, 0);
    out << blocks * blocks << " elements: " << level.solve.clusters() << " clusters, largest eigenvalue " << level.solve.largest() << "\n";
    TEST_EQUALITY(level.solve.clusters(), std::max(blocks, world()->getSize()));
    TEST_COMPARE(level.solve.largest(), >, 1.0);
    TEST_COMPARE(level.solve.largest(), <, 5.0);
  }
}

TEUCHOS_UNIT_TEST(ClusterCoarse, ReportsTooFewChebyshevSteps) {
  const Cells cells(8);
  TEST_EQUALITY(Level(cells, 8).solve.remark(), "");
  const Level level(cells, 8, 1e-200);  // 100 steps reduce an error by .17^100 = 1e-76 for a condition number of 2
  TEST_EQUALITY(level.solve.steps(), 100);
  out << level.solve.remark() << "\n";
  TEST_INEQUALITY(level.solve.remark().find("the 8 clusters have a condition number of"), std::string::npos);
  TEST_INEQUALITY(level.solve.remark().find("100 Chebyshev steps"), std::string::npos);
}

TEUCHOS_UNIT_TEST(ClusterCoarse, FollowsJumpsThatClustersDoNotKnowOf) {
  const Cells cells(8, board(8, 1e4, false));
  const Level level = alike(cells, 6);
  const Matrix p = level.matrix();
  const Vector values = eigenvaluesOfProduct(0.5 * (p + p.transpose()), cells.whole.stiffness);
  out << "steps " << level.solve.steps() << ", largest " << level.solve.largest() << "\n";
  TEST_COMPARE(values.minCoeff(), >, 0.9 - 1e-6);
  TEST_COMPARE(values.maxCoeff(), <, 1.1 + 1e-6);
}

TEUCHOS_UNIT_TEST(ClusterCoarse, TakesAsManyClustersAsElements) {
  const Cells cells(5);  // most clusters have no interior
  const Level level = alike(cells, 1000);
  TEST_EQUALITY(level.solve.clusters(), 25);
  const Matrix p = level.matrix();
  const Vector values = eigenvaluesOfProduct(0.5 * (p + p.transpose()), cells.whole.stiffness);
  TEST_COMPARE((values.array() - 1.0).abs().maxCoeff(), <, 0.1 + 1e-10);
}

TEUCHOS_UNIT_TEST(ClusterCoarse, MayHaveAFurtherLevel) {
  const Cells cells(16);
  CoarseOptions options = cells.options(32, 0.1);
  options.above = 8;
  const Level level(cells, world(), options);  // 256 elements, 32 clusters, then 6 of them
  const Vector exact = random(level.solve.size(), 1, 4);
  const Vector load = cells.whole.stiffness * exact;
  const Vector answer = level(load);
  const Vector error = answer - exact;
  const double relative = std::sqrt(error.dot(cells.whole.stiffness * error) / exact.dot(load));
  out << "error in energy " << relative << "\n";
  TEST_COMPARE(relative, <, 0.2);   // the third level is inexact, too, and the estimate includes it
  TEST_COMPARE(relative, >, 1e-6);  // it is not the exact solve
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

TEUCHOS_UNIT_TEST(ClusterCoarse, APartThatTouchesNothingIsAClusterByItself) {
  const Cells cells(4);
  CoarseElements coarse = coarseElementsOf(cells.single, cells.whole);
  const int first = coarse.size;
  coarse.size += 3;
  CoarseElement apart{1000, {first, first + 1, first + 2}, Matrix(Vector::LinSpaced(3, 2.0, 4.0).asDiagonal())};
  for (int k = 0; k < 3; ++k) coarse.unknowns.push_back({first + k, {5.0 + k, 5, 0}, {k == 2 ? 0.0 : 1.0, k == 2 ? 1.0 : 0.0, 0}});
  coarse.elements.push_back(apart);
  const ClusterCoarse level(alone(), coarse, int(coarse.elements.size()), cells.options(4, 1e-8));
  TEST_EQUALITY(level.clusters(), 4);
  const Vector exact = random(coarse.size, 1, 7);
  Vector load(coarse.size);
  load.head(first) = cells.whole.stiffness * exact.head(first);
  load.tail(3) = apart.matrix * exact.tail(3);
  const Vector answer = level.solve(load);
  TEST_COMPARE(difference(answer.tail(3), exact.tail(3)), <, 1e-14);
  TEST_COMPARE(difference(answer.head(first), exact.head(first)), <, 1e-6);
}

TEUCHOS_UNIT_TEST(ClusterCoarse, BeginsWhereAFactorTakesLonger) {
  CoarseOptions options;
  TEST_ASSERT(!options.goesOn(1000, 2) && options.goesOn(1001, 2));
  TEST_ASSERT(!options.goesOn(600, 3) && options.goesOn(601, 3));
  options.above = 8;
  TEST_ASSERT(!options.goesOn(8, 3) && options.goesOn(9, 3) && options.goesOn(9, 2));
}
