// Blocks: their number, size, connectedness, and short borders.
#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <numeric>
#include <suture/partition/cut/Blocks.hpp>
#include <suture/partition/cut/MetisCut.hpp>

#include "Scenes.hpp"

using namespace suture;

namespace {

std::vector<int> sizesOf(const std::vector<int>& blockOf, std::size_t blocks) {
  std::vector<int> sizes(blocks, 0);
  for (const int block : blockOf) ++sizes[block];
  return sizes;
}

int sidesBetween(const ElementGraph& graph, const std::vector<int>& blockOf) {
  int twice = 0;
  for (int e = 0; e < graph.elements(); ++e)
    for (const int other : graph.of(e)) twice += blockOf[e] != blockOf[other];
  return twice / 2;
}

std::vector<int> allOf(const Mesh& mesh) {
  std::vector<int> elements(mesh.elements());
  std::iota(elements.begin(), elements.end(), 0);
  return elements;
}

}  // namespace

TEUCHOS_UNIT_TEST(Blocks, AreForLargePartsWithManySubdomains) {
  TEST_ASSERT(subdomainsOfBlocks(300000, 40) == (std::vector<int>{40}));
  TEST_ASSERT(subdomainsOfBlocks(501288, 69) == (std::vector<int>{35, 34}));
  TEST_ASSERT(subdomainsOfBlocks(1000000, 17) == (std::vector<int>{17}));
  TEST_ASSERT(subdomainsOfBlocks(1000000, 20) == (std::vector<int>{10, 10}));
  TEST_ASSERT(subdomainsOfBlocks(1, 1) == (std::vector<int>{1}));
  for (const int subdomains : {150, 321, 520}) {
    const std::vector<int> of = subdomainsOfBlocks(3737492, subdomains);
    TEST_EQUALITY(of.size(), 16u);
    TEST_EQUALITY(std::accumulate(of.begin(), of.end(), 0), subdomains);
    TEST_COMPARE(of.front() - of.back(), <=, 1);
  }
}

TEUCHOS_UNIT_TEST(Blocks, AreInProportionAndNumberedPartByPart) {
  const Mesh mesh =
      partitiontesting::mesh({partitiontesting::box("wide", 0, 3, 0, 1, 90, 30), partitiontesting::box("high", 0, 1, 2, 4, 20, 40)});
  const ElementGraph graph = elementGraph(mesh);
  const Components parts = components(graph, mesh.bodyOfElement);
  const std::vector<int> blockOf = cutIntoBlocks(graph, parts.elements, {{10, 10, 15}, {4, 5}}, 1);
  TEST_ASSERT(cutIntoBlocks(graph, parts.elements, {{10, 10, 15}, {4, 5}}, 1) == blockOf);
  const std::vector<int> sizes = sizesOf(blockOf, 5);
  const std::vector<double> wanted{5400 * 10 / 35.0, 5400 * 10 / 35.0, 5400 * 15 / 35.0, 1600 * 4 / 9.0, 1600 * 5 / 9.0};
  for (int block = 0; block < 5; ++block) {
    TEST_FLOATING_EQUALITY(double(sizes[block]), wanted[block], 0.03);
    TEST_EQUALITY(partitiontesting::connectedParts(mesh, blockOf, block), 1);
  }
  for (int e = 0; e < mesh.elements(); ++e) TEST_EQUALITY(blockOf[e] >= 3, mesh.bodyOfElement[e] == 1);
  // No longer than straight lines across: 30 cells high, twice; 20 cells wide.
  TEST_COMPARE(sidesBetween(graph, blockOf), <=, 1.25 * (30 + 30 + 20));
}

TEUCHOS_UNIT_TEST(Blocks, OfOneAPartAreTheParts) {
  const Mesh mesh = partitiontesting::mesh({partitiontesting::box("a", 0, 1, 0, 1, 4, 4), partitiontesting::box("b", 0, 1, 2, 3, 4, 4)});
  const ElementGraph graph = elementGraph(mesh);
  const Components parts = components(graph, mesh.bodyOfElement);
  TEST_ASSERT(cutIntoBlocks(graph, parts.elements, {{2}, {3}}, 1) == parts.of);
}

// METIS joins teeth of a comb that are not connected, only similar.
TEUCHOS_UNIT_TEST(Blocks, AreInOnePiece) {
  const Mesh comb = partitiontesting::kept(partitiontesting::mesh({partitiontesting::box("body", 0, 1, 0, 3, 10, 30)}),
                                           [](double x, double y) { return y < 0.3 || static_cast<int>(10 * x) % 4 < 2; });
  const ElementGraph graph = elementGraph(comb);
  for (const int blocks : {2, 3, 5}) {
    const std::vector<int> blockOf = cutIntoBlocks(graph, {allOf(comb)}, {std::vector<int>(blocks, 9)}, 1);
    for (int block = 0; block < blocks; ++block) TEST_EQUALITY(partitiontesting::connectedParts(comb, blockOf, block), 1);
  }
}

// Compared with METIS' own cut of single elements.
TEUCHOS_UNIT_TEST(Blocks, HaveShortBorders) {
  const Mesh mesh = partitiontesting::mesh({partitiontesting::box("body", 0, 1, 0, 1, 120, 120)});
  const ElementGraph graph = elementGraph(mesh);
  for (const int blocks : {2, 4}) {
    const std::vector<int> own = cutIntoBlocks(graph, {allOf(mesh)}, {std::vector<int>(blocks, 9)}, 1);
    TEST_COMPARE(sidesBetween(graph, own), <=, 1.15 * sidesBetween(graph, metisCut(graph, blocks, 1)));
  }
}
