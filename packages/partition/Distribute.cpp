#include <Teuchos_Comm.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/Cutter.hpp>
#include <suture/partition/SubdomainBytes.hpp>

namespace suture {
std::vector<SubdomainMesh> distribute(const Comm& comm, const Mesh& mesh, const Constraints& constraints, const Partition& partition) {
  const std::string what = "distribution of the mesh";
  std::unique_ptr<Cutter> cutter;
  std::vector<std::vector<int>> subdomainsOf;  // of each rank
  collectivelyOnRoot(comm, what, [&] {
    cutter = std::make_unique<Cutter>(mesh, constraints, partition);
    subdomainsOf.resize(comm.getSize());
    for (int s = 0; s < partition.subdomains(); ++s) subdomainsOf[partition.rankOf[s]].push_back(s);
  });
  // Rank by rank, and rank 0's own last and without a message: beside the mesh there is never more than one rank's part.
  std::vector<SubdomainMesh> mine;
  std::string received = scatterFromRoot(comm, what, [&](int rank) {
    Packer packer;
    for (int s : subdomainsOf[rank]) {
      if (rank == 0)
        mine.push_back(cutter->cut(s));
      else
        pack(cutter->cut(s), packer);
    }
    return std::move(packer).bytes();
  });
  collectively(comm, what, [&] {
    Unpacker unpacker(std::move(received));
    while (!unpacker.done()) {
      mine.emplace_back();
      unpack(unpacker, mine.back());
    }
  });
  return mine;
}

}  // namespace suture
