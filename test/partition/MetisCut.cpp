#include <metis.h>

#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <cmath>
#include <suture/mesh/Generators.hpp>
#include <suture/partition/cut/Cut.hpp>
#include <suture/partition/cut/MetisCut.hpp>

#include "Scenes.hpp"

using namespace suture;

namespace {

std::vector<int> sizesOf(const std::vector<int>& partOf, int parts) {
  std::vector<int> sizes(parts, 0);
  for (int part : partOf) ++sizes[part];
  return sizes;
}

}  // namespace

TEUCHOS_UNIT_TEST(MetisCut, MakesConnectedPartsOfAboutEqualSize) {
  const Mesh mesh = partitiontesting::mesh({partitiontesting::box("body", 0, 1, 0, 1, 40, 40)});
  const ElementGraph graph = elementGraph(mesh);
  for (int parts : {2, 3, 8, 9, 16, 64})
    for (int seed : {1, 2, 17}) {
      const std::vector<int> partOf = metisCut(graph, parts, seed);
      const std::vector<int> sizes = sizesOf(partOf, parts);
      TEST_COMPARE(*std::min_element(sizes.begin(), sizes.end()), >, 0.6 * 3200 / parts);
      TEST_COMPARE(*std::max_element(sizes.begin(), sizes.end()), <, 1.3 * 3200 / parts);
      for (int part = 0; part < parts; ++part) TEST_EQUALITY(partitiontesting::connectedParts(mesh, partOf, part), 1);
    }
}

// Squares of a elements have 4 sqrt(a) sides. With METIS' own tolerance of load, less than an element, parts interlocked like combs: 2.6
// times as many sides for 23 elements per part, 1.7 times for 16.
TEUCHOS_UNIT_TEST(MetisCut, MakesCompactPartsOfFewElements) {
  constexpr int cells = 80;
  Box box = partitiontesting::box("body", 0, 1, 0, 1, cells, cells);
  box.cell = Cell::Quadrilateral4;
  const ElementGraph graph = elementGraph(partitiontesting::mesh({box}));
  for (int parts : {150, 225, 275, 300, 325, 400}) {  // 43 to 16 elements
    const std::vector<int> partOf = metisCut(graph, parts, 1);
    const std::vector<int> sizes = sizesOf(partOf, parts);
    int sides = 0;  // between parts
    for (int e = 0; e < graph.elements(); ++e)
      for (const int other : graph.of(e)) sides += other > e && partOf[other] != partOf[e];
    const double squares = 2.0 * std::sqrt(double(cells) * cells * parts) - 2.0 * cells, mean = double(cells) * cells / parts;
    out << parts << " parts: " << sides << " sides, " << squares << " of squares\n";
    TEST_COMPARE(sides, <, 1.25 * squares);
    TEST_COMPARE(*std::max_element(sizes.begin(), sizes.end()), <=, mean + 4.0);
  }
}

TEUCHOS_UNIT_TEST(MetisCut, RepeatsItselfAndFollowsItsSeed) {
  const Mesh mesh = partitiontesting::mesh({partitiontesting::box("body", 0, 1, 0, 1, 40, 40)});
  const ElementGraph graph = elementGraph(mesh);
  const std::vector<int> first = metisCut(graph, 16, 1), other = metisCut(graph, 16, 2);
  TEST_ASSERT(metisCut(graph, 16, 1) == first);
  TEST_ASSERT(other != first);
}

TEUCHOS_UNIT_TEST(MetisCut, WorksForOnePartAndForOneElementAPart) {
  const Mesh mesh = partitiontesting::mesh({partitiontesting::box("body", 0, 1, 0, 1, 4, 3)});
  const ElementGraph graph = elementGraph(mesh);
  TEST_ASSERT(metisCut(graph, 1, 1) == std::vector<int>(24, 0));
  for (int parts = 2; parts <= 24; ++parts) {
    const std::vector<int> partOf = metisCut(graph, parts, 1);
    const std::vector<int> sizes = sizesOf(partOf, parts);
    TEST_COMPARE(*std::min_element(sizes.begin(), sizes.end()), >=, 1);
    for (int part = 0; part < parts; ++part) TEST_EQUALITY(partitiontesting::connectedParts(mesh, partOf, part), 1);
  }
}

