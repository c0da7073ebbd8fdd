#include <Teuchos_UnitTestHarness.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/RenewConstraints.hpp>
#include <suture/partition/SubdomainBytes.hpp>

#include "Scenes.hpp"

using namespace suture;
using namespace partitiontesting;

namespace {

std::string bytesOfAll(const std::vector<SubdomainMesh>& parts) {
  Packer packer;
  for (const SubdomainMesh& part : parts) pack(part, packer);
  return packer.bytes();
}

constexpr std::size_t kPositions[] = {2, 20};  // nodes of the group that may have its master

/// Three stacked boxes. \param upper  contact of the upper boxes instead of the lower ones \param turn  of the free motion of a rigid group
/// \param master  which of its nodes that may
Constraints constraintsOf(const Mesh& mesh, bool upper, double turn, std::size_t master) {
  Constraints constraints;
  addContact(mesh, upper ? "mid_top" : "low_top", upper ? "top_bottom" : "mid_bottom", constraints);
  if (!onRoot()) return constraints;
  RigidGroup group;
  group.condition = 0;
  for (const Side& side : mesh.sideGroups.at("top_top"))
    for (const int node : mesh.nodesOf(side)) group.nodes.push_back(node);
  std::sort(group.nodes.begin(), group.nodes.end());
  group.nodes.erase(std::unique(group.nodes.begin(), group.nodes.end()), group.nodes.end());
  for (const std::size_t position : kPositions) group.positionNodes.push_back(group.nodes[position]);
  group.masterNodes = {group.positionNodes[master]};
  group.masterComponents = {1};
  for (std::size_t i = 0; i < 2 * group.nodes.size(); ++i) group.coefficients.push_back(turn * static_cast<double>(i));
  constraints.rigidGroups.push_back(group);
  constraints.conditions = {"platen"};
  for (int node = upper ? 0 : 3; node < mesh.nodes(); node += 5) {
    NodeRule rule;
    rule.node = node;
    rule.fixed = {true, false, false};
    rule.value = {0.1 * node * turn, 0, 0};
    constraints.rules.push_back(rule);
    constraints.supports.push_back({node, 0, {1, 0, 0}, {1, 0, 0}, false});
  }
  return constraints;
}

// The subdomains are those that distribute() makes of the new constraints, byte by byte.
TEUCHOS_UNIT_TEST(RenewConstraints, GivesTheSubdomainsOfDistribute) {
  const Mesh whole = mesh({box("low", 0, 4, 0, 1, 24, 6), box("mid", 0, 4, 1, 2, 24, 6), box("top", 0, 4, 2, 3, 24, 6)});
  const Constraints drawn = constraintsOf(whole, false, 0.1, 0);
  for (const int subdomains : {3, 11, 40}) {
    const Partition partition = makePartition(*comm(), whole, drawn, metis(subdomains).list(), false);
    std::vector<SubdomainMesh> meshes = distribute(*comm(), whole, drawn, partition);
    for (const std::size_t master : {0, 1}) {  // also another one than that of the drawn mesh
      const Constraints moved = constraintsOf(whole, true, 0.3, master);
      const std::string before = bytesOfAll(meshes), expected = bytesOfAll(distribute(*comm(), whole, moved, partition));
      TEST_ASSERT(master > 0 || meshes.empty() || before != expected);
      renewConstraints(*comm(), whole, moved, meshes);
      TEST_ASSERT(bytesOfAll(meshes) == expected);
    }
  }
}

}  // namespace
