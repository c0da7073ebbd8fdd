// The table of BricksInSpace for many bricks and large ones, from the same independent program: iterations and condition do not grow with
// the number of subdomains.
#include <Teuchos_UnitTestHarness.hpp>
#include <precond/BrickScenes.hpp>
#include <precond/Preconditioners.hpp>

namespace suture {
namespace {

using namespace blocks;

struct Expected {
  int k, m;
  const char* constraints;
  int iterations;
  double condition;
};

TEUCHOS_UNIT_TEST(ManyBricksInSpace, HaveTheConditionsOfAnIndependentProgram) {
  for (const Expected& reference : std::vector<Expected>{{4, 4, "Averages", 13, 2.63},
                                                         {4, 4, "Automatic", 12, 2.18},
                                                         {4, 4, "Rigid Modes", 8, 1.39},
                                                         {6, 4, "Averages", 13, 2.56},
                                                         {6, 4, "Automatic", 12, 2.19},
                                                         {8, 4, "Averages", 13, 2.55},
                                                         {2, 8, "Averages", 15, 4.94},
                                                         {2, 8, "Automatic", 14, 3.22},
                                                         {2, 8, "Rigid Modes", 11, 2.13},
                                                         {3, 8, "Automatic", 15, 3.61},
                                                         {3, 8, "Rigid Modes", 11, 2.12}}) {
    const Interface one(cube(reference.k, reference.m), world());
    const auto m = bddc(one.linearised.matrix, reference.constraints);
    const Lanczos run = conjugateGradients(one.matrix(), *m);
    const int iterations = run.iterationsTo(1e-8);
    out << reference.k << "^3 of " << reference.m << "^3, " << reference.constraints << ": " << iterations << " iterations, condition "
        << run.condition << " (" << reference.iterations << ", " << reference.condition << "), least " << run.least - 1.0 << " above 1\n";
    TEST_COMPARE(iterations, <=, reference.iterations + 2);
    TEST_COMPARE(std::abs(run.condition / reference.condition - 1.0), <, 0.05);
    TEST_COMPARE(run.least, >=, 1.0 - 1e-10);
  }
}

}  // namespace
}  // namespace suture
