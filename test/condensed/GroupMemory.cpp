#include <Teuchos_UnitTestHarness.hpp>
#include <condensed/GroupScenes.hpp>
#include <suture/algebra/CholmodFactor.hpp>
#include <suture/condensed/GroupMemory.hpp>

namespace suture {
namespace {

using namespace blocks;

TEUCHOS_UNIT_TEST(GroupMemory, CountsTheMemoryOfTheGroup) {
  Scene scene = wavyBlocks();
  scene.hold("upper_left", 1, 0.0);
  scene.hold("lower_left", 1, 0.0);  // the first pair cannot move
  const GroupOf g(scene);
  const GroupMemory memory = groupMemory(g.members);
  TEST_EQUALITY(memory.unknowns, g.group->dofs());
  TEST_EQUALITY(memory.rows, 6);
  double entries = 0;
  for (const Subdomain* member : g.members) entries += double((member->stiffness().dense().array() != 0.0).count());
  TEST_COMPARE(memory.stiffnessEntries, >=, entries);
  TEST_COMPARE(memory.stiffnessEntries, <, 1.5 * entries);  // right-angled triangles: a quarter of the entries happen to be zero
}

TEUCHOS_UNIT_TEST(GroupMemory, IsSlightlyAboveTwoFactorsForAnyShape) {
  for (const auto& [nx, ny, most] : {std::make_tuple(40, 40, 4.0), std::make_tuple(90, 90, 3.5), std::make_tuple(320, 10, 11.0)}) {
    std::vector<Box> all(2);
    all[0].name = "lower";
    all[1].name = "upper";
    for (Box& box : all) {
      box.x1 = double(nx) / ny;
      box.nx = nx;
      box.ny = ny / 2;
      box.cell = Cell::Quadrilateral4;
    }
    all[0].y0 = -1;
    all[0].y1 = 0;
    Scene scene = scenes::fromBoxes(all, 100.0, 0.3);
    scene.pairUp();
    const Blocks blocks(scene, alone(), 2);
    std::vector<const Subdomain*> members;
    double factors = 0;
    for (const auto& subdomain : blocks.subdomains) {
      members.push_back(subdomain.get());
      SparseMatrix k = subdomain->stiffness().full();
      for (int i = 0; i < k.rows(); ++i) k.coeffRef(i, i) *= 1.01;  // the bodies float
      factors += 2 * CholmodFactor(k).statistics().bytes / (1 << 20);
    }
    const GroupMemory memory = groupMemory(members);
    TEST_EQUALITY(memory.rows, nx + 1);
    TEST_COMPARE(memory.megabytes(), >, factors);
    TEST_COMPARE(memory.megabytes(), <, most * factors);
  }
}

TEUCHOS_UNIT_TEST(GroupMemory, GrowsWithTheSquareOfThePairs) {
  GroupMemory memory;
  memory.unknowns = 1000;
  const double without = memory.megabytes();
  memory.rows = 4096;
  TEST_FLOATING_EQUALITY(memory.megabytes() - without, 1024.0, 1e-12);  // eight matrices of 128 MB
}

}  // namespace
}  // namespace suture
