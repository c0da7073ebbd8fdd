// Sides by their vertices, against a search through all elements.
#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <set>
#include <suture/mesh/Generators.hpp>
#include <suture/mesh/SideTable.hpp>

#include <mesh/ReferenceCells.hpp>

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

TEUCHOS_UNIT_TEST(SideTable, AgreesWithASearch) {
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
        TEST_ASSERT(same(all.of(sideKey(a, b)), expected));
        TEST_ASSERT(same(few.of(sideKey(a, b)), isIn(a) && isIn(b) ? expected : std::vector<Side>()));
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

namespace {

/// Vertices of a side, ascending.
std::vector<int> verticesOf(const CellBlock& block, const Side& side) {
  std::vector<int> vertices;
  for (const int local : cellInfo(block.cells[side.element]).sideNodes[side.side])
    if (local < cellInfo(block.cells[side.element]).vertices) vertices.push_back(block.nodesOf(side.element)[local]);
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

}  // namespace

TEUCHOS_UNIT_TEST(SideTable, AgreesWithASearchIn3D) {
  for (const Cell cell : referencecells::solid) {
    Box box;
    box.nx = 3, box.ny = box.nz = 2;
    box.cell = cell;
    const Mesh mesh = boxes({box});
    std::vector<Side> sides;
    for (int e = 0; e < mesh.elements(); ++e)
      for (std::size_t s = 0; s < cellInfo(cell).sideNodes.size(); ++s) sides.push_back({e, static_cast<int>(s)});
    const std::vector<Side> some{sides[0], sides[sides.size() / 2 + 1], sides.back()};
    const SideTable all(mesh, std::vector<char>(mesh.nodes(), 1)), few(mesh, some);
    std::set<int> marked;
    for (const Side& side : some)
      for (const int vertex : verticesOf(mesh, side)) marked.insert(vertex);
    int among = 0;
    for (const Side& side : sides) {
      const std::vector<int> vertices = verticesOf(mesh, side);
      std::vector<Side> expected;
      for (const Side& other : sides)
        if (verticesOf(mesh, other) == vertices) expected.push_back(other);
      const bool isMarked = std::all_of(vertices.begin(), vertices.end(), [&](int vertex) { return marked.count(vertex) > 0; });
      TEST_ASSERT(same(all.of(mesh.keyOf(side)), expected));
      TEST_ASSERT(same(few.of(mesh.keyOf(side)), isMarked ? expected : std::vector<Side>()));
      TEST_EQUALITY(all.onBoundary(side), expected.size() == 1);
      among += isMarked;
    }
    TEST_COMPARE(among, >=, 3);
    const int none[] = {0, 1, mesh.nodes() - 1};  // far from each other
    TEST_ASSERT(all.of(sideKey(none, 3)).empty());
  }
}
