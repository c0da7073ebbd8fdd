#pragma once
#include <mpi.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>

namespace mpiorder {

/// One collective of one rank, where the other ranks can read it.
struct Entry {
  std::atomic<std::uint64_t> number;  ///< 1, 2, ... on its communicator; written last
  std::uint64_t bytes;                ///< that all ranks must agree on; 0: none
  std::uint64_t place;                ///< hash of the calling place, the same in all processes
  std::uint32_t placeText;            ///< see Board::keep()
  std::int32_t root;                  ///< -1: none
  std::int32_t operation;             ///< operation of a reduction; 0: none, or one of the caller's
  std::int32_t functionIndex;
};

/// Exit code of a job that this library ends.
constexpr int kExitCode = 97;

/// Current activity of a rank.
struct RankState {
  std::atomic<std::uint64_t> steps;         ///< grows with each MPI call that begins or ends
  std::atomic<std::int32_t> functionIndex;  ///< in which blocking function it is, -1: in none
  std::atomic<std::uint32_t> placeText;
};

/// Memory that all ranks of the job share; they run on one machine.
class Board {
 public:
  static constexpr int kMostRanks = 64, kTextBytes = 1 << 18;

  /// Collective over MPI_COMM_WORLD, once.
  void open();

  int rank() const { return rank_; }
  int ranks() const { return ranks_; }
  RankState& state(int rank);
  RankState& state() { return state(rank_); }

  /// Keeps a text where all ranks can read it. \return its place, for text()
  std::uint32_t keep(const std::string& text);
  std::string text(std::uint32_t place) const;

  /// Ends the job with a message: the first rank that calls it prints, and the launcher ends the others.
  [[noreturn]] void endJob(const std::string& message);

  /// Memory of a communicator, zeroed; 0: none left. One of its ranks takes it, and frees it when all have left the communicator.
  std::uint64_t take(std::size_t bytes);
  void giveBack(std::uint64_t place, std::size_t bytes);
  char* at(std::uint64_t place) const { return base_ + place; }

 private:
  struct Header;
  Header& header() const;
  char* base_ = nullptr;
  int rank_ = 0, ranks_ = 1;
  std::uint32_t textEnd_ = 0;
};

Board& board();

}  // namespace mpiorder
