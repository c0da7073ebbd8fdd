// Neighbours, components and holders of nodes, against searches through all elements.
#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <random>
#include <set>
#include <suture/mesh/Generators.hpp>
#include <suture/partition/NodeSubdomains.hpp>
#include <suture/partition/cut/ElementGraph.hpp>

using namespace suture;

namespace {

// Two boxes that do not touch, their elements numbered at random.
Mesh shuffled(Cell cell) {
  Box one, two;
  one.name = "one";
  two.name = "two";
  one.nx = 5;
  one.ny = 4;
  two.x0 = 3;
  two.x1 = 4;
  two.nx = two.ny = 3;
  one.cell = two.cell = cell;
  Mesh mesh = boxes({one, two});
  std::vector<int> order(mesh.elements());
  for (int e = 0; e < mesh.elements(); ++e) order[e] = e;
  std::shuffle(order.begin(), order.end(), std::mt19937(7));
  Mesh other = mesh;
  other.connectivity.clear();
  for (int e = 0; e < mesh.elements(); ++e)
    other.connectivity.insert(other.connectivity.end(), mesh.nodesOf(order[e]).begin(), mesh.nodesOf(order[e]).end());
  return other;  // a mesh of equal cells: offsets stay
}

std::set<int> verticesOf(const Mesh& mesh, int e) {
  const auto nodes = mesh.nodesOf(e);
  return {nodes.begin(), nodes.begin() + cellInfo(mesh.cells[e]).vertices};
}

}  // namespace

TEUCHOS_UNIT_TEST(ElementGraph, JoinsElementsWithTwoVerticesInCommon) {
  for (const Cell cell : {Cell::Triangle3, Cell::Triangle6, Cell::Quadrilateral8}) {
    const Mesh mesh = shuffled(cell);
    const ElementGraph graph = elementGraph(mesh);
    TEST_EQUALITY(graph.elements(), mesh.elements());
    for (int e = 0; e < mesh.elements(); ++e) {
      std::vector<int> expected;
      const std::set<int> own = verticesOf(mesh, e);
      for (int other = 0; other < mesh.elements(); ++other) {
        const std::set<int> theirs = verticesOf(mesh, other);
        const auto common = std::count_if(own.begin(), own.end(), [&](int node) { return theirs.count(node) > 0; });
        if (other != e && common == 2) expected.push_back(other);
      }
      TEST_ASSERT(std::equal(graph.of(e).begin(), graph.of(e).end(), expected.begin(), expected.end()));
    }
  }
}

TEUCHOS_UNIT_TEST(ElementGraph, ComponentsAgreeWithASearch) {
  const Mesh mesh = shuffled(Cell::Triangle3);
  const ElementGraph graph = elementGraph(mesh);
  std::mt19937 next(3);
  for (const int kinds : {1, 2, 5}) {
    std::vector<int> labels(mesh.elements());
    for (int& label : labels) label = static_cast<int>(next() % kinds);
    const Components found = components(graph, labels);
    std::vector<int> expected(mesh.elements(), -1);
    int count = 0;
    for (int seed = 0; seed < mesh.elements(); ++seed) {
      if (expected[seed] >= 0) continue;
      std::vector<int> reached{seed};
      expected[seed] = count;
      for (std::size_t i = 0; i < reached.size(); ++i)
        for (const int other : graph.of(reached[i]))
          if (expected[other] < 0 && labels[other] == labels[seed]) {
            expected[other] = count;
            reached.push_back(other);
          }
      std::sort(reached.begin(), reached.end());
      TEST_ASSERT(found.elements[count] == reached);
      ++count;
    }
    TEST_EQUALITY(found.count(), count);
    TEST_ASSERT(found.of == expected);
    if (kinds == 1) TEST_EQUALITY(count, 2);
  }
}

TEUCHOS_UNIT_TEST(NodeSubdomains, AreThoseOfTheElementsAround) {
  const Mesh mesh = shuffled(Cell::Triangle6);
  std::mt19937 next(5);
  std::vector<int> subdomainOf(mesh.elements());
  for (int& s : subdomainOf) s = static_cast<int>(next() % 4);
  const NodeSubdomains all = nodeSubdomains(mesh, subdomainOf);
  for (int node = 0; node < mesh.nodes(); ++node) {
    std::set<int> expected;
    for (int e = 0; e < mesh.elements(); ++e)
      for (const int own : mesh.nodesOf(e))
        if (own == node) expected.insert(subdomainOf[e]);
    TEST_ASSERT(std::equal(all.of(node).begin(), all.of(node).end(), expected.begin(), expected.end()));
  }
}