// The result of METIS alone for the same graph shows that a repair is needed.
TEUCHOS_UNIT_TEST(MetisCut, CountsTheFragmentsThatMetisLeaves) {
  const Mesh comb = partitiontesting::kept(partitiontesting::mesh({partitiontesting::box("body", 0, 1, 0, 1, 32, 32)}),
                                           [](double x, double y) { return y < 1.0 / 16 || static_cast<int>(32 * x) % 2 == 0; });
  const ElementGraph graph = elementGraph(comb);
  int repaired = 0;
  for (int parts : {2, 3, 4, 6, 8})
    for (int seed : {1, 2, 3}) {
      idx_t options[METIS_NOPTIONS], vertices = graph.elements(), weights = 1, wanted = parts, cut = 0;
      METIS_SetDefaultOptions(options);
      options[METIS_OPTION_SEED] = seed;
      options[METIS_OPTION_CONTIG] = 1;
      std::vector<idx_t> offsets(graph.offsets.begin(), graph.offsets.end()), neighbours(graph.neighbours.begin(), graph.neighbours.end());
      std::vector<idx_t> raw(graph.elements());
      TEST_EQUALITY(METIS_PartGraphRecursive(&vertices, &weights, offsets.data(), neighbours.data(), nullptr, nullptr, nullptr, &wanted,
                                             nullptr, nullptr, options, &cut, raw.data()),
                    METIS_OK);
      int pieces = 0, repairs = 0;
      for (int part = 0; part < parts; ++part) pieces += partitiontesting::connectedParts(comb, {raw.begin(), raw.end()}, part);
      const std::vector<int> partOf = metisCut(graph, parts, seed, &repairs);
      for (int part = 0; part < parts; ++part) TEST_EQUALITY(partitiontesting::connectedParts(comb, partOf, part), 1);
      TEST_EQUALITY(repairs, pieces - parts);
      repaired += repairs > 0;
    }
  TEST_COMPARE(repaired, >, 0);
}

TEUCHOS_UNIT_TEST(MetisCut, HasTheInnerSidesOfAGrid) {
  // n x n squares cut in two: 3 n^2 + 2 n sides, 4 n of them on the boundary.
  const int n = 10;
  const Mesh mesh = partitiontesting::mesh({partitiontesting::box("body", 0, 1, 0, 1, n, n)});
  const ElementGraph graph = elementGraph(mesh);
  TEST_EQUALITY(graph.elements(), 2 * n * n);
  TEST_EQUALITY(static_cast<int>(graph.neighbours.size()), 2 * (3 * n * n + 2 * n - 4 * n));
  for (int e = 0; e < graph.elements(); ++e)
    for (int other : graph.of(e)) {
      const auto back = graph.of(other);
      TEST_ASSERT(std::count(back.begin(), back.end(), e) == 1);
    }
}

TEUCHOS_UNIT_TEST(MetisCut, AutomaticGivesTwoAndFourRanksEqualShares) {
  for (const int elements : {60000, 94000, 435000, 935000, 1870000}) {
    const int count = automaticSubdomains(elements, 2, 2);
    TEST_EQUALITY(count % 4, 0);
    TEST_COMPARE(std::abs(elements - 7200 * count), <=, 7200 * 2 + 3600);
  }
  TEST_EQUALITY(automaticSubdomains(9670, 2, 2), 6);  // small scenes: of 800
  TEST_EQUALITY(automaticSubdomains(2400, 2, 1), 3);
  TEST_EQUALITY(automaticSubdomains(100, 5, 1), 5);     // a piece lies in one
  TEST_EQUALITY(automaticSubdomains(1000, 1, 12), 12);  // every rank has one
  TEST_EQUALITY(automaticSubdomains(100, 1, 12), 2);    // two of fifty elements
}
