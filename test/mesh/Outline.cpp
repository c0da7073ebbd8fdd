// Sides that belong to one element only, against a table of all sides.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/Outline.hpp>
#include <suture/mesh/SideTable.hpp>

using namespace suture;

namespace {

std::vector<Side> search(const CellBlock& block) {
  const SideTable table(block, std::vector<char>(block.nodes(), 1));
  std::vector<Side> found;
  for (int e = 0; e < block.elements(); ++e)
    for (int s = 0; s < static_cast<int>(cellInfo(block.cells[e]).sideNodes.size()); ++s)
      if (table.onBoundary({e, s})) found.push_back({e, s});
  return found;
}

}  // namespace

TEUCHOS_UNIT_TEST(Outline, AgreesWithATableOfAllSides) {
  for (int number = 0; number < kCells; ++number) {
    Box box, other;
    box.cell = other.cell = static_cast<Cell>(number);
    box.nx = box.ny = box.nz = 4;
    other.nx = 3, other.ny = 2, other.nz = 1;
    other.name = "other";
    other.x0 = 1, other.x1 = 2;  // sides that touch without a common node
    const Mesh mesh = boxes({box, other});
    const std::vector<Side> sides = outline(mesh), all = search(mesh);
    TEST_EQUALITY(sides.size(), all.size());
    for (std::size_t i = 0; i < std::min(sides.size(), all.size()); ++i) {
      TEST_EQUALITY(sides[i].element, all[i].element);
      TEST_EQUALITY(sides[i].side, all[i].side);
    }
    if (box.cell == Cell::Quadrilateral4) TEST_EQUALITY(sides.size(), 16 + 10);
    if (box.cell == Cell::Hexahedron8) TEST_EQUALITY(sides.size(), 96 + 22);
  }
}
