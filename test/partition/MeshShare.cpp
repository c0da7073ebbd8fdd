// Shares against the mesh that they were made from, and their subdomains against those that one rank cuts alone.
#include <Teuchos_UnitTestHarness.hpp>
#include <random>
#include <set>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/SubdomainBytes.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/partition/cut/MeshShare.hpp>

#include "Scenes.hpp"

using namespace suture;
using namespace partitiontesting;

namespace {

// Elements of several bodies alternate, so that no share is a range of numbers; some of them have a region.
Mesh mixed() {
  Mesh made = mesh({box("low", 0, 4, 0, 1, 24, 6), box("mid", 0, 4, 1, 2, 24, 5), box("top", 0, 4, 2, 3, 24, 4)});
  if (!onRoot()) return made;
  std::vector<int> order(made.elements()), newNumber(made.elements());
  for (int e = 0; e < made.elements(); ++e) order[e] = e;
  std::shuffle(order.begin(), order.end(), std::mt19937(3));
  Mesh all;
  all.coordinates = made.coordinates;
  for (const int e : order) {
    newNumber[e] = all.elements();
    all.cells.push_back(made.cells[e]);
    all.connectivity.insert(all.connectivity.end(), made.nodesOf(e).begin(), made.nodesOf(e).end());
    all.offsets.push_back(static_cast<int>(all.connectivity.size()));
    all.regions.push_back(e % 3 - 1);
  }
  for (const auto& [name, elements] : made.elementGroups)
    for (const int e : elements) all.elementGroups[name].push_back(newNumber[e]);
  for (const auto& [name, sides] : made.sideGroups)
    for (const Side& side : sides) all.sideGroups[name].push_back({newNumber[side.element], side.side});
  assignBodies(all, {"low", "mid", "top"});
  return all;
}

Mesh onAll(const Mesh& mesh) {
  Packer packer;
  if (onRoot()) {
    packer.put(mesh.coordinates), packer.put(mesh.cells), packer.put(mesh.offsets), packer.put(mesh.connectivity);
    packer.put(mesh.regions), packer.put(mesh.bodyOfElement);
  }
  Unpacker unpacker(broadcast(*comm(), packer.bytes()));
  Mesh all;
  unpacker.get(all.coordinates), unpacker.get(all.cells), unpacker.get(all.offsets), unpacker.get(all.connectivity);
  unpacker.get(all.regions), unpacker.get(all.bodyOfElement);
  return all;
}

int sum(int mine) {
  int all = 0;
  for (const std::string& bytes : allGather(*comm(), std::to_string(mine))) all += std::stoi(bytes);
  return all;
}

// Number and bytes of each.
std::string packed(const std::vector<SubdomainMesh>& parts) {
  Packer packer;
  for (const SubdomainMesh& part : parts) {
    Packer one;
    pack(part, one);
    packer.put(part.id);
    packer.put(one.bytes());
  }
  return packer.bytes();
}

}  // namespace

TEUCHOS_UNIT_TEST(MeshShare, HasTheWholeBodiesOfItsRank) {
  const Mesh root = mixed(), whole = onAll(root);
  const MeshShare share = shareBodies(*comm(), root);
  TEST_EQUALITY(share.bodies.size(), 3u);
  TEST_EQUALITY(share.whole, comm()->getSize() == 1);
  const CellBlock& block = share.block(root);
  int expected = 0;
  for (const int body : whole.bodyOfElement) expected += share.rankOf[body] == comm()->getRank();
  TEST_EQUALITY(block.elements(), expected);
  TEST_EQUALITY(sum(block.elements()), whole.elements());
  TEST_EQUALITY(sum(block.nodes()), whole.nodes());
  for (int e = 0; e < block.elements(); ++e) {
    const int global = static_cast<int>(share.globalElement(e));
    TEST_EQUALITY(share.localElement(global), e);
    TEST_EQUALITY(share.bodyOfElement[e], whole.bodyOfElement[global]);
    TEST_EQUALITY(block.regions[e], whole.regions[global]);
    for (int k = 0; k < 3; ++k) {
      const int node = block.nodesOf(e)[k];
      TEST_EQUALITY(share.globalNode(node), whole.nodesOf(global)[k]);
      TEST_EQUALITY(share.localNode(whole.nodesOf(global)[k]), node);
      TEST_ASSERT(block.point(node) == whole.point(whole.nodesOf(global)[k]));
    }
  }
  if (!share.whole) {
    TEST_ASSERT(std::is_sorted(share.globalNodes.begin(), share.globalNodes.end()));
    TEST_ASSERT(std::is_sorted(share.globalElements.begin(), share.globalElements.end()));
  }
}

