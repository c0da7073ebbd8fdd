// Sides by their end points, against a search through all elements.
#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <set>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/SideTable.hpp>

using namespace suture;

namespace {

std::vector<Side> search(const CellBlock& block, int a, int b) {
  std::vector<Side> found;
  for (int e = 0; e < block.elements(); ++e)
    for (int s = 0; s < static_cast<int>(cellInfo(block.cells[e]).sideNodes.size()); ++s) {
      const std::vector<int> nodes = block.nodesOf(Side{e, s});
      if (std::minmax(nodes[0], nodes[1]) == std::minmax(a, b)) found.push_back({e, s});
    }
  return found;
}

bool same(const std::vector<Side>& x, const std::vector<Side>& y) {
  return std::equal(x.begin(), x.end(), y.begin(), y.end(),
                    [](const Side& p, const Side& q) { return p.element == q.element && p.side == q.side; });
}

}  // namespace

TEUCHOS_UNIT_TEST(SideTable, FindsWhatASearchFinds) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral4, Cell::Quadrilateral9}) {
    Box box;
    box.name = "square";
    box.nx = 4;
    box.ny = 3;
    box.cell = cell;
    const Mesh mesh = boxes({box});
    const std::vector<Side> some{{0, 0}, {5, 1}, {mesh.elements() - 1, 2}};
    const SideTable all(mesh, std::vector<char>(mesh.nodes(), 1)), few(mesh, some);
    std::set<int> ends;
    for (const Side& side : some)
      for (const int k : {0, 1}) ends.insert(mesh.nodesOf(side)[k]);
    const auto isIn = [&](int node) { return ends.count(node) > 0; };
    int among = 0;
    for (int a = 0; a < mesh.nodes(); ++a)
      for (int b = 0; b < mesh.nodes(); ++b) {
        if (a == b) continue;
        const std::vector<Side> expected = search(mesh, a, b);
        TEST_ASSERT(same(all.between(a, b), expected));
        TEST_ASSERT(same(few.between(a, b), isIn(a) && isIn(b) ? expected : std::vector<Side>()));
        among += isIn(a) && isIn(b) && !expected.empty();
      }
    TEST_COMPARE(among, >=, 6);  // each of the three from either end
    for (int e = 0; e < mesh.elements(); ++e)
      for (int s = 0; s < static_cast<int>(cellInfo(cell).sideNodes.size()); ++s) {
        const std::vector<int> nodes = mesh.nodesOf(Side{e, s});
        const bool outside = search(mesh, nodes[0], nodes[1]).size() == 1;
        TEST_EQUALITY(all.onBoundary({e, s}), outside);
        if (isIn(nodes[0]) && isIn(nodes[1])) TEST_EQUALITY(few.onBoundary({e, s}), outside);
      }
  }
}
