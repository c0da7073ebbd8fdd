#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Gather.hpp>
#include <suture/partition/cut/MeshShare.hpp>
#include <suture/partition/cut/Placement.hpp>

#include <Teuchos_Comm.hpp>

#include <algorithm>
#include <memory>
#include <numeric>

namespace suture {

namespace {

const char* const kSharing = "sharing the bodies";

bool allOnRoot(const std::vector<int>& rankOf) {
  return std::all_of(rankOf.begin(), rankOf.end(), [](int rank) { return rank == 0; });
}

std::vector<int> placeBodies(const Mesh& mesh, int ranks) {
  std::vector<long long> elements(mesh.bodies.size(), 0);
  if (elements.size() < 2) return std::vector<int>(elements.size(), 0);
  for (const int body : mesh.bodyOfElement) ++elements[body];
  return placeOnRanks(elements, ranks);
}

void takeAll(const Mesh& mesh, MeshShare& share) {
  share.whole = true;
  share.bodyOfElement = mesh.bodyOfElement.empty() ? std::vector<int>(mesh.elements(), 0) : mesh.bodyOfElement;
}

// Size of a share.
struct ShareSize {
  std::size_t nodes = 0, elements = 0, corners = 0, coatings = 0, coatingNodes = 0;
};

// Nodes and elements by owner, in one pass for all ranks.
struct ByRank {
  std::vector<std::vector<int>> nodes, elements;  // nodes and elements of each rank, ascending
  std::vector<int> local;                         // local number of each mesh node on its rank
  std::vector<ShareSize> extents;                 // sizes of each rank's share

