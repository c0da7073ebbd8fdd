#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/cut/Apportion.hpp>
#include <suture/partition/cut/MetisCut.hpp>
#include <suture/precond/coarse/ClusterGraph.hpp>
#include <suture/precond/coarse/CoarseClusters.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace suture {

namespace {

constexpr int kSeed = 1;

struct PlainUnknown {
  GlobalId id;
  Point point, direction, moment;
};

/// Rank of a local problem, and its place there.
struct Place {
  int rank, place;
};

std::string connectionsOf(const CoarseElements& coarse) {
  std::vector<int> ids;
  std::vector<std::vector<int>> unknownsOf;
  for (const CoarseElement& element : coarse.elements) {
    ids.push_back(element.id);
    unknownsOf.push_back(element.unknowns);
  }
  std::vector<PlainUnknown> unknowns;
  for (const InterfaceLayout::Unknown& u : coarse.unknowns) unknowns.push_back({u.id, u.point, u.direction, u.moment});
  Packer packer;
  packer.put(coarse.dimension);
  packer.put(ids);
  packer.put(unknownsOf);
  packer.put(unknowns);
  return packer.bytes();
}

ClusterGraph readConnections(const std::vector<std::string>& bytes, int size, std::vector<Place>& places) {
  std::map<int, std::pair<Place, std::vector<int>>> byId;
  ClusterGraph graph;
  graph.unknowns.resize(size);
  for (std::size_t rank = 0; rank < bytes.size(); ++rank) {
    Unpacker reader(bytes[rank]);
    graph.dimension = std::max(graph.dimension, reader.get<int>());
    const auto ids = reader.get<std::vector<int>>();
    auto unknownsOf = reader.get<std::vector<std::vector<int>>>();
    for (std::size_t i = 0; i < ids.size(); ++i) byId[ids[i]] = {{static_cast<int>(rank), static_cast<int>(i)}, std::move(unknownsOf[i])};
    for (const PlainUnknown& u : reader.get<std::vector<PlainUnknown>>()) graph.unknowns[u.id] = {u.id, u.point, u.direction, u.moment};
  }
  for (auto& [id, entry] : byId) {
    places.push_back(entry.first);
    graph.unknownsOf.push_back(std::move(entry.second));
  }
  graph.findHolders();
  return graph;
}

/// Every connected part by itself.
std::vector<int> cut(const ElementGraph& graph, int wanted, int& count) {
  const Components parts = components(graph, std::vector<int>(graph.elements(), 0));
  std::vector<int> sizes;
  for (const auto& part : parts.elements) sizes.push_back(static_cast<int>(part.size()));
  count = std::max(parts.count(), std::min(wanted, graph.elements()));
  if (sizes.empty()) return {};
  const std::vector<int> shares = apportion(sizes, count);
  std::vector<int> clusterOf(graph.elements());
  const std::vector<ElementGraph> graphs = subgraphs(graph, parts.of, parts.count());
  int first = 0;
  for (int c = 0; c < parts.count(); ++c) {
    const std::vector<int> own = metisCut(graphs[c], shares[c], kSeed);
    for (std::size_t k = 0; k < own.size(); ++k) clusterOf[parts.elements[c][k]] = first + own[k];
    first += shares[c];
  }
  return clusterOf;
}

/// Each to the rank that holds most of its members, as long as there is room.
std::vector<int> ranksOf(const std::vector<int>& clusterOf, int count, const std::vector<Place>& places, int ranks) {
  std::vector<std::map<int, int>> members(count);
  for (std::size_t i = 0; i < clusterOf.size(); ++i) ++members[clusterOf[i]][places[i].rank];
  std::vector<int> held(ranks, 0), rankOf(count);
  const int most = (count + ranks - 1) / ranks;
  for (int c = 0; c < count; ++c) {
    int best = -1, votes = -1;
    for (const auto& [rank, number] : members[c])
      if (held[rank] < most && number > votes) best = rank, votes = number;
    if (best < 0) best = static_cast<int>(std::min_element(held.begin(), held.end()) - held.begin());
    rankOf[c] = best;
    ++held[best];
  }
  return rankOf;
}

/// One rank's part, in the making.
struct Part {
  std::vector<int> clusterOf, rankOf;  // by place
  std::set<int> neighbours;
  std::vector<int> clusters;
  std::vector<std::vector<GlobalId>> boundaries;
  std::set<int> unknowns;
  std::vector<int> entities;
};

std::string pack(const Part& part, const ClusterGraph& graph, const std::vector<InterfaceLayout::Entity>& all, int count) {
  std::vector<PlainUnknown> unknowns;
  for (const int u : part.unknowns) unknowns.push_back({u, graph.unknowns[u].point, graph.unknowns[u].direction, graph.unknowns[u].moment});
  Packer packer;
  packer.put(part.clusterOf);
  packer.put(part.rankOf);
  packer.put(std::vector<int>(part.neighbours.begin(), part.neighbours.end()));
  packer.put(part.clusters);
  packer.put(part.boundaries);
  packer.put(unknowns);
  packer.put(part.entities.size());
  for (const int e : part.entities) {
    packer.put(all[e].kind);
    packer.put(all[e].sharers);
    packer.put(all[e].unknowns);
    packer.put(all[e].ends);
  }
  packer.put(graph.dimension);
  packer.put(count);
  return packer.bytes();
}

CoarseClusters unpack(const std::string& bytes) {
  CoarseClusters result;
  Unpacker reader(bytes);
  reader.get(result.clusterOf);
  reader.get(result.rankOf);
  reader.get(result.neighbours);
  reader.get(result.layout.locals);
  reader.get(result.layout.boundaries);
  for (const PlainUnknown& u : reader.get<std::vector<PlainUnknown>>())
    result.layout.unknowns.push_back({u.id, u.point, u.direction, u.moment});
  result.layout.entities.resize(reader.get<std::size_t>());
  for (InterfaceLayout::Entity& entity : result.layout.entities) {
    reader.get(entity.kind);
    reader.get(entity.sharers);
    reader.get(entity.unknowns);
    reader.get(entity.ends);
  }
  reader.get(result.layout.dimension);
  reader.get(result.count);
  return result;
}

std::vector<std::string> divide(const std::vector<std::string>& connections, int size, int wanted) {
  std::vector<Place> places;
  const int ranks = static_cast<int>(connections.size());
  const ClusterGraph graph = readConnections(connections, size, places);
  const int locals = static_cast<int>(places.size());
  int count = 0;
  const std::vector<int> clusterOf = cut(fixedNeighbours(graph), wanted > 0 ? wanted : automaticClusters(locals, ranks), count);
  const std::vector<int> rankOf = ranksOf(clusterOf, count, places, ranks);
  const std::vector<InterfaceLayout::Entity> all = clusterEntities(graph, clusterOf);

  std::vector<Part> parts(ranks);
  for (int i = 0; i < locals; ++i) {
    Part& part = parts[places[i].rank];
    const int holder = rankOf[clusterOf[i]];
    part.clusterOf.resize(std::max<std::size_t>(part.clusterOf.size(), places[i].place + 1));
    part.rankOf.resize(part.clusterOf.size());
    part.clusterOf[places[i].place] = clusterOf[i];
    part.rankOf[places[i].place] = holder;
    part.neighbours.insert(holder);
    parts[holder].neighbours.insert(places[i].rank);
  }
  std::vector<int> local(count);
  for (int c = 0; c < count; ++c) {
    Part& part = parts[rankOf[c]];
    local[c] = static_cast<int>(part.clusters.size());
    part.clusters.push_back(c);
    part.boundaries.emplace_back();
  }
  for (int u = 0; u < size; ++u) {
    std::set<int> sharers;
    for (const int i : graph.holders[u]) sharers.insert(clusterOf[i]);
    if (sharers.size() < 2) continue;
    for (const int c : sharers) {
      parts[rankOf[c]].boundaries[local[c]].push_back(u);
      parts[rankOf[c]].unknowns.insert(u);
    }
  }
  for (std::size_t e = 0; e < all.size(); ++e) {
    std::set<int> seers;
    for (const int cluster : all[e].sharers) seers.insert(rankOf[cluster]);
    for (const int rank : seers) parts[rank].entities.push_back(static_cast<int>(e));
  }
  std::vector<std::string> bytes;
  for (const Part& part : parts) bytes.push_back(pack(part, graph, all, count));
  return bytes;
}

}  // namespace

int automaticClusters(int locals, int ranks) { return std::max(ranks, static_cast<int>(std::lround(std::sqrt(locals)))); }

CoarseClusters coarseClusters(const Comm& comm, const CoarseElements& coarse, int wanted) {
  const std::vector<std::string> connections = gatherOnRoot(comm, connectionsOf(coarse));
  std::vector<std::string> parts;
  collectivelyOnRoot(comm, "gathering local problems into clusters", [&] { parts = divide(connections, coarse.size, wanted); });
  return unpack(scatterFromRoot(comm, parts));
}

}  // namespace suture
