#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/interface/Directory.hpp>
#include <suture/partition/cut/Apportion.hpp>
#include <suture/partition/cut/MetisCut.hpp>
#include <suture/precond/coarse/ClusterGraph.hpp>
#include <suture/precond/coarse/CoarseClusters.hpp>

#include <Teuchos_Comm.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Map.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace suture {

namespace {

constexpr int kSeed = 1;

/// Graph of this rank's elements; unknowns are places in `names`.
ClusterGraph ownGraph(const CoarseElements& coarse, const std::vector<int>& names, std::vector<InterfaceLayout::Unknown> unknowns) {
  ClusterGraph graph;
  graph.dimension = coarse.dimension;
  graph.unknowns = std::move(unknowns);
  for (const CoarseElement& element : coarse.elements) graph.unknownsOf.push_back(placesAmong(names, element.unknowns));
  graph.findHolders();
  return graph;
}

/// Cuts each connected part separately.
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

/// This rank's share of the clusters. Collective.
int shareOf(const Comm& comm, int own, int locals, int clusters) {
  int upToOwn = 0;
  Teuchos::scan(comm, Teuchos::REDUCE_SUM, own, Teuchos::outArg(upToOwn));
  const auto clustersUpTo = [&](long long elements) { return static_cast<int>(elements * clusters / locals); };
  return clustersUpTo(upToOwn) - clustersUpTo(upToOwn - own);
}

/// Adds the elements of other ranks that share unknowns with this rank, reduced to these unknowns. Collective.
/// \param ranksOf    ranks that name each unknown
/// \param clusterOf  global cluster numbers; extended by the added elements
void addNeighbours(const Comm& comm, const std::vector<int>& names, const std::vector<std::vector<int>>& ranksOf, ClusterGraph& graph,
                   std::vector<int>& clusterOf) {
  const int rank = comm.getRank();
  std::map<int, Packer> packers;
  for (const auto& own : ranksOf)
    for (const int other : own)
      if (other != rank) packers[other];
  for (std::size_t i = 0; i < graph.unknownsOf.size(); ++i) {
    std::map<int, std::vector<int>> shared;
    for (const int place : graph.unknownsOf[i])
      for (const int other : ranksOf[place])
        if (other != rank) shared[other].push_back(names[place]);
    for (const auto& [other, numbers] : shared) {
      packers[other].put(clusterOf[i]);
      packers[other].put(numbers);
    }
  }
  std::map<int, std::string> bytes;
  for (auto& [other, packer] : packers) bytes[other] = std::move(packer).bytes();
  for (const auto& [other, message] : swapWithNeighbours(comm, bytes))
    for (Unpacker reader(message); !reader.done();) {
      clusterOf.push_back(reader.get<int>());
      graph.unknownsOf.push_back(placesAmong(names, reader.get<std::vector<int>>()));
    }
  graph.findHolders();
}

/// \param first, count  clusters of this rank
InterfaceLayout layoutOf(const ClusterGraph& graph, const std::vector<int>& names, const std::vector<int>& clusterOf, int first,
                         int count) {
  InterfaceLayout layout;
  layout.dimension = graph.dimension;
  for (int k = 0; k < count; ++k) layout.locals.push_back(first + k);
  layout.boundaries.resize(count);
  for (std::size_t u = 0; u < names.size(); ++u) {
    std::set<int> sharers;
    for (const int local : graph.holders[u]) sharers.insert(clusterOf[local]);
    if (sharers.size() < 2) continue;
    layout.unknowns.push_back(graph.unknowns[u]);
    for (const int cluster : sharers)
      if (cluster >= first && cluster < first + count) layout.boundaries[cluster - first].push_back(names[u]);
  }
  const auto isOwn = [&](int cluster) { return cluster >= first && cluster < first + count; };
  for (InterfaceLayout::Entity& entity : clusterEntities(graph, clusterOf)) {
    if (std::none_of(entity.sharers.begin(), entity.sharers.end(), isOwn)) continue;
    for (std::vector<GlobalId>* unknowns : {&entity.unknowns, &entity.ends})
      for (GlobalId& unknown : *unknowns) unknown = names[unknown];
    layout.entities.push_back(std::move(entity));
  }
  return layout;
}

}  // namespace

int automaticClusters(int locals, int ranks) { return std::max(ranks, static_cast<int>(std::lround(std::sqrt(locals)))); }

CoarseClusters coarseClusters(const CommPtr& comm, const CoarseElements& coarse, int locals, int wanted) {
  CoarseClusters result;
  const std::vector<int> names = namesIn(coarse.elements);
  const int own = static_cast<int>(coarse.elements.size());
  const int share = shareOf(*comm, own, locals, std::min(locals, wanted > 0 ? wanted : automaticClusters(locals, comm->getSize())));
  const MapPtr seen = mapOf(comm, {names.begin(), names.end()}), owned = Tpetra::createOneToOne(seen);
  std::vector<InterfaceLayout::Unknown> unknowns = joinUnknowns(seen, owned, coarse.unknowns);
  const auto ranksOf = joinNumbers(seen, owned, std::vector<std::vector<int>>(names.size(), {comm->getRank()}));
  ClusterGraph graph;
  int count = 0, upToOwn = 0;
  collectively(*comm, "gathering local problems into clusters", [&] {
    graph = ownGraph(coarse, names, std::move(unknowns));
    const ElementGraph neighbours = fixedNeighbours(graph);
    result.clusterOf = cut(neighbours, share, count);
    count = divideSlender(graph, neighbours, count, result.clusterOf);
  });
  Teuchos::scan(*comm, Teuchos::REDUCE_SUM, count, Teuchos::outArg(upToOwn));
  Teuchos::reduceAll(*comm, Teuchos::REDUCE_SUM, count, Teuchos::outArg(result.count));
  std::vector<int> clusterOf = result.clusterOf;
  for (int& cluster : clusterOf) cluster += upToOwn - count;
  addNeighbours(*comm, names, ranksOf, graph, clusterOf);
  collectively(*comm, "entities between clusters", [&] { result.layout = layoutOf(graph, names, clusterOf, upToOwn - count, count); });
  return result;
}

}  // namespace suture