  ByRank(const Mesh& mesh, const std::vector<int>& rankOf, int ranks) : nodes(ranks), elements(ranks), local(mesh.nodes()), extents(ranks) {
    for (int node = 0; node < mesh.nodes(); ++node) {
      std::vector<int>& own = nodes[rankOf[mesh.bodyOfNode[node]]];
      local[node] = static_cast<int>(own.size());
      own.push_back(node);
    }
    for (int e = 0; e < mesh.elements(); ++e) {
      const int rank = rankOf[mesh.bodyOfElement[e]];
      elements[rank].push_back(e);
      extents[rank].corners += mesh.nodesOf(e).size();
    }
    for (const Coating& coating : mesh.coatings) {
      ShareSize& extent = extents[rankOf[mesh.bodyOfElement[coating.element]]];
      ++extent.coatings;
      extent.coatingNodes += mesh.outerNodes(coating).size();
    }
    for (int rank = 0; rank < ranks; ++rank) {
      extents[rank].nodes = nodes[rank].size();
      extents[rank].elements = elements[rank].size();
    }
  }
};

// Adds the coatings on elements of a share. \param local  local number of each node
void takeCoatingsOf(const Mesh& mesh, const std::vector<int>& local, MeshShare& share) {
  for (Coating coating : mesh.coatings) {
    const Span<const int> outer = mesh.outerNodes(coating);
    coating.element = share.localElement(coating.element);
    if (coating.element < 0) continue;
    coating.begin = static_cast<int>(share.own.coatingNodes.size());
    share.own.coatings.push_back(coating);
    for (const int node : outer) share.own.coatingNodes.push_back(local[node]);
  }
}

// Fills the share of a rank; leaves the rank's lists in `all` empty.
void takeBodiesOf(int rank, const Mesh& mesh, ByRank& all, MeshShare& share) {
  share.globalNodes = std::move(all.nodes[rank]);
  share.globalElements = std::move(all.elements[rank]);
  CellBlock& own = share.own;
  own.dimension = mesh.dimension;
  own.axisymmetric = mesh.axisymmetric;
  own.coordinates.reserve(share.globalNodes.size() * mesh.dimension);
  for (const int node : share.globalNodes) {
    const double* place = mesh.coordinates.data() + std::size_t(node) * mesh.dimension;
    own.coordinates.insert(own.coordinates.end(), place, place + mesh.dimension);
  }
  own.cells.reserve(share.globalElements.size());
  own.offsets.reserve(share.globalElements.size() + 1);
  own.connectivity.reserve(all.extents[rank].corners);
  share.bodyOfElement.reserve(share.globalElements.size());
  for (const int e : share.globalElements) {
    share.bodyOfElement.push_back(mesh.bodyOfElement[e]);
    own.cells.push_back(mesh.cells[e]);
    if (!mesh.regions.empty()) own.regions.push_back(mesh.regions[e]);
    for (const int node : mesh.nodesOf(e)) own.connectivity.push_back(all.local[node]);
    own.offsets.push_back(static_cast<int>(own.connectivity.size()));
  }
  takeCoatingsOf(mesh, all.local, share);
}

// Properties common to all shares.
struct Kind {
  int dimension = 0;
  bool axisymmetric = false, hasRegions = false;
};

void makeRoom(const Kind& kind, const ShareSize& extent, MeshShare& share) {
  share.own.dimension = kind.dimension;
  share.own.axisymmetric = kind.axisymmetric;
  share.own.coordinates.resize(extent.nodes * kind.dimension);
  share.own.cells.resize(extent.elements);
  share.own.offsets.resize(extent.elements + 1);
  share.own.connectivity.resize(extent.corners);
  share.own.regions.resize(kind.hasRegions ? extent.elements : 0);
  share.own.coatings.resize(extent.coatings);
  share.own.coatingNodes.resize(extent.coatingNodes);
  share.globalNodes.resize(extent.nodes);
  share.globalElements.resize(extent.elements);
  share.bodyOfElement.resize(extent.elements);
}

// Vectors of a share, listed once for both directions.
template <typename Share, typename Each>
void forEachVector(Share& share, const Each& each) {
  each(share.own.coordinates), each(share.own.cells), each(share.own.offsets), each(share.own.connectivity), each(share.own.regions);
  each(share.own.coatings), each(share.own.coatingNodes);
  each(share.globalNodes), each(share.globalElements), each(share.bodyOfElement);
}

}  // namespace

int MeshShare::localOf(const std::vector<int>& numbers, GlobalId global) const {
  if (whole) return static_cast<int>(global);
  const auto at = std::lower_bound(numbers.begin(), numbers.end(), global);
  return at != numbers.end() && *at == global ? static_cast<int>(at - numbers.begin()) : -1;
}

MeshShare shareBodies(const Comm& comm, const Mesh& mesh) {
  MeshShare mine;
  const int me = comm.getRank();
  std::unique_ptr<ByRank> all;
  std::string common;
  collectivelyOnRoot(comm, kSharing, [&] {
    const std::vector<int> rankOf = placeBodies(mesh, comm.getSize());
    Packer packer;
    packer.put(mesh.bodies);
    packer.put(rankOf);
    if (!allOnRoot(rankOf)) {
      all = std::make_unique<ByRank>(mesh, rankOf, comm.getSize());
      packer.put(Kind{mesh.dimension, mesh.axisymmetric, !mesh.regions.empty()});
      packer.put(all->extents);
    }
    common = packer.bytes();
  });
  Unpacker unpacker(broadcast(comm, common));
  unpacker.get(mine.bodies);
  unpacker.get(mine.rankOf);
  if (allOnRoot(mine.rankOf)) {
    collectivelyOnRoot(comm, kSharing, [&] { takeAll(mesh, mine); });
    return mine;
  }
  const auto kind = unpacker.get<Kind>();
  const auto extents = unpacker.get<std::vector<ShareSize>>();
  // Rank by rank: besides the mesh, at most one share is in memory at a time. Each rank allocates its share while rank 0 prepares it.
  for (int to = 1; to < comm.getSize(); ++to) {
    MeshShare sent;
    collectively(comm, kSharing, [&] {
      if (me == 0) takeBodiesOf(to, mesh, *all, sent);
      if (me == to) makeRoom(kind, extents[to], mine);
    });
    if (me == 0) forEachVector(sent, [&](const auto& values) { send(comm, values, to); });
    if (me == to) forEachVector(mine, [&](auto& values) { receive(comm, values, 0); });
  }
  collectivelyOnRoot(comm, kSharing, [&] { takeBodiesOf(0, mesh, *all, mine); });
  return mine;
}

MeshShare wholeShare(const Mesh& mesh, const std::vector<int>& subdomainOfElement) {
  MeshShare share;
  share.bodies = mesh.bodies;
  share.rankOf.assign(mesh.bodies.size(), 0);
  takeAll(mesh, share);
  share.subdomainOfElement = subdomainOfElement;
  share.holders = nodeSubdomains(mesh, subdomainOfElement);
  return share;
}

void shareSubdomains(const Comm& comm, const Mesh& mesh, const std::vector<int>& subdomainOfElement, MeshShare& share) {
  std::vector<std::vector<int>> of(comm.getSize());  // each rank's elements
  collectivelyOnRoot(comm, kSharing, [&] {
    if (share.whole) return;
    for (int e = 0; e < mesh.elements(); ++e) of[share.rankOf[mesh.bodyOfElement[e]]].push_back(subdomainOfElement[e]);
  });
  const std::string bytes = scatterFromRoot(comm, kSharing, [&](int rank) {
    Packer packer;
    packer.put(of[rank]);
    return std::move(packer).bytes();
  });
  collectively(comm, kSharing, [&] {
    if (share.whole)
      share.subdomainOfElement = subdomainOfElement;
    else
      Unpacker(bytes).get(share.subdomainOfElement);
    share.holders = nodeSubdomains(share.block(mesh), share.subdomainOfElement);
  });
}

std::vector<int> gatherSubdomains(const Comm& comm, const Mesh& mesh, const MeshShare& share) {
  if (allOnRoot(share.rankOf)) return share.subdomainOfElement;
  Packer packer;
  packer.put(share.subdomainOfElement);
  const std::vector<std::string> all = gatherOnRoot(comm, packer.bytes());
  std::vector<int> subdomainOfElement;
  collectivelyOnRoot(comm, kSharing, [&] {
    std::vector<std::vector<int>> of;  // rank -> subdomains of its elements, in their order
    for (const std::string& bytes : all) of.push_back(Unpacker(bytes).get<std::vector<int>>());
    std::vector<std::size_t> next(of.size(), 0);
    subdomainOfElement.reserve(mesh.elements());
    for (const int body : mesh.bodyOfElement) {
      const int rank = share.rankOf[body];
      subdomainOfElement.push_back(of[rank][next[rank]++]);
    }
  });
  return subdomainOfElement;
}

NodeSubdomains gatherHolders(const Comm& comm, const Mesh& mesh, const MeshShare& share, std::vector<int> nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  broadcast(comm, nodes);
  struct Holder {
    int node, subdomain;
  };
  std::vector<Holder> mine;
  for (const int node : nodes) {
    const int local = share.localNode(node);
    if (local < 0) continue;
    for (const int subdomain : share.holders.of(local)) mine.push_back({node, subdomain});
  }
  std::vector<Holder> holders = joinOnRoot(comm, mine);
  NodeSubdomains found;
  collectivelyOnRoot(comm, kSharing, [&] {
    // A node is in one share, where its subdomains are already in order.
    std::stable_sort(holders.begin(), holders.end(), [](const Holder& a, const Holder& b) { return a.node < b.node; });
    found.offsets.assign(static_cast<std::size_t>(mesh.nodes()) + 1, 0);
    for (const Holder& holder : holders) {
      ++found.offsets[holder.node + 1];
      found.subdomains.push_back(holder.subdomain);
    }
    std::partial_sum(found.offsets.begin(), found.offsets.end(), found.offsets.begin());
  });
  return found;
}

}  // namespace suture
