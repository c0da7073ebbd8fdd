// BDDC on a cube of bricks with one side clamped, against an independent program (numpy, dense Schur complements): Hexahedron8, nu = .3,
// k^3 subdomains of m^3 cells; conjugate gradients from zero until the preconditioned residual has fallen by 1e-8.
#include <Teuchos_UnitTestHarness.hpp>
#include <interface/ContactScenes.hpp>
#include <precond/BrickScenes.hpp>
#include <precond/Preconditioners.hpp>
#include <support/Cases.hpp>

namespace suture {
namespace {

using namespace blocks;

struct Reference {
  int k, m;
  const char* constraints;
  int iterations;
  double condition;
};

/// \param young  of each subdomain; empty: one
Lanczos solved(const Reference& reference, const std::vector<double>& young = {}) {
  const Twins t(cube(reference.k, reference.m), young);
  const auto m = bddc(t.spread.linearised.matrix, reference.constraints);
  return conjugateGradients(t.spread.matrix(), *m, *t.spread.space, *t.toSpread(random(t.size(), 1, 5)));
}

TEUCHOS_UNIT_TEST(BricksInSpace, HaveTheConditionsOfAnIndependentProgram) {
  for (const Reference& reference : casesOf<Reference>({{2, 4, "Averages", 12, 2.96},
                                                        {2, 4, "Automatic", 11, 2.15},
                                                        {2, 4, "Rigid Modes", 8, 1.42},
                                                        {3, 4, "Averages", 13, 2.76},
                                                        {3, 4, "Automatic", 11, 2.17},
                                                        {3, 4, "Rigid Modes", 8, 1.40}})) {
    const Lanczos run = solved(reference);
    const int iterations = run.iterationsTo(1e-8);
    out << reference.k << "^3 of " << reference.m << "^3, " << reference.constraints << ": " << iterations << " iterations, condition "
        << run.condition << " (" << reference.iterations << ", " << reference.condition << "), least " << run.least - 1.0 << " above 1\n";
    TEST_COMPARE(std::abs(iterations - reference.iterations), <=, 2);
    TEST_COMPARE(std::abs(run.condition / reference.condition - 1.0), <, 0.05);
    TEST_COMPARE(run.least, >=, 1.0 - 1e-10);
  }
}

TEUCHOS_UNIT_TEST(BricksInSpace, DoNotFeelJumpsFromBrickToBrick) {
  std::vector<double> young;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) young.push_back((i + j + k) % 2 == 0 ? 1.0 : 1e6);
  for (const char* constraints : {"Averages", "Automatic"}) {
    const Lanczos run = solved({2, 4, constraints, 0, 0}, young);
    out << constraints << ": " << run.iterationsTo(1e-8) << " iterations, condition " << run.condition << "\n";
    TEST_COMPARE(run.iterationsTo(1e-8), <=, 13);
    TEST_COMPARE(run.condition, <, 3.3);
    TEST_COMPARE(run.least, >=, 1.0 - 1e-8);
  }
}

}  // namespace
}  // namespace suture
