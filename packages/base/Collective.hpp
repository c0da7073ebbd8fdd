#pragma once
#include <suture/base/Types.hpp>

#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace suture {

/// Runs `local` on every rank and turns an exception on any of them into the same exception on all, so that no rank waits in a
/// collective for one that left. The problems of InputErrors of several ranks are merged (each once). Collective. `local` must not
/// communicate. `what` names the work in the message of an exception that is not one of ours ("reading the mesh: bad_alloc").
/// \throws Error  of the kind of the lowest rank that failed (std::bad_alloc becomes EnvironmentError, other ones InternalError).
void collectively(const Comm& comm, const std::string& what, const std::function<void()>& local);

/// Runs `root` on rank 0 only, with the same promise. Collective.
void collectivelyOnRoot(const Comm& comm, const std::string& what, const std::function<void()>& root);

/// The result of `make` on rank 0, an empty object elsewhere, with the same promise. Collective.
template <typename Make>
auto onRoot(const Comm& comm, const std::string& what, const Make& make) {
  decltype(make()) result{};
  collectivelyOnRoot(comm, what, [&] { result = make(); });
  return result;
}

/// Sends a string from rank 0 to all. Collective.
std::string broadcast(const Comm& comm, const std::string& text);

/// Sends `count` bytes from rank 0 to all, in pieces that MPI can count. Every rank must give the same count. Collective.
void broadcastBytes(const Comm& comm, void* bytes, std::size_t count);

/// Sends a vector of plain values from rank 0 to all; elsewhere it is resized. Collective.
template <typename T>
void broadcast(const Comm& comm, std::vector<T>& values) {
  static_assert(std::is_trivially_copyable_v<T>, "only plain values travel as bytes");
  unsigned long long size = values.size();
  broadcastBytes(comm, &size, sizeof(size));
  values.resize(size);
  broadcastBytes(comm, values.data(), size * sizeof(T));
}

/// All ranks' byte strings on rank 0, in the order of ranks (empty elsewhere). Collective.
std::vector<std::string> gatherOnRoot(const Comm& comm, const std::string& bytes);

/// Byte strings of some ranks on one of the others, in the order of `senders` (empty elsewhere). Only they take part: calls one after the
/// other, in the same order on all ranks, cannot block each other.
/// \param senders  ascending, without `to`; the same on all that take part
std::vector<std::string> gatherOn(const Comm& comm, int to, const std::vector<int>& senders, const std::string& bytes);

/// Rank 0 gives one byte string a rank; every rank gets its own. Collective.
std::string scatterFromRoot(const Comm& comm, const std::vector<std::string>& bytes);

/// The same, but made one after the other, each when the one before is gone: rank 0 never holds more than one. `make` runs on rank 0 only,
/// for itself last, and must not communicate. `what`: as in collectively(). Collective. \throws what `make` throws, on all ranks
std::string scatterFromRoot(const Comm& comm, const std::string& what, const std::function<std::string(int rank)>& make);

/// Bytes from one rank to another, both of which know how many and call these two. They must be done with before anything else is sent.
void sendMemory(const Comm& comm, const void* from, std::size_t count, int to);
void receiveMemory(const Comm& comm, void* to, std::size_t count, int from);

/// All ranks' byte strings on every rank, in the order of ranks. Collective.
std::vector<std::string> allGather(const Comm& comm, const std::string& bytes);

/// Swaps byte strings with neighbours: a rank that is a key here has this rank as a key, too (it may be itself). Only neighbours take part.
std::map<int, std::string> swapWithNeighbours(const Comm& comm, const std::map<int, std::string>& toNeighbours);

/// Numbers that any rank gave, ascending, each once. Collective.
std::vector<int> unionOverRanks(const Comm& comm, const std::vector<int>& mine);

}  // namespace suture
