#pragma once
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>

#include <vector>

namespace suture {

/// The vectors in messages that Packer made, one after the other. Local.
template <typename T>
std::vector<T> joined(const std::vector<std::string>& messages) {
  std::vector<T> all;
  for (const std::string& bytes : messages)
    for (const T& value : Unpacker(bytes).get<std::vector<T>>()) all.push_back(value);
  return all;
}

/// The values of all ranks one after the other on rank 0, in the order of ranks; nothing elsewhere. Collective.
template <typename T>
std::vector<T> joinOnRoot(const Comm& comm, const std::vector<T>& mine) {
  Packer packer;
  packer.put(mine);
  return joined<T>(gatherOnRoot(comm, packer.bytes()));
}

/// The same on every rank. Collective.
template <typename T>
std::vector<T> joinEverywhere(const Comm& comm, const std::vector<T>& mine) {
  Packer packer;
  packer.put(mine);
  return joined<T>(allGather(comm, packer.bytes()));
}

/// The values of a vector to another rank, which has room for as many and calls receive(). Without a copy: for long ones.
template <typename T>
void send(const Comm& comm, const std::vector<T>& values, int to) {
  static_assert(std::is_trivially_copyable_v<T>);
  sendMemory(comm, values.data(), values.size() * sizeof(T), to);
}
template <typename T>
void receive(const Comm& comm, std::vector<T>& values, int from) {
  static_assert(std::is_trivially_copyable_v<T>);
  receiveMemory(comm, values.data(), values.size() * sizeof(T), from);
}

}  // namespace suture
