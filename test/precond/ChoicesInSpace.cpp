// Choices of preconditioners on 3D cubes: subdomains cut by METIS, nearly incompressible bodies, a second level, Neumann-Neumann.
// Iterations until the preconditioned residual has fallen by 1e-8.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/BrickScenes.hpp>
#include <precond/DensePair.hpp>
#include <precond/Preconditioners.hpp>
#include <support/Cases.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/precond/EntitySides.hpp>
#include <suture/precond/PrimalConstraints.hpp>

namespace suture {
namespace {

using namespace blocks;

// Tetrahedron10, 27 subdomains of 2^3 and 3^3 cubes of six cells; bricks 14 / 3.1 and 18 / 4.6, METIS 13 to 14 / 2.5 to 3.1 and 15 to 17 /
// 3.9 to 4.2: faces are ragged, but no longer than those of bricks.
TEUCHOS_UNIT_TEST(ChoicesInSpace, TakeHalfAsManyIterationsMoreOnSubdomainsOfMetisAtMost) {
  for (const int m : casesOf({2, 3})) {
    const Scene scene = cube(3, m, 0, Cell::Tetrahedron10);
    const Interface bricks(scene, world());
    const Lanczos expected = conjugateGradients(bricks.matrix(), *bddc(bricks.linearised.matrix, "Automatic"));
    for (const int seed : {1, 2, 3}) {
      const OnInterface cut(scene, world(), 27, seed);
      const auto matrix = cut.problem.linearise(cut.problem.initialState()).matrix;
      const Lanczos run = conjugateGradients(*matrix, *bddc(matrix, "Automatic"));
      out << "cubes of " << m << "^3, seed " << seed << ": " << run.iterationsTo(1e-8) << " iterations, condition " << run.condition
          << "; bricks " << expected.iterationsTo(1e-8) << ", " << expected.condition << "\n";
      TEST_COMPARE(run.iterationsTo(1e-8), <=, 1.5 * expected.iterationsTo(1e-8));
      TEST_COMPARE(run.least, >=, 1.0 - 1e-10);
    }
  }
}

Scene mixedCube(int k, Cell cell, double poisson) {
  Scene scene = cube(k, cell == Cell::Tetrahedron10 ? 2 : 4, 0, cell, poisson);
  scene.model.materialOfBody[0].element = ElementForm::Mixed;
  return scene;
}

struct Incompressible {
  Cell cell;
  int k;
  const char* constraints;
};

// nu = .4999, H/h = 4 (in nodes), N = 8 and 27. Without the rows of VolumetricPrimalModes averages take 174 iterations in displacement
// elements.
//                  Averages             Automatic            Rigid Modes
//     HEX8         17 / 4.1, 14 / 3.5   16 / 4.1, 14 / 3.5   16 / 4.2, 13 / 3.0
//     TET10        13 / 2.9, 14 / 2.8   12 / 2.5, 13 / 2.6   12 / 2.5, 13 / 2.5
// Tetrahedron4 above nu = .49 is refused; at .49 it takes 11 and 12.
TEUCHOS_UNIT_TEST(ChoicesInSpace, TakeTwentyIterationsInNearlyIncompressibleBodiesAtMost) {
  for (const Incompressible& at : casesOf<Incompressible>({{Cell::Hexahedron8, 2, "Automatic"},
                                                           {Cell::Hexahedron8, 2, "Averages"},
                                                           {Cell::Hexahedron8, 2, "Rigid Modes"},
                                                           {Cell::Hexahedron8, 3, "Averages"},
                                                           {Cell::Hexahedron8, 3, "Automatic"},
                                                           {Cell::Hexahedron8, 3, "Rigid Modes"},
                                                           {Cell::Tetrahedron10, 2, "Automatic"},
                                                           {Cell::Tetrahedron10, 3, "Averages"},
                                                           {Cell::Tetrahedron10, 3, "Automatic"},
                                                           {Cell::Tetrahedron10, 3, "Rigid Modes"}})) {
    const Interface one(mixedCube(at.k, at.cell, 0.4999), world());
    const Lanczos run = conjugateGradients(one.matrix(), *bddc(one.linearised.matrix, at.constraints));
    out << cellInfo(at.cell).name << ", " << at.k << "^3, " << at.constraints << ": " << run.iterationsTo(1e-8) << " iterations, condition "
        << run.condition << "\n";
    TEST_COMPARE(run.iterationsTo(1e-8), <=, 20);
    TEST_COMPARE(run.condition, <, 5.0);
    TEST_COMPARE(run.least, >=, 1.0 - 1e-8);
  }
}

// The flux through a flat face is the integral of the normal displacement, by hand from its nodes' areas: jumps that satisfy the
// constraints have none. h = 1/4; nodes on the face's edges belong to other entities.
TEUCHOS_UNIT_TEST(ChoicesInSpace, KeepTheFluxThroughFaces) {
  for (const char* constraints : {"Averages", "Automatic", "Rigid Modes"}) {
    const Interface one(mixedCube(2, Cell::Hexahedron8, 0.4999), world());
    const InterfaceOperator& matrix = one.matrix();
    const auto weighting = Registry<Weighting>::instance().make("Stiffness Diagonal", Parameters());
    weighting->setup(*one.space, matrix.locals());
    const PrimalChoice choice =
        Registry<PrimalConstraints>::instance().make(constraints, Parameters())->choose(*one.space, matrix.locals(), *weighting);
    const std::vector<InterfaceEntity> rest = withoutAlone(*one.space, choice.alone);
    for (std::size_t e = 0; e < rest.size(); ++e) {
      if (rest[e].kind != EntityKind::Face || rest[e].unknowns.empty()) continue;
      const int n = int(rest[e].unknowns.size());
      Point lowest{9, 9, 9}, highest{-9, -9, -9};
      for (const int place : rest[e].unknowns)
        for (int k = 0; k < 3; ++k) {
          lowest[k] = std::min(lowest[k], one.space->point(place)[k]);
          highest[k] = std::max(highest[k], one.space->point(place)[k]);
        }
      int normal = 0;
      for (int k = 0; k < 3; ++k)
        if (highest[k] - lowest[k] < 1e-9) normal = k;
      Vector flux(n);
      for (int i = 0; i < n; ++i) {
        const Point& p = one.space->point(rest[e].unknowns[i]);
        double area = 1.0;
        for (int k = 0; k < 3; ++k)
          if (k != normal) area *= p[k] > 1e-9 && p[k] < 2 - 1e-9 ? 1.0 : 0.5;  // nodes on the outside of the cube
        flux(i) = area * one.space->direction(rest[e].unknowns[i])[normal];
      }
      TEST_COMPARE((nullSpace(choice.rows[e]).transpose() * flux).norm(), <, 1e-8 * flux.norm());
    }
  }
}

// With accuracy .1 of the level above, at most three more iterations; measured: one on 27 to 64 bricks.
TEUCHOS_UNIT_TEST(ChoicesInSpace, TakeThreeIterationsMoreWithASecondLevelAtMost) {
  struct At {
    int k;
    const char* constraints;
  };
  for (const At& at : casesOf<At>({{3, "Automatic"}, {3, "Averages"}, {3, "Rigid Modes"}, {4, "Automatic"}})) {
    const Interface one(cube(at.k, 4), world());
    const std::string choice = std::string("Edge Constraints=") + at.constraints;
    const Lanczos direct = conjugateGradients(one.matrix(), *bddcWith(one.linearised.matrix, {choice}));
    const Lanczos levels = conjugateGradients(one.matrix(), *bddcWith(one.linearised.matrix, {choice, "Coarse Level Above=4"}));
    out << at.k << "^3, " << at.constraints << ": " << direct.iterationsTo(1e-8) << " / " << direct.condition << " and "
        << levels.iterationsTo(1e-8) << " / " << levels.condition << "\n";
    TEST_COMPARE(levels.iterationsTo(1e-8), <=, direct.iterationsTo(1e-8) + 3);
    const double difference = (direct.iterates.back() - levels.iterates.back()).norm();
    TEST_COMPARE(difference, <, 1e-8 * (1.0 + direct.iterates.back().norm()));
  }
}

// M^-1 S has no eigenvalue below one (the balanced ones equal one), and the largest does not grow from 8 to 27 bricks; 13 / 2.5 at 27.
TEUCHOS_UNIT_TEST(ChoicesInSpace, BalanceNeumannNeumannWithSixMotions) {
  for (const int k : casesOf({3, 2})) {
    const Interface one(cube(k, 4), world());
    const Lanczos balanced = conjugateGradients(one.matrix(), *neumannNeumann(one, one.linearised.matrix));
    const Lanczos none = conjugateGradients(one.matrix(), *neumannNeumann(one, one.linearised.matrix, "None"));
    const Lanczos expected = conjugateGradients(one.matrix(), *bddc(one.linearised.matrix, "Automatic"));
    out << k << "^3: " << balanced.iterationsTo(1e-8) << " iterations, condition " << balanced.condition << "; without a coarse space "
        << none.iterationsTo(1e-8) << ", " << none.condition << "\n";
    TEST_COMPARE(balanced.iterationsTo(1e-8), <=, 16);
    TEST_COMPARE(balanced.least, >=, 1.0 - 1e-9);
    TEST_COMPARE(balanced.condition, <, 4.0);
    TEST_COMPARE(none.condition, >, 3.0 * balanced.condition);
    const double difference = (balanced.iterates.back() - expected.iterates.back()).norm();
    TEST_COMPARE(difference, <, 1e-8 * expected.iterates.back().norm());
  }
}

}  // namespace
}  // namespace suture
