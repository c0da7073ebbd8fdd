#include <Teuchos_Comm.hpp>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/Cutter.hpp>

namespace suture {
namespace {

// One list of fields for both directions: `each` puts or gets.
template <typename ContactRowRef, typename Each>
void forEachFieldOfRow(ContactRowRef& row, const Each& each) {
  each(row.pair);
  each(row.dofs);
  each(row.coefficients);
  each(row.gap);
  each(row.cluster);
  each(row.points);
}

template <typename SubdomainMeshRef, typename Each>
void forEachField(SubdomainMeshRef& part, const Each& each) {
  each(part.dimension);
  each(part.coordinates);
  each(part.cells);
  each(part.offsets);
  each(part.connectivity);
  each(part.regions);
  each(part.id);
  each(part.body);
  each(part.group);
  each(part.name);
  each(part.globalNodes);
  each(part.globalElements);
  each(part.sideGroups);
  each(part.rules);
  each(part.sharedOffsets);
  each(part.sharedWith);
  each(part.contactEnds);
  each(part.seamSides);
}

void pack(const SubdomainMesh& part, Packer& packer) {
  const auto put = [&packer](const auto& field) { packer.put(field); };
  forEachField(part, put);
  packer.put(part.contactRows.size());
  for (const ContactRow& row : part.contactRows) forEachFieldOfRow(row, put);
}

void unpack(Unpacker& unpacker, SubdomainMesh& part) {
  const auto get = [&unpacker](auto& field) { unpacker.get(field); };
  forEachField(part, get);
  const auto rows = unpacker.get<std::size_t>();
  for (std::size_t i = 0; i < rows; ++i) {
    part.contactRows.emplace_back();
    forEachFieldOfRow(part.contactRows.back(), get);
  }
}

}  // namespace

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
