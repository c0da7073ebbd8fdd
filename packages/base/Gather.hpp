#pragma once
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>

#include <vector>

namespace suture {

/// Concatenates the vectors in messages made by Packer. Local.
template <typename T>
std::vector<T> joined(const std::vector<std::string>& messages) {
  std::vector<T> all;
  for (const std::string& bytes : messages)
    for (const T& value : Unpacker(bytes).get<std::vector<T>>()) all.push_back(value);
  return all;
}

/// Concatenates the values of all ranks on rank 0, in the order of ranks; empty elsewhere. Collective.
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

/// Sends the values of a vector to another rank, which calls receive() with a vector of the same size. Without a copy, for long vectors.
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
