#include "Collective.hpp"

#include <Teuchos_Comm.hpp>
#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <exception>
#include <limits>
#include <memory>
#include <new>

#include "Buffer.hpp"
#include "Errors.hpp"
#include "Gather.hpp"
#include "MpiHandle.hpp"
#include "Progress.hpp"

namespace suture {
namespace {

/// MPI counts in int: longer messages are sent in rounds of this many bytes per rank, so that the sum over all ranks fits an int.
std::size_t roundBytes(int ranks) {
  return std::min<std::size_t>(std::size_t(1) << 26, std::numeric_limits<int>::max() / static_cast<std::size_t>(ranks));
}

/// Bytes that every rank sends in one round, and their offsets in the round's buffer.
struct Round {
  std::vector<int> counts, places;
  int total = 0;

  Round(const std::vector<unsigned long long>& sizes, std::size_t begin, std::size_t most) {
    for (const unsigned long long size : sizes) {
      const int count = size > begin ? static_cast<int>(std::min<std::size_t>(size - begin, most)) : 0;
      counts.push_back(count);
      places.push_back(total);
      total += count;
    }
  }
};

/// An exception to be sent to the other ranks.
struct Failure {
  int code = 0;
  std::string message;
  std::vector<Problem> problems;

  std::string packed() const {
    Packer packer;
    packer.put(code);
    packer.put(message);
    packer.put(problems.size());
    for (const Problem& problem : problems) packer.put(problem.path), packer.put(problem.message);
    return packer.bytes();
  }

  static Failure unpacked(const std::string& bytes) {
    Unpacker unpacker(bytes);
    Failure failure;
    unpacker.get(failure.code);
    unpacker.get(failure.message);
    failure.problems.resize(unpacker.get<std::size_t>());
    for (Problem& problem : failure.problems) unpacker.get(problem.path), unpacker.get(problem.message);
    return failure;
  }

  [[noreturn]] void raise() const {
    switch (static_cast<ExitCode>(code)) {
      case ExitCode::Input:
        throw InputError(problems);
      case ExitCode::CommandLine:
        throw CommandLineError(message);
      case ExitCode::Numerical:
        throw NumericalError(message);
      case ExitCode::Environment:
        throw EnvironmentError(message);
      case ExitCode::Internal:
        throw InternalError(message);
      default:
        throw Error(static_cast<ExitCode>(code), message);
    }
  }
};

/// Runs `work`; returns true and the error if it threw.
bool fails(const std::string& what, const std::function<void()>& work, Failure& failure) {
  try {
    work();
    return false;
  } catch (const InputError& error) {
    failure = {static_cast<int>(error.code()), error.what(), error.problems()};
  } catch (const Error& error) {
    failure = {static_cast<int>(error.code()), error.what(), {}};
  } catch (const std::bad_alloc&) {
    failure = {static_cast<int>(ExitCode::Environment), what + ": not enough memory", {}};
  } catch (const std::exception& error) {
    failure = {static_cast<int>(ExitCode::Internal), what + ": " + error.what(), {}};
  } catch (...) {
    failure = {static_cast<int>(ExitCode::Internal), what + ": an exception of unknown type", {}};
  }
  return true;
}

/// A plain Error with the code of an InputError has no list of problems: its message becomes the problem.
void completeProblems(Failure& failure) {
  if (failure.code == static_cast<int>(ExitCode::Input) && failure.problems.empty()) failure.problems.push_back({"", failure.message});
}

}  // namespace

MPI_Comm mpiComm(const Comm& comm) {
  const auto* mpi = dynamic_cast<const Teuchos::MpiComm<int>*>(&comm);
  return mpi ? (*mpi->getRawMpiComm())() : MPI_COMM_SELF;
}

void collectively(const Comm& comm, const std::string& what, const std::function<void()>& local) {
  const Progress::Step step(what);
  Failure mine;
  const bool failed = fails(what, local, mine);
  if (failed) completeProblems(mine);
  if (comm.getSize() == 1) {
    if (failed) mine.raise();
    return;
  }
  int first = failed ? comm.getRank() : comm.getSize();
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, mpiComm(comm));
  if (first == comm.getSize()) return;

  const std::vector<std::string> all = allGather(comm, failed ? mine.packed() : std::string());
  Failure raised = Failure::unpacked(all[first]);
  if (raised.code == static_cast<int>(ExitCode::Input)) {
    for (int rank = first + 1; rank < comm.getSize(); ++rank) {
      if (all[rank].empty()) continue;
      for (const Problem& problem : Failure::unpacked(all[rank]).problems) {
        const auto same = [&](const Problem& other) { return other.path == problem.path && other.message == problem.message; };
        if (std::none_of(raised.problems.begin(), raised.problems.end(), same)) raised.problems.push_back(problem);
      }
    }
  }
  raised.raise();
}