TEUCHOS_UNIT_TEST(MeshShare, LeavesASingleBodyWhereItIs) {
  const Mesh one = mesh({box("one", 0, 1, 0, 1, 4, 4)});
  const MeshShare share = shareBodies(*comm(), one);
  TEST_EQUALITY(share.whole, onRoot());
  TEST_EQUALITY(share.own.elements(), 0);
  TEST_EQUALITY(share.block(one).elements(), onRoot() ? 32 : 0);
}

TEUCHOS_UNIT_TEST(MeshShare, CarriesSubdomainsThereAndBack) {
  const Mesh root = mixed();
  std::vector<int> subdomainOf;
  for (int e = 0; e < root.elements(); ++e) subdomainOf.push_back(3 * root.bodyOfElement[e] + e % 3);
  MeshShare share = shareBodies(*comm(), root);
  shareSubdomains(*comm(), root, subdomainOf, share);
  TEST_EQUALITY(static_cast<int>(share.subdomainOfElement.size()), share.block(root).elements());
  TEST_ASSERT(gatherSubdomains(*comm(), root, share) == subdomainOf);
  std::vector<int> some;
  for (int node = 0; node < root.nodes(); node += 4) some.insert(some.end(), 2, node);
  const NodeSubdomains holders = gatherHolders(*comm(), root, share, some);
  if (!onRoot()) return;
  for (int node = 0; node < root.nodes(); ++node) {
    std::set<int> expected;
    for (int e = 0; e < root.elements(); ++e)
      for (const int own : root.nodesOf(e))
        if (own == node && node % 4 == 0) expected.insert(subdomainOf[e]);
    TEST_ASSERT(std::equal(holders.of(node).begin(), holders.of(node).end(), expected.begin(), expected.end()));
  }
}

// The bytes of every subdomain equal those made by rank 0 alone, on any rank that cuts or owns it.
TEUCHOS_UNIT_TEST(MeshShare, GivesTheSubdomainsThatOneRankAloneCuts) {
  const Mesh root = mixed();
  Constraints constraints;
  addContact(root, "low_top", "mid_bottom", constraints);
  addContact(root, "mid_top", "top_bottom", constraints);
  if (onRoot())
    for (int node = 0; node < root.nodes(); node += 5) {
      NodeRule rule;
      rule.node = node;
      rule.fixed = {true, false, false};
      rule.value = {0.1 * node, 0, 0};
      constraints.rules.push_back(rule);
    }
  const auto alone = comm()->split(comm()->getRank() == 0 ? 0 : -1, 0);
  for (const int subdomains : {3, 11, 40}) {
    const Partition partition = makePartition(*comm(), root, constraints, metis(subdomains).list(), false);
    const std::string mine = packed(distribute(*comm(), root, constraints, partition));
    Partition madeUp = partition;  // as if rank 0 had made it by hand
    madeUp.share.reset();
    TEST_ASSERT(packed(distribute(*comm(), root, constraints, madeUp)) == mine);
    std::map<int, std::string> found;
    for (const std::string& bytes : gatherOnRoot(*comm(), mine))
      for (Unpacker unpacker(bytes); !unpacker.done();) {
        const int id = unpacker.get<int>();
        unpacker.get(found[id]);
      }
    if (!onRoot()) continue;
    const Partition expected = makePartition(*alone, root, constraints, metis(subdomains).list(), false);
    TEST_ASSERT(expected.subdomainOfElement == partition.subdomainOfElement);
    TEST_ASSERT(expected.names == partition.names);
    TEST_ASSERT(expected.groupOf == partition.groupOf);
    for (const SubdomainMesh& part : distribute(*alone, root, constraints, expected)) {
      Packer one;
      pack(part, one);
      TEST_ASSERT(found.at(part.id) == one.bytes());
    }
    TEST_EQUALITY(found.size(), std::size_t(subdomains));
  }
}
