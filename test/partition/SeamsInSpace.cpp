// Vertices, edges and faces of 3D subdomains, against a search through the whole mesh, on any number of ranks.
#include <Teuchos_UnitTestHarness.hpp>
#include <suture/algebra/DisjointSets.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/Seams.hpp>

#include <map>
#include <set>

#include "Scenes.hpp"

namespace {

using namespace suture;
using namespace partitiontesting;

struct Entity {
  EntityKind kind;
  std::vector<int> sharers;
  std::vector<GlobalId> nodes;  // ascending

  bool operator<(const Entity& other) const { return std::tie(kind, sharers, nodes) < std::tie(other.kind, other.sharers, other.nodes); }
};

/// Entities of all ranks; an entity that two ranks describe differently occurs twice.
std::set<Entity> found(const std::vector<SubdomainMesh>& mine) {
  Packer packer;
  for (const SeamEntity& entity : findSeams(mine)) {
    std::vector<GlobalId> nodes = entity.nodes;
    std::sort(nodes.begin(), nodes.end());
    packer.put(static_cast<int>(entity.kind));
    packer.put(entity.sharers);
    packer.put(nodes);
  }
  std::set<Entity> all;
  for (const std::string& bytes : allGather(*comm(), packer.bytes())) {
    Unpacker unpacker(bytes);
    while (!unpacker.done()) {
      Entity entity{static_cast<EntityKind>(unpacker.get<int>()), {}, {}};
      unpacker.get(entity.sharers);
      unpacker.get(entity.nodes);
      all.insert(entity);
    }
  }
  return all;
}

/// The same by definition: nodes with the same sharers are connected along edges, and on sides, that have these sharers.
std::set<Entity> searched(const Mesh& mesh, const std::vector<int>& subdomainOfElement) {
  std::vector<std::set<int>> sharers(mesh.nodes());
  std::map<std::vector<int>, std::set<int>> ofEdge, ofSide;  // by all their nodes, ascending
  std::map<std::vector<int>, std::vector<int>> nodesOf;
  const auto add = [&](auto& where, std::vector<int> nodes, int subdomain) {
    std::sort(nodes.begin(), nodes.end());
    where[nodes].insert(subdomain);
  };
  for (int e = 0; e < mesh.elements(); ++e) {
    const CellInfo& cell = cellInfo(mesh.cells[e]);
    const Span<const int> nodes = mesh.nodesOf(e);
    const int s = subdomainOfElement[e];
    for (const int node : nodes) sharers[node].insert(s);
    for (std::size_t k = 0; k < cell.edges.size(); ++k) {
      std::vector<int> own{nodes[cell.edges[k][0]], nodes[cell.edges[k][1]]};
      if (cell.order == 2) own.push_back(nodes[cell.vertices + static_cast<int>(k)]);
      add(ofEdge, own, s);
    }
    for (const std::vector<int>& side : cell.sideNodes) {
      std::vector<int> own;
      for (const int local : side) own.push_back(nodes[local]);
      add(ofSide, own, s);
    }
  }
  DisjointSets sets(mesh.nodes());
  std::vector<EntityKind> kind(mesh.nodes(), EntityKind::Vertex);
  for (const auto& [where, with] : {std::make_pair(&ofEdge, EntityKind::Edge), std::make_pair(&ofSide, EntityKind::Face)})
    for (const auto& [nodes, own] : *where) {
      if (own.size() < 2) continue;
      int first = -1;
      for (const int node : nodes) {
        if (sharers[node] != own) continue;
        kind[node] = std::max(kind[node], with);
        if (first >= 0) sets.join(first, node);
        first = node;
      }
    }
  std::map<int, Entity> byLowest;
  for (int node = 0; node < mesh.nodes(); ++node) {
    if (sharers[node].size() < 2) continue;
    Entity& entity =
        byLowest.try_emplace(sets.lowest(node), Entity{EntityKind::Vertex, {sharers[node].begin(), sharers[node].end()}, {}}).first->second;
    entity.kind = std::max(entity.kind, kind[node]);
    entity.nodes.push_back(node);
  }
  std::set<Entity> all;
  for (const auto& entry : byLowest) all.insert(entry.second);
  return all;
}

Mesh cube(int blocks, int cells, Cell cell) {
  Box one;
  one.nx = one.ny = one.nz = blocks * cells;
  one.blocksX = one.blocksY = one.blocksZ = blocks;
  one.cell = cell;
  return mesh({one});
}

std::map<EntityKind, int> counts(const std::set<Entity>& all) {
  std::map<EntityKind, int> found;
  for (const Entity& entity : all) ++found[entity.kind];
  return found;
}

}  // namespace

TEUCHOS_UNIT_TEST(SeamsInSpace, KnowsVerticesEdgesAndFacesOfBricks) {
  // k^3 bricks: (k-1)^3 cross points, 3 k (k-1)^2 edges, 3 k^2 (k-1) faces; edges and faces reach the surface of the cube.
  for (const Cell cell : {Cell::Hexahedron8, Cell::Tetrahedron4, Cell::Hexahedron20, Cell::Wedge6})
    for (const int k : {2, 3}) {
      const Mesh grid = cube(k, 2, cell);
      const Partition cut = makePartition(*comm(), grid, Constraints(), named("subdomain_*").list());
      std::map<EntityKind, int> all = counts(found(distribute(*comm(), grid, Constraints(), cut)));
      TEST_EQUALITY(all[EntityKind::Vertex], (k - 1) * (k - 1) * (k - 1));
      TEST_EQUALITY(all[EntityKind::Edge], 3 * k * (k - 1) * (k - 1));
      TEST_EQUALITY(all[EntityKind::Face], 3 * k * k * (k - 1));
    }
}

TEUCHOS_UNIT_TEST(SeamsInSpace, AgreeWithASearchInRaggedSubdomains) {
  for (const Cell cell : {Cell::Tetrahedron4, Cell::Tetrahedron10, Cell::Hexahedron8, Cell::Hexahedron27}) {
    const Mesh grid = cube(1, cellInfo(cell).order == 2 ? 5 : 8, cell);
    const Partition cut = makePartition(*comm(), grid, Constraints(), metis(13).list());
    const std::vector<SubdomainMesh> mine = distribute(*comm(), grid, Constraints(), cut);
    const std::set<Entity> all = found(mine);
    if (!onRoot()) continue;
    const std::set<Entity> expected = searched(grid, cut.subdomainOfElement);
    // Where an edge crosses itself the crossing is a vertex, which the search does not find.
    const auto nodesIn = [](const std::set<Entity>& entities) {
      std::multiset<GlobalId> nodes;
      for (const Entity& entity : entities) nodes.insert(entity.nodes.begin(), entity.nodes.end());
      return nodes;
    };
    TEST_ASSERT(nodesIn(all) == nodesIn(expected));
    TEST_COMPARE(all.size(), >=, expected.size());
    TEST_COMPARE(all.size(), <=, expected.size() + expected.size() / 20);
    out << cellInfo(cell).name << ": " << counts(all)[EntityKind::Vertex] << " vertices, " << counts(all)[EntityKind::Edge] << " edges, "
        << counts(all)[EntityKind::Face] << " faces\n";
  }
}
