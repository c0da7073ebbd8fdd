// Adaptive constraints on faces and on edges of four and more sharers, on bricks of 3 x 3 x 3 cells, every other one 1e6 times as stiff;
// subdomains do not follow the bricks.
#include <Teuchos_UnitTestHarness.hpp>
#include <precond/BrickScenes.hpp>
#include <precond/DensePair.hpp>
#include <precond/Preconditioners.hpp>
#include <support/Cases.hpp>

namespace suture {
namespace {

using namespace blocks;

std::vector<std::string> adaptive(const std::string& weighting, double threshold, const std::string& inverses = "Automatic") {
  std::ostringstream value;
  value << threshold;
  return {"Weighting=" + weighting, "Edge Constraints=Adaptive", "Adaptive/Threshold=" + value.str(), "Local Inverses=" + inverses};
}

constexpr double kThreshold = 5.0;  // the default

/// The pencil of the one face between two subdomains, without code of the library except assembly: jumps against their least energy.
Vector pencilOfOneFace(const Scene& scene, bool deluxe) {
  const Blocks all(scene, alone());
  Matrix t[2], weights[2];
  for (int s = 0; s < 2; ++s) {
    const Subdomain& subdomain = *all.subdomains[s];
    std::vector<int> shared = sharedDofs(subdomain);
    std::sort(shared.begin(), shared.end(), [&](int a, int b) { return subdomain.globalDof(a) < subdomain.globalDof(b); });
    t[s] = denseSchur(subdomain.stiffness().dense(), shared);
    weights[s] = rowsAt(Matrix(subdomain.stiffness().dense().diagonal()), shared).asDiagonal();
  }
  const Matrix sum = deluxe ? Matrix(t[0] + t[1]) : Matrix(weights[0] + weights[1]);
  for (int s = 0; s < 2; ++s) weights[s] = solveSymmetric(sum, deluxe ? t[s] : weights[s]);
  const Matrix cost = weights[1].transpose() * t[0] * weights[1] + weights[0].transpose() * t[1] * weights[0];
  const Matrix least = t[0] - t[0] * solveSymmetric(t[0] + t[1], t[0]);  // one side is clamped: regular
  return eigenvalues(cost, 0.5 * (least + least.transpose()));
}

/// Two subdomains of m^3 cells side by side.
Scene pairOfCubes(int m) {
  Box box;
  box.x1 = 2;
  box.nx = 2 * m;
  box.ny = box.nz = m;
  box.blocksX = 2;
  box.brickX = box.brickY = box.brickZ = 3;
  box.cell = Cell::Hexahedron8;
  Scene scene = scenes::fromBoxes({box}, 1.0, 0.3);
  scene.model.dimension = 3;
  scene.region("body_bricks_odd", 1e4);
  for (int component = 0; component < 3; ++component) {
    scene.hold("body_left", component, 0.0);
    scene.hold("body_right", component, 0.0);
  }
  return scene;
}

// With one face there is no constant in the bound: the largest eigenvalue is the largest remaining value of the pencil. Deluxe weights are
// exact there.
TEUCHOS_UNIT_TEST(AdaptiveInSpace, OfOneFaceLeaveExactlyTheEigenvaluesBelowTheThreshold) {
  const Scene scene = pairOfCubes(5);
  const Interface one(scene, world());
  for (const std::string weighting : {"Deluxe", "Stiffness Diagonal"}) {
    const Vector values = pencilOfOneFace(scene, weighting == "Deluxe");
    for (const double threshold : {1.7, 5.0, 100.0}) {
      const auto m = bddcWith(one.linearised.matrix, adaptive(weighting, threshold));
      const int above = int((values.array() > threshold).count());
      double below = 1.0;
      for (const double value : values) below = value <= threshold ? std::max(below, value) : below;
      const double largest = DensePair(one.matrix(), *m).eigenvalues().maxCoeff();
      out << weighting << ", threshold " << threshold << ": " << m->coarseSize() << " constraints, pencil " << above
          << ", largest eigenvalue " << largest << " against " << below << "\n";
      TEST_EQUALITY(m->coarseSize(), above);
      TEST_FLOATING_EQUALITY(largest, below, 1e-4);
    }
  }
}

struct Measured {
  int k, m;
  const char* weighting;
};

// Iterations / condition / coarse unknowns of the default threshold, 5; in brackets the default constraints:
//     k, m      Stiffness Diagonal                   Deluxe
//     2, 4      12 / 2.7 / 95   [59 / 2.0e4]         11 / 3.3 / 98     [46 / 9.2e3]
//     3, 4      10 / 2.3 / 618  [29 / 18]            10 / 2.6 / 630    [27 / 17]
//     4, 4      12 / 2.6 / 1888 [910 / 1.0e5]        11 / 2.6 / 1881   [742 / 7.3e4]
//     2, 8      14 / 3.8 / 215  [147 / 5.3e4]        8 / 1.9 / 207     [134 / 5.8e4]
//     3, 8      12 / 2.7 / 1126 [over 1000]          [over 1000]
TEUCHOS_UNIT_TEST(AdaptiveInSpace, TakeFifteenIterationsWhereBricksCutFacesAndEdges) {
  for (const Measured& at : casesOf<Measured>({{2, 4, "Stiffness Diagonal"},
                                               {2, 4, "Deluxe"},
                                               {3, 4, "Stiffness Diagonal"},
                                               {3, 4, "Deluxe"},
                                               {2, 8, "Stiffness Diagonal"},
                                               {2, 8, "Deluxe"}},
                                              2)) {
    const Interface one(cube(at.k, at.m, 3), world());
    const auto m = bddcWith(one.linearised.matrix, adaptive(at.weighting, kThreshold));
    const Lanczos run = conjugateGradients(one.matrix(), *m);
    out << at.k << "^3 of " << at.m << "^3, " << at.weighting << ": " << run.iterationsTo(1e-8) << " iterations, condition "
        << run.condition << ", least " << run.least - 1.0 << " above 1, " << m->coarseSize() << " coarse unknowns\n";
    TEST_COMPARE(run.iterationsTo(1e-8), <=, 15);
    TEST_COMPARE(run.condition, <, kThreshold);
    TEST_COMPARE(run.least, >=, 1.0 - 1e-6);
    TEST_COMPARE(m->coarseSize(), <, 0.35 * double(one.space->size()));
    if (at.k == 2 && at.m == 4)
      TEST_COMPARE(conjugateGradients(one.matrix(), *bddc(one.linearised.matrix, "Automatic", at.weighting)).condition, >, 1e3);
  }
}

// Where rows of stiff and soft cells leave no digits to a sparse factor, the dense inverse is used.
TEUCHOS_UNIT_TEST(AdaptiveInSpace, HaveTheSameConditionWithSparseInverses) {
  const Interface one(cube(2, 5, 3), world());
  const auto dense = bddcWith(one.linearised.matrix, adaptive("Stiffness Diagonal", kThreshold, "Dense"));
  const auto sparse = bddcWith(one.linearised.matrix, adaptive("Stiffness Diagonal", kThreshold, "Sparse"));
  const Lanczos a = conjugateGradients(one.matrix(), *dense), b = conjugateGradients(one.matrix(), *sparse);
  out << "dense " << a.iterations << " / " << a.condition << ", sparse " << b.iterations << " / " << b.condition << "\n";
  TEST_COMPARE(std::abs(b.condition / a.condition - 1.0), <, 0.05);
  TEST_COMPARE(std::abs(b.iterations - a.iterations), <=, 1);
}

TEUCHOS_UNIT_TEST(AdaptiveInSpace, AreTheSameOnAnyNumberOfRanks) {
  const Scene scene = cube(2, 3, 2);
  const Interface spread(scene, world()), single(scene, alone());
  for (const double threshold : {3.0, 30.0}) {
    const auto a = bddcWith(spread.linearised.matrix, adaptive("Deluxe", threshold));
    const auto b = bddcWith(single.linearised.matrix, adaptive("Deluxe", threshold));
    TEST_EQUALITY(a->coarseSize(), b->coarseSize());
    const Vector left = DensePair(spread.matrix(), *a).eigenvalues(), right = DensePair(single.matrix(), *b).eigenvalues();
    out << "threshold " << threshold << ": " << a->coarseSize() << " coarse unknowns, eigenvalues " << left(0) << " .. " << left.maxCoeff()
        << "\n";
    TEST_COMPARE((left - right).cwiseAbs().maxCoeff(), <, 1e-4);
    TEST_COMPARE(left(0), >, 1.0 - 1e-6);
    TEST_COMPARE(left.maxCoeff(), <, 2.0 * threshold);
  }
}

TEUCHOS_UNIT_TEST(AdaptiveInSpace, DemandNothingOfJumpsThatFacesFollow) {
  std::vector<double> young;
  for (int i = 0; i < 8; ++i) young.push_back((i / 4 + i / 2 + i) % 2 == 0 ? 1.0 : kHardJump);
  const Interface even(cube(2, 4), world()), jumping(cube(2, 4), world(), young);
  const int without = bddcWith(even.linearised.matrix, adaptive("Stiffness Diagonal", 10.0))->coarseSize();
  const auto m = bddcWith(jumping.linearised.matrix, adaptive("Stiffness Diagonal", 10.0));
  const Lanczos run = conjugateGradients(jumping.matrix(), *m);
  out << without << " coarse unknowns without a jump, " << m->coarseSize() << " with one; condition " << run.condition << "\n";
  TEST_COMPARE(m->coarseSize(), <=, without);
  TEST_COMPARE(run.condition, <, 10.0);
}

}  // namespace
}  // namespace suture
