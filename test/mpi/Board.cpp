#include "Board.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace mpiorder {

namespace {

constexpr std::size_t kBytes = std::size_t(1) << 26, kFreeLists = 64;

[[noreturn]] void fail(const char* what) {
  std::fprintf(stderr, "mpi order: %s\n", what);
  _exit(kExitCode);
}

}  // namespace

struct Board::Header {
  struct Free {
    std::uint64_t bytes, first;  // each free piece begins with the offset of the next one
  };
  RankState states[kMostRanks];
  std::atomic_flag lock, ended;
  std::uint64_t end;
  Free free[kFreeLists];  // pieces of one size
};

Board& board() {
  static auto* const one = new Board;  // lives until the process ends: other threads read it
  return *one;
}

Board::Header& Board::header() const { return *reinterpret_cast<Header*>(base_); }
RankState& Board::state(int rank) { return header().states[rank]; }

void Board::open() {
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  PMPI_Comm_size(MPI_COMM_WORLD, &ranks_);
  if (ranks_ > kMostRanks) fail("more ranks than this library knows");
  char name[64] = "";  // anonymous memory, which the other ranks open through rank 0's descriptor: no file is left however a job ends
  int file = -1;
  if (rank_ == 0) {
    file = memfd_create("suture_mpi_order", 0);
    if (file < 0 || ftruncate(file, kBytes) != 0) fail("no shared memory");
    std::snprintf(name, sizeof(name), "/proc/%d/fd/%d", static_cast<int>(getpid()), file);
  }
  PMPI_Bcast(name, sizeof(name), MPI_CHAR, 0, MPI_COMM_WORLD);
  if (rank_ != 0) file = ::open(name, O_RDWR);
  if (file < 0) fail("the ranks are not on one machine");
  void* memory = mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  if (memory == MAP_FAILED) fail("no shared memory");
  base_ = static_cast<char*>(memory);
  if (rank_ == 0) {
    for (int r = 0; r < ranks_; ++r) header().states[r].functionIndex = -1;
    header().end = (sizeof(Header) + 63) / 64 * 64 + std::uint64_t(ranks_) * kTextBytes;
  }
  PMPI_Barrier(MPI_COMM_WORLD);
  close(file);
}

std::uint32_t Board::keep(const std::string& text) {
  const std::uint32_t length = std::min<std::uint32_t>(static_cast<std::uint32_t>(text.size()) + 1, 4000);
  if (textEnd_ + length > kTextBytes) return 0;
  const auto place = static_cast<std::uint32_t>((sizeof(Header) + 63) / 64 * 64 + std::size_t(rank_) * kTextBytes + textEnd_);
  std::memcpy(base_ + place, text.data(), length - 1);
  textEnd_ += length;  // the byte behind is zero
  return place;
}

std::string Board::text(std::uint32_t place) const { return place == 0 ? "?" : base_ + place; }

void Board::endJob(const std::string& message) {
  if (header().ended.test_and_set()) {
    sleep(10);  // two messages at once confuse the launcher and the reader
    _exit(kExitCode);
  }
  std::fputs(("mpi order: " + message).c_str(), stderr);
  std::fflush(stderr);
  _exit(kExitCode);
}

std::uint64_t Board::take(std::size_t bytes) {
  bytes = (bytes + 63) / 64 * 64;
  Header& own = header();
  while (own.lock.test_and_set()) usleep(1);
  std::uint64_t place = 0;
  for (Header::Free& list : own.free)
    if (list.bytes == bytes && list.first != 0) {
      place = list.first;
      std::memcpy(&list.first, base_ + place, sizeof(list.first));
      break;
    }
  if (place == 0 && own.end + bytes <= kBytes) place = own.end, own.end += bytes;
  own.lock.clear();
  if (place != 0) std::memset(base_ + place, 0, bytes);
  return place;
}

void Board::giveBack(std::uint64_t place, std::size_t bytes) {
  bytes = (bytes + 63) / 64 * 64;
  Header& own = header();
  while (own.lock.test_and_set()) usleep(1);
  for (Header::Free& list : own.free)
    if (list.bytes == bytes || list.bytes == 0) {
      list.bytes = bytes;
      std::memcpy(base_ + place, &list.first, sizeof(list.first));
      list.first = place;
      break;
    }
  own.lock.clear();
}

}  // namespace mpiorder
