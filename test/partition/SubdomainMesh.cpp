#include <Teuchos_CommHelpers.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <numeric>
#include <set>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/partition/SubdomainMesh.hpp>

#include "Scenes.hpp"

using namespace suture;
using namespace partitiontesting;

namespace {

double sumOverRanks(double mine) {
  double sum = 0;
  Teuchos::reduceAll(*comm(), Teuchos::REDUCE_SUM, mine, Teuchos::outArg(sum));
  return sum;
}

// Two stacked boxes with contact, a rule on the lower side and METIS subdomains.
struct CutScene {
  Mesh whole = mesh({box("low", 0, 4, 0, 1, 24, 6), box("top", 0, 4, 1, 2, 24, 6)});
  Constraints constraints;
  Partition partition;
  std::vector<SubdomainMesh> mine;

  explicit CutScene(int subdomains, bool keepGroupsWhole = false) {
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

TEUCHOS_UNIT_TEST(SubdomainMesh, IsOnTheRankOfThePartition) {
  const CutScene scene(7);
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
  const CutScene scene(7);
  double area = 0, moment = 0, nodesByShares = 0;
  for (const SubdomainMesh& part : scene.mine) {
    for (int e = 0; e < part.elements(); ++e) {
      area += signedSize(part, e);
      moment += signedSize(part, e) * centreOf(part, e)[1];
    }
    // A node counts 1 over its number of holders.
    for (int i = 0; i < part.nodes(); ++i) nodesByShares += 1.0 / (1.0 + part.others(i).size());
    TEST_ASSERT(std::is_sorted(part.globalNodes.begin(), part.globalNodes.end()));
    TEST_ASSERT(std::is_sorted(part.globalElements.begin(), part.globalElements.end()));
  }
  TEST_FLOATING_EQUALITY(sumOverRanks(area), 8.0, 1e-13);
  TEST_FLOATING_EQUALITY(sumOverRanks(moment), 8.0, 1e-13);
  TEST_FLOATING_EQUALITY(sumOverRanks(nodesByShares), 2.0 * 25 * 7, 1e-13);
}

TEUCHOS_UNIT_TEST(SubdomainMesh, KeepsTheSidesOfNamedGroups) {
  const CutScene scene(7);
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
  const CutScene scene(7);
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
  const CutScene scene(7);
  double ends = 0, sides = 0;
  Packer packer;
  packer.put(scene.constraints.pairs);
  const auto pairs = Unpacker(broadcast(*comm(), packer.bytes())).get<std::vector<ContactPair>>();
  for (const SubdomainMesh& part : scene.mine)
    for (const SubdomainMesh::ContactEnd& end : part.contactEnds) {
      TEST_EQUALITY(part.globalNodes[end.node], pairs.at(end.pair).ends[end.end].node);
      TEST_EQUALITY(end.end, part.body == 0 ? 0 : 1);
      TEST_EQUALITY(part.point(end.node)[1], 1.0);
      ends += 1.0 / (1.0 + part.others(end.node).size());
      sides += pairs.at(end.pair).ends[end.end].weight / (1.0 + part.others(end.node).size());
    }
  TEST_FLOATING_EQUALITY(sumOverRanks(ends), 50.0, 1e-13);
  TEST_COMPARE(std::abs(sumOverRanks(sides)), <, 1e-12);
}

TEUCHOS_UNIT_TEST(SubdomainMesh, HasAllRowsOfEveryClusterItTouches) {
  CutScene scene(12);
  if (onRoot()) {  // diagonal pairs in addition to the straight ones: runs of pairs that share unknowns, over more than one subdomain
    const std::vector<ContactPair> straight = scene.constraints.pairs;
    for (std::size_t i : {3, 4, 5, 6, 7, 8, 18, 19}) {
      ContactPair pair = straight[i];
      pair.id = static_cast<int>(scene.constraints.pairs.size());
      pair.ends[1].node = straight[i + 1].ends[1].node;
      scene.constraints.pairs.push_back(pair);
    }
    for (ContactPair& pair : scene.constraints.pairs) {
      pair.normal = {0.6, 0.8, 0};
      pair.gap = 0.01 * pair.id;
    }
  }
  // Rank 0 has the whole mesh: rows by brute force, runs by their construction (pairs 3..9 and 18..20 with the diagonals).
  std::string bytes;
  if (onRoot()) {
    const auto run = [](int pair) {
      const int straight = pair < 25 ? pair : std::vector<int>{3, 4, 5, 6, 7, 8, 18, 19}[pair - 25];
      return straight >= 3 && straight <= 9 ? 3 : straight >= 18 && straight <= 20 ? 18 : straight;
    };
    std::vector<std::vector<int>> expected(12);
    for (int s = 0; s < 12; ++s) {
      std::set<int> nodes, runs;
      for (int e = 0; e < scene.whole.elements(); ++e)
        if (scene.partition.subdomainOfElement[e] == s) nodes.insert(scene.whole.nodesOf(e).begin(), scene.whole.nodesOf(e).end());
      for (const ContactPair& pair : scene.constraints.pairs)
        if (nodes.count(pair.ends[0].node) || nodes.count(pair.ends[1].node)) runs.insert(run(pair.id));
      for (const ContactPair& pair : scene.constraints.pairs)
        if (runs.count(run(pair.id))) expected[s].push_back(pair.id);
    }
    Packer packer;
    packer.put(expected);
    packer.put(scene.constraints.pairs);
    packer.put(scene.whole.coordinates);
    bytes = packer.bytes();
  }
  Unpacker unpacker(broadcast(*comm(), bytes));
  const auto expected = unpacker.get<std::vector<std::vector<int>>>();
  const auto pairs = unpacker.get<std::vector<ContactPair>>();
  const auto coordinates = unpacker.get<std::vector<double>>();

  double distant = 0;  // rows neither of whose nodes is here
  for (const SubdomainMesh& part : distribute(*comm(), scene.whole, scene.constraints, scene.partition)) {
    std::vector<int> found;
    for (const ContactRow& row : part.contactRows) {
      found.push_back(row.pair.id);
      const ContactPair& pair = pairs.at(row.pair.id);
      const std::set<GlobalId> here(part.globalNodes.begin(), part.globalNodes.end());
      distant += !here.count(pair.ends[0].node) && !here.count(pair.ends[1].node);
      // Free Cartesian nodes: (u_A - u_B) . n, component by component.
      std::map<GlobalId, double> row2;
      for (int k = 0; k < 2; ++k) {
        row2[2 * pair.ends[0].node + k] = pair.normal[k];
        row2[2 * pair.ends[1].node + k] = -pair.normal[k];
      }
      const ContactRow::Equation& normal = row.normal();
      TEST_EQUALITY(normal.dofs.size(), 4u);
      TEST_EQUALITY(normal.points.size(), 4u);
      for (std::size_t i = 0; i < normal.dofs.size(); ++i) {
        TEST_EQUALITY(normal.coefficients[i], row2.at(normal.dofs[i]));
        for (int k = 0; k < 2; ++k) TEST_EQUALITY(normal.points[i][k], coordinates[2 * (normal.dofs[i] / 2) + k]);
      }
      TEST_EQUALITY(normal.gap, pair.gap);
      TEST_EQUALITY(row.pair.ends[1].node, pair.ends[1].node);
    }
    TEST_ASSERT(found == expected[part.id]);
  }
  TEST_COMPARE(sumOverRanks(distant), >, 0);
}

TEUCHOS_UNIT_TEST(SubdomainMesh, KnowsTheSidesSharedWithItsNeighbours) {
  using SharedSide = std::array<GlobalId, 4>;  // subdomain, neighbour, end points
  for (int subdomains : {2, 7, 24}) {
    const CutScene scene(subdomains);
    std::vector<SharedSide> mine;
    for (const SubdomainMesh& part : scene.mine) {
      const auto before = [](const SubdomainMesh::SeamSide& a, const SubdomainMesh::SeamSide& b) {
        return std::tie(a.element, a.side) < std::tie(b.element, b.side);
      };
      TEST_ASSERT(std::is_sorted(part.seamSides.begin(), part.seamSides.end(), before));
      for (const SubdomainMesh::SeamSide& seam : part.seamSides) {
        const std::vector<int> nodes = part.nodesOf(Side{seam.element, seam.side});
        const auto [low, high] = std::minmax({part.globalNodes[nodes[0]], part.globalNodes[nodes[1]]});
        mine.push_back({part.id, seam.neighbour, low, high});
      }
    }
    Packer packer;
    packer.put(mine);
    std::vector<SharedSide> found;
    for (const std::string& bytes : gatherOnRoot(*comm(), packer.bytes())) {
      const auto some = Unpacker(bytes).get<std::vector<SharedSide>>();
      found.insert(found.end(), some.begin(), some.end());
    }
    if (!onRoot()) continue;
    std::map<std::pair<int, int>, std::vector<int>> holders;  // holders of each side of the mesh
    for (int e = 0; e < scene.whole.elements(); ++e) {
      const auto nodes = scene.whole.nodesOf(e);
      for (int i = 0; i < 3; ++i) holders[std::minmax(nodes[i], nodes[(i + 1) % 3])].push_back(scene.partition.subdomainOfElement[e]);
    }
    std::vector<SharedSide> expected;
    for (const auto& [ends, two] : holders)
      if (two.size() == 2 && two[0] != two[1]) {
        expected.push_back({two[0], two[1], ends.first, ends.second});
        expected.push_back({two[1], two[0], ends.first, ends.second});
      }
    std::sort(found.begin(), found.end());
    std::sort(expected.begin(), expected.end());
    TEST_ASSERT(found == expected);
    TEST_EQUALITY(expected.empty(), subdomains == 2);
  }
}

TEUCHOS_UNIT_TEST(SubdomainMesh, NamesTheOtherHoldersOfANode) {
  // Holders are checked one by one where every subdomain is on this rank's side of the boundary; in general: symmetric.
  const CutScene scene(7);
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
  const CutScene scene(4, true);  // few subdomains, most of them in one group
  TEST_EQUALITY(sumOverRanks(static_cast<double>(scene.mine.size())), 4.0);
  for (const SubdomainMesh& part : scene.mine) TEST_EQUALITY(scene.partition.rankOf[part.id], comm()->getRank());
}
