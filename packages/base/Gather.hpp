#pragma once
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>

#include <string>
#include <vector>

namespace suture {

/// The values of all ranks one after the other on rank 0, in the order of ranks; nothing elsewhere. Collective.
template <typename T>
std::vector<T> joinOnRoot(const Comm& comm, const std::vector<T>& mine) {
  Packer packer;
  packer.put(mine);
  std::vector<T> all;
  for (const std::string& bytes : gatherOnRoot(comm, packer.bytes())) {
    const auto own = Unpacker(bytes).get<std::vector<T>>();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

}  // namespace suture
