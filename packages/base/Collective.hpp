#pragma once
#include <suture/base/Types.hpp>

#include <functional>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace suture {

/// Runs `local` on every rank and rethrows an exception of any rank as the same exception on all ranks, so no rank waits in a collective
/// for a rank that has left. The problems of several ranks' InputErrors are merged without duplicates. Collective. `local` must not
/// communicate. `what` names the work in the message of an exception that is not a suture::Error ("reading the mesh: bad_alloc").
/// \throws Error  of the kind of the lowest rank that failed (std::bad_alloc becomes EnvironmentError, others InternalError).
void collectively(const Comm& comm, const std::string& what, const std::function<void()>& local);

/// Runs `root` on rank 0 only, with the same guarantee. Collective.
void collectivelyOnRoot(const Comm& comm, const std::string& what, const std::function<void()>& root);

/// The result of `make` on rank 0 and an empty object elsewhere, with the same guarantee. Collective.
template <typename Make>
auto onRoot(const Comm& comm, const std::string& what, const Make& make) {
  decltype(make()) result{};
  collectivelyOnRoot(comm, what, [&] { result = make(); });
  return result;
}

/// Sends a string from rank 0 to all. Collective.
std::string broadcast(const Comm& comm, const std::string& text);

/// Sends `count` bytes from rank 0 to all, in pieces within MPI's int counts. `count` must be the same on all ranks. Collective.
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

/// Byte strings of `senders` on rank `to`, in the order of `senders` (empty elsewhere). Only these ranks take part: successive calls in the
/// same order on all ranks cannot deadlock.
/// \param senders  ascending, without `to`; the same on all ranks that take part
std::vector<std::string> gatherOn(const Comm& comm, int to, const std::vector<int>& senders, const std::string& bytes);

/// Rank 0 gives one byte string per rank; every rank gets its own. Collective.
std::string scatterFromRoot(const Comm& comm, const std::vector<std::string>& bytes);

/// The same, but rank 0 makes each string only after the previous one has been sent, so it never holds more than one. `make` runs on rank 0
/// only, for rank 0 itself last, and must not communicate. `what`: as in collectively(). Collective.
/// \throws what `make` throws, on all ranks
std::string scatterFromRoot(const Comm& comm, const std::string& what, const std::function<std::string(int rank)>& make);

/// Sends bytes from one rank to another; both know the count and call this pair of functions, with no other message between the two calls.
void sendMemory(const Comm& comm, const void* from, std::size_t count, int to);
void receiveMemory(const Comm& comm, void* to, std::size_t count, int from);

/// All ranks' byte strings on every rank, in the order of ranks. Collective.
std::vector<std::string> allGather(const Comm& comm, const std::string& bytes);

/// Exchanges byte strings with neighbours (possibly this rank itself). The relation must be symmetric: each key here has this rank as a
/// key. Only neighbours take part.
std::map<int, std::string> swapWithNeighbours(const Comm& comm, const std::map<int, std::string>& toNeighbours);

/// Union of all ranks' numbers, ascending, without duplicates. Collective.
std::vector<int> unionOverRanks(const Comm& comm, const std::vector<int>& mine);

}  // namespace suture
