#include <Teuchos_Comm.hpp>
#include <algorithm>
#include <memory>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/Cutter.hpp>
#include <suture/partition/PairHolders.hpp>
#include <suture/partition/SubdomainBytes.hpp>

namespace suture {
namespace {

const char* const what = "distribution of the mesh";

Attachments shareAttachments(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition,
                             const MeshShare& share) {
  const NodeSubdomains contactHolders = gatherHolders(comm, mesh, share, nodesInContact(constraints));
  std::vector<Attachments> all;
  collectivelyOnRoot(comm, what, [&] { all = attachmentsOf(mesh, constraints, partition, share, comm.getSize(), contactHolders); });
  Attachments mine;
  const std::string bytes = scatterFromRoot(comm, what, [&](int rank) {
    Packer packer;
    if (rank == 0)
      mine = std::move(all[0]);
    else
      packer.put(all[rank]);
    return std::move(packer).bytes();
  });
  collectively(comm, what, [&] {
    if (!bytes.empty()) Unpacker(bytes).get(mine);
  });
  return mine;
}

}  // namespace

std::vector<SubdomainMesh> distribute(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition) {
  std::shared_ptr<const MeshShare> share = partition.share;
  if (!share) {  // the partition was not made by makePartition()
    auto made = std::make_shared<MeshShare>(shareBodies(comm, mesh));
    shareSubdomains(comm, mesh, partition.subdomainOfElement, *made);
    share = made;
  }
  const Attachments attachments = shareAttachments(comm, mesh, constraints, partition, *share);
  std::unique_ptr<Cutter> cutter;
  collectively(comm, what, [&] { cutter = std::make_unique<Cutter>(mesh, *share, attachments, partition); });
  const auto cutterOf = [&](int subdomain) { return share->rankOfBody(partition.bodyOf[subdomain]); };

  // Rank by rank: besides its share, no rank ever holds more than one other rank's part of it, and its own part last.
  std::vector<SubdomainMesh> mine;
  const int me = comm.getRank();
  mine.reserve(std::count(partition.rankOf.begin(), partition.rankOf.end(), me));
  for (int to = 0; to < comm.getSize(); ++to) {
    Packer packer;
    std::vector<int> senders;
    for (int s = 0; s < partition.subdomains(); ++s)
      if (partition.rankOf[s] == to) senders.push_back(cutterOf(s));
    std::sort(senders.begin(), senders.end());
    senders.erase(std::unique(senders.begin(), senders.end()), senders.end());
    senders.erase(std::remove(senders.begin(), senders.end(), to), senders.end());
    collectively(comm, what, [&] {
      if (to == me) return;
      for (int s = 0; s < partition.subdomains(); ++s)
        if (partition.rankOf[s] == to && cutterOf(s) == me) pack(cutter->cut(s), packer);
    });
    const std::vector<std::string> received = gatherOn(comm, to, senders, packer.bytes());
    collectively(comm, what, [&] {
      for (const std::string& bytes : received)
        for (Unpacker unpacker(bytes); !unpacker.done();) {
          mine.emplace_back();
          unpack(unpacker, mine.back());
        }
    });
  }
  collectively(comm, what, [&] {
    for (int s = 0; s < partition.subdomains(); ++s)
      if (partition.rankOf[s] == me && cutterOf(s) == me) mine.push_back(cutter->cut(s));
    std::sort(mine.begin(), mine.end(), [](const SubdomainMesh& a, const SubdomainMesh& b) { return a.id < b.id; });
  });
  return mine;
}

}  // namespace suture
