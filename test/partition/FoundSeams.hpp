#pragma once
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/Seams.hpp>

#include <map>
#include <set>

#include "Scenes.hpp"

namespace partitiontesting {

using namespace suture;

/// An entity; its boundary as nodes of the vertices.
inline void put(const SeamEntity& entity, const std::vector<SeamEntity>& among, Packer& packer) {
  std::vector<GlobalId> boundary;
  for (const int vertex : entity.boundary) boundary.push_back(among[vertex].nodes[0]);
  packer.put(static_cast<int>(entity.kind));
  packer.put(entity.sharers);
  packer.put(entity.nodes);
  packer.put(entity.ends);
  packer.put(boundary);
}

inline SeamEntity read(Unpacker& unpacker) {
  SeamEntity entity;
  entity.kind = static_cast<EntityKind>(unpacker.get<int>());
  unpacker.get(entity.sharers);
  unpacker.get(entity.nodes);
  unpacker.get(entity.ends);
  return entity;
}

/// A mesh, its subdomains (number of each element's, on rank 0), and the result of findSeams().
struct Found {
  Mesh whole;
  std::vector<SubdomainMesh> mine;
  std::vector<SeamEntity> here;  // entities of this rank
  std::vector<SeamEntity> all;   // entities of all ranks, each once, in the order of the first rank that knows it

  Found(const Mesh& given, const std::vector<int>& subdomainOfElement, int subdomains) : whole(given) {
    Partition partition;
    partition.subdomainOfElement = subdomainOfElement;
    for (int s = 0; s < subdomains; ++s) {
      partition.names.push_back("s");
      partition.bodyOf.push_back(0);
      partition.groupOf.push_back(-1);
      partition.rankOf.push_back(s % comm()->getSize());
    }
    find(partition);
  }
  Found(const Mesh& given, const Partition& partition) : whole(given) { find(partition); }

  std::vector<SeamEntity> of(EntityKind kind) const {
    std::vector<SeamEntity> some;
    for (const SeamEntity& entity : all)
      if (entity.kind == kind) some.push_back(entity);
    return some;
  }
  // Nodes that are vertices or ends of edges, each once.
  std::set<GlobalId> points() const {
    std::set<GlobalId> nodes;
    for (const SeamEntity& entity : all)
      if (entity.kind == EntityKind::Vertex)
        nodes.insert(entity.nodes[0]);
      else
        nodes.insert(entity.ends.begin(), entity.ends.end());
    return nodes;
  }
  // The two nodes, or the same twice, between which an edge lies, from front to back; none for a ring.
  std::vector<GlobalId> bounds(const SeamEntity& edge) const {
    std::vector<GlobalId> two = edge.ends;
    for (const int vertex : edge.boundary) two.push_back(all[vertex].nodes[0]);
    if (two.size() == 2 && edge.ends.size() == 1 && edge.ends[0] == edge.nodes.back()) std::swap(two[0], two[1]);
    return two;
  }
  Point point(GlobalId node) const { return whole.point(static_cast<int>(node)); }  // rank 0

 private:
  void find(const Partition& partition) {
    mine = distribute(*comm(), whole, Constraints(), partition);
    here = findSeams(mine);
    Packer packer;
    for (const SeamEntity& entity : here) put(entity, here, packer);
    std::set<std::vector<GlobalId>> seen;
    std::map<GlobalId, int> vertexAt;
    std::vector<std::vector<GlobalId>> boundaries;
    for (const std::string& bytes : allGather(*comm(), packer.bytes())) {
      Unpacker unpacker(bytes);
      while (!unpacker.done()) {
        SeamEntity entity = read(unpacker);
        const auto boundary = unpacker.get<std::vector<GlobalId>>();
        if (!seen.insert(entity.nodes).second) continue;
        if (entity.kind == EntityKind::Vertex) vertexAt[entity.nodes[0]] = static_cast<int>(all.size());
        all.push_back(entity);
        boundaries.push_back(boundary);
      }
    }
    for (std::size_t k = 0; k < all.size(); ++k)
      for (const GlobalId node : boundaries[k]) all[k].boundary.push_back(vertexAt.at(node));
  }
};

inline Found squareBlocks(int n, int cells, Cell cell = Cell::Triangle3) {
  Box one = box("body", 0, 1, 0, 1, n * cells, n * cells, n, n);
  one.cell = cell;
  const Mesh grid = mesh({one});
  return Found(grid, makePartition(*comm(), grid, Constraints(), named("subdomain_*").list()));
}

/// A grid with the subdomain of each element chosen by its centre.
template <typename Choice>
std::vector<int> choose(const Mesh& grid, const Choice& choice) {
  std::vector<int> subdomainOfElement;
  for (int e = 0; e < grid.elements(); ++e) {
    Point centre{0, 0, 0};
    for (int node : grid.nodesOf(e))
      for (int k = 0; k < 2; ++k) centre[k] += grid.point(node)[k] / grid.nodesOf(e).size();
    subdomainOfElement.push_back(choice(centre[0], centre[1]));
  }
  return subdomainOfElement;
}

}  // namespace partitiontesting