void collectivelyOnRoot(const Comm& comm, const std::string& what, const std::function<void()>& root) {
  collectively(comm, what, [&] {
    if (comm.getRank() == 0) root();
  });
}

void sendMemory(const Comm& comm, const void* from, std::size_t count, int to) {
  const std::size_t most = roundBytes(1);
  for (std::size_t at = 0; at < count; at += most)
    MPI_Send(static_cast<const char*>(from) + at, static_cast<int>(std::min(most, count - at)), MPI_BYTE, to, 0, mpiComm(comm));
}

void receiveMemory(const Comm& comm, void* to, std::size_t count, int from) {
  const std::size_t most = roundBytes(1);
  for (std::size_t at = 0; at < count; at += most)
    MPI_Recv(static_cast<char*>(to) + at, static_cast<int>(std::min(most, count - at)), MPI_BYTE, from, 0, mpiComm(comm),
             MPI_STATUS_IGNORE);
}

namespace {

// Sends the length, then the bytes.
void sendBytes(const Comm& comm, const std::string& bytes, int to) {
  const unsigned long long size = bytes.size();
  MPI_Send(&size, 1, MPI_UNSIGNED_LONG_LONG, to, 0, mpiComm(comm));
  sendMemory(comm, bytes.data(), bytes.size(), to);
}

std::string receiveBytes(const Comm& comm, int from) {
  unsigned long long size = 0;
  MPI_Recv(&size, 1, MPI_UNSIGNED_LONG_LONG, from, 0, mpiComm(comm), MPI_STATUS_IGNORE);
  std::string bytes(size, '\0');
  receiveMemory(comm, bytes.data(), bytes.size(), from);
  return bytes;
}

}  // namespace

void broadcastBytes(const Comm& comm, void* bytes, std::size_t count) {
  if (comm.getSize() == 1) return;
  const std::size_t most = roundBytes(1);
  for (std::size_t at = 0; at < count; at += most) {
    MPI_Bcast(static_cast<char*>(bytes) + at, static_cast<int>(std::min(most, count - at)), MPI_BYTE, 0, mpiComm(comm));
  }
}

std::string broadcast(const Comm& comm, const std::string& text) {
  unsigned long long size = text.size();
  broadcastBytes(comm, &size, sizeof(size));
  std::string all = comm.getRank() == 0 ? text : std::string(size, '\0');
  broadcastBytes(comm, all.data(), all.size());
  return all;
}

std::vector<std::string> gatherOnRoot(const Comm& comm, const std::string& bytes) {
  if (comm.getSize() == 1) return {bytes};
  const int ranks = comm.getSize();
  const bool root = comm.getRank() == 0;
  const MPI_Comm mpi = mpiComm(comm);
  // Every rank knows all sizes: the number of rounds is the same everywhere.
  const unsigned long long mine = bytes.size();
  std::vector<unsigned long long> sizes(ranks);
  MPI_Allgather(&mine, 1, MPI_UNSIGNED_LONG_LONG, sizes.data(), 1, MPI_UNSIGNED_LONG_LONG, mpi);

  std::vector<std::string> all(root ? ranks : 0);
  std::string buffer;
  const std::size_t most = roundBytes(ranks);
  const std::size_t longest = *std::max_element(sizes.begin(), sizes.end());
  for (std::size_t at = 0; at < longest; at += most) {
    const Round round(sizes, at, most);
    if (root) buffer.resize(round.total);
    MPI_Gatherv(bytes.data() + std::min(at, bytes.size()), round.counts[comm.getRank()], MPI_BYTE, buffer.data(), round.counts.data(),
                round.places.data(), MPI_BYTE, 0, mpi);
    for (int rank = 0; root && rank < ranks; ++rank) all[rank].append(buffer, round.places[rank], round.counts[rank]);
  }
  return all;
}

std::vector<std::string> gatherOn(const Comm& comm, int to, const std::vector<int>& senders, const std::string& bytes) {
  const int me = comm.getRank();
  std::vector<std::string> all;
  if (me == to)
    for (const int from : senders) all.push_back(receiveBytes(comm, from));
  else if (std::binary_search(senders.begin(), senders.end(), me))
    sendBytes(comm, bytes, to);
  return all;
}

std::string scatterFromRoot(const Comm& comm, const std::vector<std::string>& bytes) {
  collectivelyOnRoot(comm, "distributing data", [&] {
    if (bytes.size() != static_cast<std::size_t>(comm.getSize()))
      throw InternalError("scatterFromRoot was given " + std::to_string(bytes.size()) + " strings for " + std::to_string(comm.getSize()) +
                          " ranks");
  });
  return scatterFromRoot(comm, "distributing data", [&](int rank) { return bytes[rank]; });
}

