// Blocks cut by METIS on other ranks than their own: the assignment, and results independent of it.
#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <suture/mesh/Generators.hpp>
#include <suture/partition/cut/CutBlocks.hpp>
#include <suture/partition/cut/MetisCut.hpp>

#include "Scenes.hpp"

using namespace suture;

namespace {

std::vector<double> loads(const std::vector<int>& elements, const std::vector<Block>& blocks, int ranks) {
  std::vector<double> load(ranks, 0.0);
  for (std::size_t i = 0; i < blocks.size(); ++i) load[blocks[i].cutter] += elements[i];
  return load;
}

std::vector<Block> ownedBy(const std::vector<int>& owners) {
  std::vector<Block> blocks;
  for (const int owner : owners) blocks.push_back({owner, 0, 0, 9, -1});
  return blocks;
}

// The element graph of block i, the same on every rank.
ElementGraph graphOf(int i) { return elementGraph(boxes({partitiontesting::box("body", 0, 1, 0, 1, 12 + 3 * i, 10)})); }

}  // namespace

TEUCHOS_UNIT_TEST(CutBlocks, StayWhereTheyAreWhereThatBalances) {
  std::vector<Block> blocks = ownedBy({0, 0, 0, 1, 1, 1});
  placeBlocks({100, 100, 90, 95, 100, 100}, 2, blocks);
  for (const Block& block : blocks) TEST_EQUALITY(block.cutter, block.owner);
}

TEUCHOS_UNIT_TEST(CutBlocks, GoToRanksThatHaveLess) {
  for (const int ranks : {2, 3, 4}) {
    std::vector<Block> blocks = ownedBy(std::vector<int>(12, 0));
    const std::vector<int> elements{90, 100, 80, 100, 120, 70, 100, 95, 105, 100, 110, 130};
    placeBlocks(elements, ranks, blocks);
    const std::vector<double> load = loads(elements, blocks, ranks);
    TEST_COMPARE(*std::max_element(load.begin(), load.end()), <=, 1200.0 / ranks + 100);
    TEST_COMPARE(*std::min_element(load.begin(), load.end()), >, 0.0);
  }
  // A small body next to a large one.
  std::vector<Block> blocks = ownedBy({0, 1, 1, 1, 1, 1, 1, 1});
  const std::vector<int> elements(8, 100);
  placeBlocks(elements, 2, blocks);
  TEST_EQUALITY(blocks[0].cutter, 0);
  TEST_COMPARE(loads(elements, blocks, 2)[0], >=, 300.0);
}

TEUCHOS_UNIT_TEST(CutBlocks, DoNotDependOnTheRankThatCutsThem) {
  const auto comm = partitiontesting::comm();
  const int me = comm->getRank(), ranks = comm->getSize();
  constexpr int count = 7, seed = 3;
  for (const int shift : {0, 1, 3}) {
    std::vector<Block> blocks;
    std::vector<ElementGraph> mine;
    for (int i = 0; i < count; ++i) {
      blocks.push_back({i % ranks, 0, 0, 5 + i, (i * i + shift) % ranks});
      if (blocks.back().owner == me) mine.push_back(graphOf(i));
    }
    const std::vector<BlockCut> cuts = cutBlocks(*comm, blocks, mine, seed);
    TEST_EQUALITY(cuts.size(), mine.size());
    std::size_t next = 0;
    for (int i = 0; i < count; ++i) {
      if (blocks[i].owner != me) continue;
      int repairs = 0;
      TEST_ASSERT(cuts[next].partOf == metisCut(graphOf(i), 5 + i, seed, &repairs));
      TEST_EQUALITY(cuts[next].repairs, repairs);
      ++next;
    }
  }
}

TEUCHOS_UNIT_TEST(CutBlocks, WorkForRanksThatOwnNothing) {
  const auto comm = partitiontesting::comm();
  const int last = comm->getSize() - 1;
  std::vector<ElementGraph> mine;
  if (comm->getRank() == 0) mine.push_back(graphOf(0));
  const std::vector<BlockCut> cuts = cutBlocks(*comm, {{0, 0, 0, 6, last}}, mine, 1);
  TEST_EQUALITY(cuts.size(), comm->getRank() == 0 ? 1u : 0u);
  if (comm->getRank() == 0) TEST_ASSERT(cuts[0].partOf == metisCut(graphOf(0), 6, 1));
}
