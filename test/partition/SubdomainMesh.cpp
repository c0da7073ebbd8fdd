#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <numeric>
#include <set>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include "Scenes.hpp"

using namespace suture;
using namespace scenes;

namespace {

double sumOverRanks(double mine) {
  double sum = 0;
  Teuchos::reduceAll(*comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(sum));
  return sum;
}

// Two stacked boxes with contact, a rule on the lower side and METIS subdomains.
struct Scene {
  Mesh whole = mesh({box("low", 0, 4, 0, 1, 24, 6), box("top", 0, 4, 1, 2, 24, 6)});
  Constraints constraints;
  Partition partition;
  std::vector<SubdomainMesh> mine;

  explicit Scene(int subdomains, bool keepGroupsWhole = false) {
    addContact(whole, "low_top", "top_bottom", constraints);
    if (onRoot())
      for (int node = 0; node < whole.nodes(); ++node)
        if (whole.point(node)[1] == 0.0) {
          NodeRule rule;
          rule.node = node;
          rule.fixed = {true, false, false};
          rule.value = {whole.point(node)[0], 0, 0};
          constraints.rules.push_back(rule);
        }
    partition = makePartition(*comm(), whole, constraints, metis(subdomains).list(), keepGroupsWhole);
    mine = distribute(*comm(), whole, constraints, partition);
  }
};

}  // namespace

TEUCHOS_UNIT_TEST(SubdomainMesh, LivesWhereThePartitionSays) {
  const Scene scene(7);
  std::vector<int> expected, found;
  for (int s = 0; s < 7; ++s)
    if (scene.partition.rankOf[s] == comm()->getRank()) expected.push_back(s);
  for (const SubdomainMesh& part : scene.mine) found.push_back(part.id);
  TEST_ASSERT(found == expected);
  for (const SubdomainMesh& part : scene.mine) {
    TEST_EQUALITY(part.name, scene.partition.names[part.id]);
    TEST_EQUALITY(part.body, scene.partition.bodyOf[part.id]);
    TEST_EQUALITY(part.group, scene.partition.groupOf[part.id]);
    TEST_EQUALITY(part.elements(), scene.partition.elementsOf[part.id]);
  }
}

TEUCHOS_UNIT_TEST(SubdomainMesh, CoversTheBodiesOnce) {
  const Scene scene(7);
  double area = 0, moment = 0, nodesByShares = 0;
  for (const SubdomainMesh& part : scene.mine) {
    for (int e = 0; e < part.elements(); ++e) {
      area += signedArea(part, e);
      moment += signedArea(part, e) * centreOf(part, e)[1];
    }
    // A node counts 1 over the number of its holders.
    for (int i = 0; i < part.nodes(); ++i) nodesByShares += 1.0 / (1.0 + part.others(i).size());
    TEST_ASSERT(std::is_sorted(part.globalNodes.begin(), part.globalNodes.end()));
    TEST_ASSERT(std::is_sorted(part.globalElements.begin(), part.globalElements.end()));
  }
  TEST_FLOATING_EQUALITY(sumOverRanks(area), 8.0, 1e-13);
  TEST_FLOATING_EQUALITY(sumOverRanks(moment), 8.0, 1e-13);
  TEST_FLOATING_EQUALITY(sumOverRanks(nodesByShares), 2.0 * 25 * 7, 1e-13);
}

TEUCHOS_UNIT_TEST(SubdomainMesh, KeepsTheSidesOfNamedGroups) {
  const Scene scene(7);
  double bottom = 0, contact = 0;
  for (const SubdomainMesh& part : scene.mine)
    for (const auto& [name, sides] : part.sideGroups) {
      TEST_ASSERT(!sides.empty());
      for (const Side& side : sides) {
        const std::vector<int> nodes = part.nodesOf(side);
        const double length = std::abs(part.point(nodes[0])[0] - part.point(nodes[1])[0]);
        if (name == "low_bottom") bottom += length;
        if (name == "low_top" || name == "top_bottom") contact += length;
        if (name == "low_bottom") TEST_EQUALITY(part.point(nodes[0])[1], 0.0);
      }
    }
  TEST_FLOATING_EQUALITY(sumOverRanks(bottom), 4.0, 1e-13);
  TEST_FLOATING_EQUALITY(sumOverRanks(contact), 8.0, 1e-13);
}

TEUCHOS_UNIT_TEST(SubdomainMesh, HasTheRulesOfItsNodes) {
  const Scene scene(7);
  double rules = 0;
  for (const SubdomainMesh& part : scene.mine) {
    for (const NodeRule& rule : part.rules) {
      TEST_EQUALITY(part.point(rule.node)[1], 0.0);
      TEST_EQUALITY(part.point(rule.node)[0], rule.value[0]);
      TEST_ASSERT(rule.fixed[0] && !rule.fixed[1]);
      rules += 1.0 / (1.0 + part.others(rule.node).size());
    }
    int below = 0;
    for (int i = 0; i < part.nodes(); ++i) below += part.point(i)[1] == 0.0;
    TEST_EQUALITY(below, static_cast<int>(part.rules.size()));
  }
  TEST_FLOATING_EQUALITY(sumOverRanks(rules), 25.0, 1e-13);
}

TEUCHOS_UNIT_TEST(SubdomainMesh, HasTheContactEndsOfItsNodes) {
  const Scene scene(7);
  double ends = 0, sides = 0;
  for (const SubdomainMesh& part : scene.mine)
    for (const SubdomainMesh::ContactEnd& end : part.contactEnds) {
      TEST_EQUALITY(part.globalNodes[end.node], end.side > 0 ? end.pair.nodeA : end.pair.nodeB);
      TEST_EQUALITY(end.side, part.body == 0 ? +1 : -1);
      TEST_EQUALITY(part.point(end.node)[1], 1.0);
      ends += 1.0 / (1.0 + part.others(end.node).size());
      sides += end.side / (1.0 + part.others(end.node).size());
    }
  TEST_FLOATING_EQUALITY(sumOverRanks(ends), 50.0, 1e-13);
  TEST_COMPARE(std::abs(sumOverRanks(sides)), <, 1e-12);
}

TEUCHOS_UNIT_TEST(SubdomainMesh, NamesTheOtherHoldersOfANode) {
  // Where every subdomain is on this rank's side of the fence, holders are checked one by one; in general: symmetric.
  const Scene scene(7);
  std::map<std::pair<int, int>, std::set<GlobalId>> told;
  for (const SubdomainMesh& part : scene.mine)
    for (int i = 0; i < part.nodes(); ++i)
      for (int other : part.others(i)) {
        TEST_INEQUALITY(other, part.id);
        TEST_EQUALITY(scene.partition.bodyOf[other], part.body);
        told[{part.id, other}].insert(part.globalNodes[i]);
      }
  for (const SubdomainMesh& a : scene.mine)
    for (const SubdomainMesh& b : scene.mine) {
      if (a.id == b.id) continue;
      std::set<GlobalId> common;
      std::set_intersection(a.globalNodes.begin(), a.globalNodes.end(), b.globalNodes.begin(), b.globalNodes.end(),
                            std::inserter(common, common.end()));
      TEST_ASSERT((told[{a.id, b.id}]) == common);
    }
}

TEUCHOS_UNIT_TEST(SubdomainMesh, LeavesRanksWithoutUnitsEmpty) {
  const Scene scene(4, true);  // few subdomains, most of them in one group
  TEST_EQUALITY(sumOverRanks(static_cast<double>(scene.mine.size())), 4.0);
  for (const SubdomainMesh& part : scene.mine) TEST_EQUALITY(scene.partition.rankOf[part.id], comm()->getRank());
}
