#include <suture/base/Gather.hpp>
#include <suture/partition/SubdomainRanks.hpp>

#include <Teuchos_Comm.hpp>

namespace suture {

std::unordered_map<int, int> ranksOfSubdomains(const Comm& comm, const std::vector<SubdomainMesh>& meshes) {
  std::vector<int> mine;
  for (const SubdomainMesh& mesh : meshes) mine.push_back(mesh.id);
  Packer packer;
  packer.put(mine);
  std::unordered_map<int, int> rankOf;
  const std::vector<std::string> all = allGather(comm, packer.bytes());
  for (std::size_t rank = 0; rank < all.size(); ++rank)
    for (const int id : Unpacker(all[rank]).get<std::vector<int>>()) rankOf[id] = static_cast<int>(rank);
  return rankOf;
}

}  // namespace suture
