#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/partition/Attachments.hpp>
#include <suture/partition/PairHolders.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/partition/PartitionFile.hpp>
#include <suture/partition/cut/ContactGroups.hpp>
#include <suture/partition/cut/Costs.hpp>
#include <suture/partition/cut/Cut.hpp>
#include <suture/partition/cut/Numbering.hpp>
#include <suture/partition/cut/Placement.hpp>

namespace suture {

Schema partitionSchema() {
  return Schema("How the bodies are cut into subdomains.")
      .choice("Type", "METIS",
              {{"METIS", metisSchema()}, {"Named Groups", namedGroupsSchema()}, {kPartitionedMesh, partitionedMeshSchema()}},
              "METIS cuts automatically; Named Groups uses element groups of the mesh; Partitioned Mesh uses the subdomains made by "
              "suture_partition.");
}

namespace {

// Runs of consecutive subdomains. If groups must stay together, the units of placement are whole groups and single subdomains.
std::vector<int> placeSubdomains(const Partition& cut, bool keepGroupsWhole, int ranks) {
  if (!keepGroupsWhole || cut.groups.empty()) return placeInRuns(cut.costOf, ranks);
  std::vector<int> unitOf(cut.subdomains(), -1), unitOfGroup(cut.groups.size(), -1);
  std::vector<long long> weights;
  for (int s = 0; s < cut.subdomains(); ++s) {
    const int group = cut.groupOf[s];
    int unit = group >= 0 ? unitOfGroup[group] : -1;
    if (unit < 0) {
      unit = static_cast<int>(weights.size());
      weights.push_back(0);
      if (group >= 0) unitOfGroup[group] = unit;
    }
    unitOf[s] = unit;
    weights[unit] += cut.costOf[s];
  }
  const std::vector<int> rankOfUnit = placeOnRanks(weights, ranks);
  std::vector<int> rankOf;
  for (int unit : unitOf) rankOf.push_back(rankOfUnit[unit]);
  return rankOf;
}

Partition partitionOf(Cut cut, const Constraints& constraints, const NodeSubdomains& contactHolders, std::vector<long long> costs,
                      bool keepGroupsWhole, int ranks) {
  Partition all;
  all.costOf = std::move(costs);
  all.subdomainOfElement = std::move(cut.subdomainOfElement);
  all.names = std::move(cut.names);
  all.bodyOf = std::move(cut.bodyOf);
  all.bodiesAreConnected = cut.bodiesAreConnected;
  all.notes = constraints.notes;
  all.notes.insert(all.notes.end(), cut.notes.begin(), cut.notes.end());
  all.elementsOf.assign(all.names.size(), 0);
  for (int s : all.subdomainOfElement) ++all.elementsOf[s];
  ContactGroups contact = contactGroups(constraints, contactHolders, all.subdomains());
  all.groupOf = std::move(contact.groupOf);
  all.groups = std::move(contact.groups);
  all.piecesOf = std::move(contact.piecesOf);
  all.rankOf = placeSubdomains(all, keepGroupsWhole, ranks);
  return all;
}

}  // namespace

std::string packed(const Partition& all) {
  Packer packer;
  packer.put(all.names);
  packer.put(all.bodyOf);
  packer.put(all.elementsOf);
  packer.put(all.costOf);
  packer.put(all.groupOf);
  packer.put(all.groups);
  packer.put(all.piecesOf);
  packer.put(all.rankOf);
  packer.put(all.notes);
  return packer.bytes();
}

void unpackInto(const std::string& bytes, Partition& all) {
  Unpacker unpacker(bytes);
  unpacker.get(all.names);
  unpacker.get(all.bodyOf);
  unpacker.get(all.elementsOf);
  unpacker.get(all.costOf);
  unpacker.get(all.groupOf);
  unpacker.get(all.groups);
  unpacker.get(all.piecesOf);
  unpacker.get(all.rankOf);
  unpacker.get(all.notes);
}

void placeOnRanks(Partition& partition, bool keepGroupsWhole, int ranks) {
  partition.rankOf = placeSubdomains(partition, keepGroupsWhole, ranks);
}

Partition makePartition(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Parameters& partition,
                        bool keepGroupsWhole) {
  const std::string type = partition.get<std::string>("Type");
  const bool metis = type == "METIS";
  if (type == kPartitionedMesh)
    throw InputError(pathOf(partition, "Type"),
                     std::string(kPartitionedMesh) + " takes the subdomains from Mesh/File; to cut a mesh, choose METIS or Named Groups");
  auto share = std::make_shared<MeshShare>(shareBodies(comm, mesh));
  Cut cut;
  if (metis) {
    cut = cutByMetis(comm, mesh, partition.sublist(type), *share);
    cut.subdomainOfElement = gatherSubdomains(comm, mesh, *share);
  } else {
    collectivelyOnRoot(comm, "partition", [&] { cut = cutByNamedGroups(mesh, partition.sublist(type)); });
    shareSubdomains(comm, mesh, cut.subdomainOfElement, *share);
    numberSubdomainsAlongCurve(comm, mesh, *share, cut);
  }
  const NodeSubdomains contactHolders = gatherHolders(comm, mesh, *share, nodesInContact(constraints));
  std::vector<long long> costs = expectedCosts(comm, mesh, *share, static_cast<int>(cut.names.size()), contactHolders);
  Partition all;
  std::string bytes;
  collectivelyOnRoot(comm, "partition", [&] {
    all = partitionOf(std::move(cut), constraints, contactHolders, std::move(costs), keepGroupsWhole, comm.getSize());
    bytes = packed(all);
  });
  bytes = broadcast(comm, bytes);
  if (comm.getRank() != 0) unpackInto(bytes, all);
  all.share = share;
  return all;
}

}  // namespace suture
