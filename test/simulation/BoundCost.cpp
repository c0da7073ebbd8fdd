// Cost of the error bound relative to the solve without it, measured by processor time of one rank, on which other programs on the machine
// have little influence.
#include <Teuchos_UnitTestHarness.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace suture {
namespace {

/// A clamped block under a traction.
Scene clampedBlock(Cell cell, int cells, bool isBounded) {
  ElasticModel model;
  model.addBody("a", std::make_shared<IsotropicLaw>(IsotropicModuli{2e6, 0.3}));
  model.loads = {Load::traction("a_right", {1e3, -1e3, 0})};
  Box box{"a", 0, 1, 0, 1, cells, cells, cell};
  return makeScene(model, [box] { return boxes({box}); }, {Condition::displacement("a_left", {0, 0})}, {},
                   {std::string("Output/Error Bound=") + (isBounded ? "true" : "false")});
}

double secondsOf(const Scene& scene) {
  const std::clock_t begin = std::clock();
  Simulation simulation(blocks::world(), scene);
  simulation.solve();
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

// Measured: 1.2, 0.7 and 2.0, without reading and writing.
TEUCHOS_UNIT_TEST(BoundCost, IsOfTheOrderOfASolve) {
  struct Case {
    Cell cell;
    int cells;
    double most;  // relative to the solve
  };
  for (const Case& one : {Case{Cell::Triangle3, 150, 2.2}, Case{Cell::Triangle6, 80, 1.2}, Case{Cell::Quadrilateral4, 150, 3.5}}) {
    double without = HUGE_VAL, with = HUGE_VAL;
    for (int i = 0; i < 3; ++i) {
      without = std::min(without, secondsOf(clampedBlock(one.cell, one.cells, false)));
      with = std::min(with, secondsOf(clampedBlock(one.cell, one.cells, true)));
    }
    out << static_cast<int>(one.cell) << ": " << without << " s, the bound " << with - without << " s\n";
    TEST_COMPARE(with - without, <=, one.most * without);
  }
}

}  // namespace
}  // namespace suture
