#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <set>
#include <suture/base/Errors.hpp>
#include <suture/partition/cut/ConnectedParts.hpp>

using namespace suture;

namespace {

// n x m squares, neighbours through sides; number j * n + i.
ElementGraph grid(int n, int m) {
  ElementGraph graph;
  for (int j = 0; j < m; ++j)
    for (int i = 0; i < n; ++i) {
      if (j > 0) graph.neighbours.push_back((j - 1) * n + i);
      if (i > 0) graph.neighbours.push_back(j * n + i - 1);
      if (i + 1 < n) graph.neighbours.push_back(j * n + i + 1);
      if (j + 1 < m) graph.neighbours.push_back((j + 1) * n + i);
      graph.offsets.push_back(static_cast<int>(graph.neighbours.size()));
    }
  return graph;
}

bool sound(const ElementGraph& graph, int parts, const std::vector<int>& partOf) {
  const Components pieces = components(graph, partOf);
  const std::set<int> used(partOf.begin(), partOf.end());
  return pieces.count() == parts && static_cast<int>(used.size()) == parts && *used.begin() == 0 && *used.rbegin() == parts - 1;
}

}  // namespace

TEUCHOS_UNIT_TEST(ConnectedParts, LeavesSoundPartsAlone) {
  const ElementGraph graph = grid(4, 2);
  const std::vector<int> given{0, 0, 1, 1, 0, 0, 1, 1};
  std::vector<int> partOf = given;
  const int repairs = makeConnected(graph, 2, partOf);  // the macro evaluates its arguments twice
  TEST_EQUALITY(repairs, 0);
  TEST_ASSERT(partOf == given);
}

TEUCHOS_UNIT_TEST(ConnectedParts, GivesAFragmentToTheNeighbourWithMostCommonSides) {
  // The single 0 on the right has one side in common with part 1 and three with part 2.
  const ElementGraph graph = grid(5, 3);
  std::vector<int> partOf{0, 0, 1, 2, 2,  //
                          0, 0, 1, 0, 2,  //
                          0, 0, 1, 2, 2};
  std::vector<int> expected = partOf;
  expected[8] = 2;
  makeConnected(graph, 3, partOf);
  TEST_ASSERT(partOf == expected);
}

TEUCHOS_UNIT_TEST(ConnectedParts, SettlesFragmentsThatTouchOnlyFragments) {
  // A row: of the three fragments at its end only the one next to the middle touches a remaining part.
  const ElementGraph graph = grid(9, 1);
  std::vector<int> right{0, 0, 0, 1, 1, 1, 0, 1, 0}, left{0, 1, 0, 1, 1, 1, 0, 0, 0};
  const int onTheRight = makeConnected(graph, 2, right), onTheLeft = makeConnected(graph, 2, left);
  TEST_EQUALITY(onTheRight, 3);
  TEST_EQUALITY(onTheLeft, 3);
  TEST_ASSERT(right == (std::vector<int>{0, 0, 0, 1, 1, 1, 1, 1, 1}));
  TEST_ASSERT(left == (std::vector<int>{1, 1, 1, 1, 1, 1, 0, 0, 0}));
}

TEUCHOS_UNIT_TEST(ConnectedParts, CutsTheLargestWhereAPartIsEmpty) {
  const ElementGraph graph = grid(8, 5);
  for (int parts = 1; parts <= 40; ++parts) {
    std::vector<int> partOf(40, 0);
    makeConnected(graph, parts, partOf);
    TEST_ASSERT(sound(graph, parts, partOf));
  }
}

TEUCHOS_UNIT_TEST(ConnectedParts, RepairsAnyLabelling) {
  const ElementGraph graph = grid(17, 13);
  for (int parts : {2, 5, 12, 60})
    for (unsigned seed = 1; seed <= 10; ++seed) {
      std::vector<int> partOf(17 * 13);
      unsigned state = seed;
      for (int& part : partOf) {
        state = state * 1664525u + 1013904223u;
        part = static_cast<int>((state >> 16) % parts);
      }
      makeConnected(graph, parts, partOf);
      TEST_ASSERT(sound(graph, parts, partOf));
    }
}

TEUCHOS_UNIT_TEST(ConnectedParts, RefusesMorePartsThanElements) {
  std::vector<int> partOf(4, 0);
  TEST_THROW(makeConnected(grid(2, 2), 5, partOf), InternalError);
}