std::string scatterFromRoot(const Comm& comm, const std::string& what, const std::function<std::string(int rank)>& make) {
  const int mine = comm.getRank(), ranks = comm.getSize();
  std::string bytes;
  for (int rank = 1; rank < ranks; ++rank) {
    std::string sent;
    collectivelyOnRoot(comm, what, [&] { sent = make(rank); });
    if (mine == 0) sendBytes(comm, sent, rank);
    if (mine == rank) bytes = receiveBytes(comm, 0);
  }
  collectivelyOnRoot(comm, what, [&] { bytes = make(0); });
  return bytes;
}

std::vector<std::string> allGather(const Comm& comm, const std::string& bytes) {
  if (comm.getSize() == 1) return {bytes};
  const int ranks = comm.getSize();
  const MPI_Comm mpi = mpiComm(comm);
  const unsigned long long mine = bytes.size();
  std::vector<unsigned long long> sizes(ranks);
  MPI_Allgather(&mine, 1, MPI_UNSIGNED_LONG_LONG, sizes.data(), 1, MPI_UNSIGNED_LONG_LONG, mpi);

  std::vector<std::string> all(ranks);
  std::string buffer;
  const std::size_t most = roundBytes(ranks);
  const std::size_t longest = *std::max_element(sizes.begin(), sizes.end());
  for (std::size_t at = 0; at < longest; at += most) {
    const Round round(sizes, at, most);
    buffer.resize(round.total);
    MPI_Allgatherv(bytes.data() + std::min(at, bytes.size()), round.counts[comm.getRank()], MPI_BYTE, buffer.data(), round.counts.data(),
                   round.places.data(), MPI_BYTE, mpi);
    for (int rank = 0; rank < ranks; ++rank) all[rank].append(buffer, round.places[rank], round.counts[rank]);
  }
  return all;
}

namespace {

/// Messages under way and their buffers. If an exception passes, they stay in memory: until the job ends MPI may write into the buffers.
class Messages {
 public:
  struct Data {
    std::vector<unsigned long long> mine, theirs;  // sizes
    std::map<int, std::string> received;
    std::vector<MPI_Request> requests;
  };
  Messages() : data_(std::make_unique<Data>()), exceptions_(std::uncaught_exceptions()) {}
  ~Messages() {
    if (std::uncaught_exceptions() > exceptions_ && !data_->requests.empty()) static_cast<void>(data_.release());
  }
  Messages(const Messages&) = delete;
  Messages& operator=(const Messages&) = delete;
  Data* operator->() { return data_.get(); }

  MPI_Request* next() { return &data_->requests.emplace_back(); }
  void wait() {
    MPI_Waitall(static_cast<int>(data_->requests.size()), data_->requests.data(), MPI_STATUSES_IGNORE);
    data_->requests.clear();
  }

 private:
  std::unique_ptr<Data> data_;
  int exceptions_;
};

}  // namespace

std::map<int, std::string> swapWithNeighbours(const Comm& comm, const std::map<int, std::string>& toNeighbours) {
  constexpr int tag = 7321;
  Messages messages;
  std::map<int, std::string>& received = messages->received;
  if (const auto own = toNeighbours.find(comm.getRank()); own != toNeighbours.end()) received[own->first] = own->second;
  std::vector<int> ranks;
  for (const auto& [rank, bytes] : toNeighbours)
    if (rank != comm.getRank()) ranks.push_back(rank);
  if (ranks.empty()) return std::move(received);
  const MPI_Comm mpi = mpiComm(comm);
  const std::size_t most = 1u << 30;  // bytes of a message, which MPI counts in an int
  messages->mine.resize(ranks.size());
  messages->theirs.resize(ranks.size());
  for (std::size_t k = 0; k < ranks.size(); ++k) {
    messages->mine[k] = toNeighbours.at(ranks[k]).size();
    MPI_Irecv(&messages->theirs[k], 1, MPI_UNSIGNED_LONG_LONG, ranks[k], tag, mpi, messages.next());
    MPI_Isend(&messages->mine[k], 1, MPI_UNSIGNED_LONG_LONG, ranks[k], tag, mpi, messages.next());
  }
  messages.wait();
  for (std::size_t k = 0; k < ranks.size(); ++k) {
    std::string& target = received[ranks[k]];
    const std::string& source = toNeighbours.at(ranks[k]);
    target.resize(messages->theirs[k]);
    for (std::size_t at = 0; at < target.size(); at += most)
      MPI_Irecv(target.data() + at, static_cast<int>(std::min(most, target.size() - at)), MPI_BYTE, ranks[k], tag + 1, mpi,
                messages.next());
    for (std::size_t at = 0; at < source.size(); at += most)
      MPI_Isend(source.data() + at, static_cast<int>(std::min(most, source.size() - at)), MPI_BYTE, ranks[k], tag + 1, mpi,
                messages.next());
  }
  messages.wait();
  return std::move(received);
}

std::vector<int> unionOverRanks(const Comm& comm, const std::vector<int>& mine) {
  std::vector<int> all = joinEverywhere(comm, mine);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace suture
