// Dense weights of edges, against Schur complements made by hand and symmetry.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/BrickScenes.hpp>
#include <precond/DensePair.hpp>
#include <precond/Preconditioners.hpp>
#include <precond/Sheets.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/precond/DeluxeWeighting.hpp>

namespace suture {
namespace {

using namespace blocks;

/// D_i of every local problem of this rank, by its id, on its trace.
std::map<int, Matrix> weightsOf(const InterfaceOperator& matrix) {
  DeluxeWeighting weighting;
  weighting.setup(*matrix.space(), matrix.locals());
  std::map<int, Matrix> all;
  for (int i = 0; i < matrix.space()->locals(); ++i) {
    Matrix d = Matrix::Identity(matrix.space()->coupling(i).rows(), matrix.space()->coupling(i).rows());
    weighting.apply(i, d);
    all[matrix.locals()[i]->id()] = d;
  }
  return all;
}

TEUCHOS_UNIT_TEST(DeluxeWeighting, SumsToTheIdentityOnContactLines) {
  for (const Scene& scene : {brickBlocks(2), heldOnTheLine(), turned(crossingBlocks(), 0.5)})
    for (const int open : {0, 5}) {
      const OnInterface one(scene, world());
      const auto matrix = one.matrix(scene, open);
      const InterfaceSpace& space = *matrix->space();
      const DenseSpace all(space);
      const std::map<int, Matrix> weights = weightsOf(*matrix);
      Matrix seen;
      space.gather(*all.vector(Matrix::Identity(all.size(), all.size())), seen);
      Matrix sum = Matrix::Zero(seen.rows(), seen.cols());
      for (int i = 0; i < space.locals(); ++i) {
        Matrix trace(space.coupling(i).rows(), seen.cols());
        space.coupling(i).restrictTo(seen, trace);
        trace = (weights.at(space.localId(i)) * trace).eval();
        space.coupling(i).addTransposed(trace, sum);
      }
      const MultiVectorPtr owned = space.vector(all.size());
      space.scatterAdd(sum, *owned);
      Matrix expected = Matrix::Identity(all.size(), all.size());
      const Matrix t = all.gathered();
      for (int k = 0; k < all.size(); ++k)
        if (t.col(k).norm() == 0.0) expected(k, k) = 0.0;  // idle: others express it
      TEST_COMPARE((all.dense(*owned) - expected).norm(), <, 1e-10);
    }
}

TEUCHOS_UNIT_TEST(DeluxeWeighting, AreTheShareOfTheSchurComplementsOnASeam) {
  const Scene scene = bricks(2, 1, 9);
  const Twins t(scene);
  const Blocks all(scene, alone());
  Matrix s[2];
  std::vector<int> edge;
  for (int k = 0; k < 2; ++k) s[k] = denseSchur(all.subdomains[k]->stiffness().dense(), sharedDofs(*all.subdomains[k]));
  const Subdomain& first = *all.subdomains[0];
  const std::vector<int> shared = sharedDofs(first);
  for (std::size_t k = 0; k < shared.size(); ++k)
    if (const double y = first.mesh().point(first.nodeOf(shared[k]))[1]; y > 1e-9 && y < 1 - 1e-9) edge.push_back(int(k));
  TEST_EQUALITY(int(edge.size()), 2 * 8);
  const auto onEdge = [&](const Matrix& m) { return rowsAt(rowsAt(m, edge).transpose(), edge).transpose().eval(); };
  for (const auto& [id, d] : weightsOf(t.spread.matrix()))
    TEST_COMPARE(difference(onEdge(d), solveSymmetric(onEdge(s[0]) + onEdge(s[1]), onEdge(s[id]))), <, 1e-9);
}

// Mirror images of each other: their energies in normal displacements of the line are the same.
TEUCHOS_UNIT_TEST(DeluxeWeighting, AreHalvesBetweenMirrorImagesInContact) {
  for (const double ratio : {1.0, 3.0}) {
    Scene scene = scenes::twoBlocks(12, 4, 4, 1.0, 0.3);
    scene.model.materialOfBody[1].young = ratio;
    scene.fixLower();
    for (const int component : {0, 1}) scene.hold("upper_top", component, 0.0);
    const OnInterface one(scene, world());
    for (const auto& [id, d] : weightsOf(*one.problem.linearise(one.problem.initialState()).matrix)) {
      TEST_EQUALITY(d.rows(), 13);
      const double share = (id == 1 ? ratio : 1.0) / (1.0 + ratio);
      out << "ratio " << ratio << ", body " << id << ": " << d(6, 6) << "\n";
      TEST_COMPARE((d - share * Matrix::Identity(13, 13)).norm(), <, 1e-10);
    }
  }
}

// Also on a seam each component separately is shared evenly; mirroring changes the sign of the coupling between the two.
TEUCHOS_UNIT_TEST(DeluxeWeighting, AreHalvesOfEachComponentBetweenMirrorImages) {
  Box box;
  box.x1 = 2;
  box.nx = 16;
  box.blocksX = 2;
  Scene scene = scenes::fromBoxes({box}, 1.0, 0.3);
  const Twins t(scene);
  for (const auto& [id, d] : weightsOf(t.spread.matrix())) {
    const int nodes = int(d.rows()) / 2;
    double even = 0.0, odd = 0.0;
    for (int a = 1; a + 1 < nodes; ++a)
      for (int b = 1; b + 1 < nodes; ++b)
        for (int k = 0; k < 2; ++k) {
          even = std::max(even, std::abs(d(2 * a + k, 2 * b + k) - (a == b ? 0.5 : 0.0)));
          odd = std::max(odd, std::abs(d(2 * a + k, 2 * b + 1 - k)));
        }
    out << "subdomain " << id << ": coupling up to " << odd << "\n";
    TEST_COMPARE(even, <, 1e-10);
    TEST_COMPARE(odd, >, 1e-3);  // a diagonal weighting has zero here
  }
}

// By hand: D_i = (S_0 + S_1 + S_2)^-1 S_i on the unknowns that all three share, without the ends; their sum is the identity.
TEUCHOS_UNIT_TEST(DeluxeWeighting, AreTheShareOfTheSchurComplementsOfThreeSharers) {
  const Sheets sheets(world());
  const auto onLine = [&](const Matrix& m) { return pick(m, sheets.inner, sheets.inner); };
  const Matrix all = onLine(sheets.schur[0]) + onLine(sheets.schur[1]) + onLine(sheets.schur[2]);
  Matrix mine = Matrix::Zero(20, 20), sum(20, 20);
  for (const auto& [id, d] : weightsOf(*sheets.matrix)) {
    TEST_COMPARE(difference(onLine(d), solveSymmetric(all, onLine(sheets.schur[id]))), <, 1e-8);
    mine += d;
  }
  Teuchos::reduceAll(*world(), Teuchos::REDUCE_SUM, 400, mine.data(), sum.data());
  TEST_COMPARE((sum - Matrix::Identity(20, 20)).norm(), <, 1e-10);
}

// At a cross point of four subdomains the two components are weighted together: by hand from dense Schur complements.
TEUCHOS_UNIT_TEST(DeluxeWeighting, AreTheShareOfTheSchurComplementsAtAVertex) {
  const Scene scene = bricks(2, 2, 7);
  const Twins t(scene);
  const Blocks all(scene, alone());
  std::map<int, Matrix> block;
  std::map<int, std::vector<int>> places;
  Matrix sum = Matrix::Zero(2, 2);
  for (const auto& subdomain : all.subdomains) {
    const std::vector<int> shared = sharedDofs(*subdomain);
    std::vector<int>& centre = places[subdomain->mesh().id];
    for (std::size_t k = 0; k < shared.size(); ++k) {
      const Point p = subdomain->mesh().point(subdomain->nodeOf(shared[k]));
      if (std::abs(p[0] - 1) + std::abs(p[1] - 1) < 1e-9) centre.push_back(int(k));
    }
    const Matrix schur = denseSchur(subdomain->stiffness().dense(), shared);
    sum += block[subdomain->mesh().id] = pick(schur, centre, centre);
  }
  for (const auto& [id, d] : weightsOf(t.spread.matrix()))
    TEST_COMPARE(difference(pick(d, places[id], places[id]), solveSymmetric(sum, block[id])), <, 1e-9);
}

TEUCHOS_UNIT_TEST(DeluxeWeighting, DoNotChangeWhenAllIsStifferAlike) {
  Scene scene = bricks(3, 2, 5);
  const Twins soft(scene);
  scene.model.materialOfBody[0].young *= 1e9;
  for (Material& material : scene.model.materialOfRegion) material.young *= 1e9;
  const Twins stiff(scene);
  const auto expected = weightsOf(soft.spread.matrix());
  for (const auto& [id, d] : weightsOf(stiff.spread.matrix())) TEST_COMPARE(difference(d, expected.at(id)), <, 1e-8);
}

TEUCHOS_UNIT_TEST(DeluxeWeighting, AreTheSameOnAnyNumberOfRanks) {
  const Twins t(bricks(3, 2, 5));
  const auto expected = weightsOf(t.single.matrix());
  for (const auto& [id, d] : weightsOf(t.spread.matrix())) TEST_COMPARE(difference(d, expected.at(id)), <, 1e-10);
}

TEUCHOS_UNIT_TEST(DeluxeWeighting, ConditionDoesNotFeelAnAlignedJump) {
  std::map<double, double> found;
  for (const double jump : {1.0, 1e2, 1e4, 1e6, 1e-6}) {
    const Twins t(clampedSquare(4, 4), board(4, jump, false));
    found[jump] = DensePair(t.spread.matrix(), *bddc(t.spread.linearised.matrix, "Rigid Modes", "Deluxe")).eigenvalues().maxCoeff();
    out << "jump " << jump << ": largest eigenvalue " << found[jump] << "\n";
    TEST_COMPARE(found[jump], <, 3.0);
  }
  TEST_FLOATING_EQUALITY(found[1e4], found[1e6], 1e-2);
}

}  // namespace
}  // namespace suture
