// Choices that leave mechanisms, as a user's strategy may: points are added until no mechanism is left.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/DensePair.hpp>
#include <precond/Preconditioners.hpp>
#include <precond/Sheets.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/precond/Bddc.hpp>
#include <suture/precond/EntitySides.hpp>
#include <suture/precond/Mechanisms.hpp>

namespace suture {
namespace {

using namespace blocks;

/// No points; for each edge the average of each component, or nothing.
class FewConstraints : public PrimalConstraints {
 public:
  explicit FewConstraints(bool averages) : averages_(averages) {}
  PrimalChoice plain(const InterfaceSpace& space) const {
    PrimalChoice choice{std::vector<char>(space.overlapSize(), 0), {}};
    for (const InterfaceEntity& entity : space.entities()) {
      const bool some = averages_ && entity.kind == EntityKind::Edge && !entity.contact;
      choice.rows.push_back(some ? Matrix(orthonormalBasis(rigidMotionsOf(space, entity.unknowns, false), 1e-8).transpose())
                                 : Matrix(0, int(entity.unknowns.size())));
    }
    return choice;
  }

 protected:
  PrimalChoice doChoose(const InterfaceSpace& space, const LocalProblems&, const Weighting&) const override { return plain(space); }

 private:
  bool averages_;
};

Teuchos::RCP<Bddc> bddcBy(const Teuchos::RCP<const InterfaceOperator>& matrix, bool averages) {
  CoarseOptions coarse;
  coarse.solver = localSolver();
  coarse.primal = [averages] { return std::make_unique<FewConstraints>(averages); };
  const auto m = Teuchos::rcp(new Bddc(std::move(coarse)));
  m->initialize(matrix->space());
  m->compute(matrix);
  return m;
}

/// Least rank that constraints lack on the kernels of the local problems, over all ranks; kernels from the Schur complements.
int missingRanks(const InterfaceOperator& matrix, const PrimalChoice& choice) {
  const auto rows = primalRows(*matrix.space(), choice, false);
  int mine = 0, all = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigenpairs pairs = symmetricEigenpairs(matrix.locals()[i]->schur());
    int nulls = 0;
    while (nulls < pairs.values.size() && pairs.values(nulls) < 1e-10 * pairs.values.maxCoeff()) ++nulls;
    if (nulls == 0) continue;
    const Matrix told = Matrix(rows[i].rows) * pairs.vectors.leftCols(nulls);
    mine += nulls - (told.rows() > 0 ? int(orthonormalBasis(told, 1e-8).cols()) : 0);
  }
  Teuchos::reduceAll(*matrix.space()->comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(all));
  return all;
}

PrimalChoice chosen(const InterfaceOperator& matrix, bool averages) {
  StiffnessDiagonalWeighting weighting;
  weighting.setup(*matrix.space(), matrix.locals());
  return FewConstraints(averages).choose(*matrix.space(), matrix.locals(), weighting);
}

TEUCHOS_UNIT_TEST(Mechanisms, ConstraintsHaveFullRankOnRandomCuts) {
  const Scene scene = clampedSquare(1, 14);
  for (const int seed : {1, 2, 3})
    for (const bool averages : {false, true}) {
      const OnInterface one(scene, world(), 7, seed);
      const auto matrix = one.problem.linearise(one.problem.initialState()).matrix;
      const InterfaceSpace& space = *matrix->space();
      const int before = missingRanks(*matrix, FewConstraints(averages).plain(space));
      const PrimalChoice choice = chosen(*matrix, averages);
      TEST_EQUALITY(missingRanks(*matrix, choice), 0);
      if (!averages) TEST_COMPARE(before, >=, 3);  // at least one subdomain floats
      // rows stay orthonormal, and contain only unknowns that are no separate points
      const std::vector<InterfaceEntity> rest = withoutAlone(space, choice.alone);
      for (std::size_t e = 0; e < rest.size(); ++e) {
        TEST_EQUALITY(choice.rows[e].cols(), int(rest[e].unknowns.size()));
        const auto n = choice.rows[e].rows();
        TEST_COMPARE((choice.rows[e] * choice.rows[e].transpose() - Matrix::Identity(n, n)).norm(), <, 1e-12);
      }
      const auto m = bddcBy(matrix, averages);
      const Vector values = DensePair(*matrix, *m).eigenvalues();
      out << (averages ? "averages" : "nothing") << ", seed " << seed << ": " << before << " motions before, " << m->coarseSize()
          << " coarse unknowns, eigenvalues " << values(0) << " .. " << values(values.size() - 1) << "\n";
      TEST_COMPARE(values(0), >, 1.0 - 1e-8);
      TEST_COMPARE(values(values.size() - 1), <, 30.0);
    }
}

// A strip clamped at both ends: with averages each subdomain is held by two hinges and cannot move alone; all of them in a row can.
TEUCHOS_UNIT_TEST(Mechanisms, StiffenAStripThatIsALinkageOfHinges) {
  Box box;
  box.x1 = 6;
  box.nx = 36;
  box.ny = 6;
  box.blocksX = 6;
  Scene scene = scenes::fromBoxes({box}, 1.0, 0.3);
  for (const char* end : {"body_left", "body_right"})
    for (const int component : {0, 1}) scene.hold(end, component, 0.0);
  const Twins t(scene);
  const InterfaceOperator& matrix = t.spread.matrix();
  const InterfaceSpace& space = *matrix.space();
  TEST_EQUALITY(missingRanks(matrix, FewConstraints(true).plain(space)), 0);
  const PrimalChoice choice = chosen(matrix, true);
  for (const InterfaceEntity& edge : space.entities()) {
    int points = 0;
    for (const int place : edge.unknowns) points += choice.alone[place];
    TEST_EQUALITY(points, 2);  // one point of two components on every seam
  }
  const auto m = bddcBy(t.spread.linearised.matrix, true);
  const Vector values = DensePair(matrix, *m).eigenvalues();
  out << m->coarseSize() << " coarse unknowns, eigenvalues " << values(0) << " .. " << values(values.size() - 1) << "\n";
  TEST_COMPARE(values(values.size() - 1), <, 4.0);
}

TEUCHOS_UNIT_TEST(Mechanisms, LeaveSoundChoicesAsTheyAre) {
  for (const Scene& scene : {clampedSquare(3, 4), pressedBlocks(), heldOnTheLine(), turned(crossingBlocks(), 0.5)}) {
    const OnInterface one(scene, world());
    const auto matrix = one.problem.linearise(one.problem.initialState()).matrix;
    for (const char* name : {"None", "Averages", "Rigid Modes"}) {
      StiffnessDiagonalWeighting weighting;
      weighting.setup(*matrix->space(), matrix->locals());
      const auto strategy = Registry<PrimalConstraints>::instance().make(name, Parameters());
      TEST_ASSERT(strategy->choose(*matrix->space(), matrix->locals(), weighting).alone == verticesAndEnds(*matrix->space()));
    }
  }
}

// A sheet that floats, without constraints on the line that three share: points of all three.
TEUCHOS_UNIT_TEST(Mechanisms, HoldEdgesOfThreeSharers) {
  const Sheets sheets(world());
  const PrimalChoice choice = chosen(*sheets.matrix, false);
  TEST_EQUALITY(missingRanks(*sheets.matrix, choice), 0);
  const int points = int(std::count(choice.alone.begin(), choice.alone.end(), 1));
  TEST_EQUALITY(points, sheets.matrix->space()->locals() > 0 ? 4 : 0);  // two nodes
}

TEUCHOS_UNIT_TEST(Mechanisms, RigidMotionsOfPointsAreThoseOfTheFormula) {
  const Twins t(clampedSquare(2, 3));
  const InterfaceSpace& space = *t.single.space;
  std::vector<int> all(space.overlapSize());
  for (int k = 0; k < space.overlapSize(); ++k) all[k] = k;
  const Matrix modes = rigidMotionsOf(space, all, true);
  Matrix byHand(modes.rows(), 3);
  for (const int k : all) {
    const Point &p = space.point(k), &d = space.direction(k);
    byHand.row(k) << d[0], d[1], d[1] * p[0] - d[0] * p[1];
  }
  TEST_EQUALITY(rank(modes), 3);
  TEST_COMPARE(withoutSpan(orthonormalBasis(byHand, 1e-12), modes).norm(), <, 1e-13);
}

}  // namespace
}  // namespace suture
