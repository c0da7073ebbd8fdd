#include "Order.hpp"

#include "Board.hpp"
#include "Place.hpp"

#include <unistd.h>

#include <string>
#include <unordered_map>

namespace mpiorder {

namespace {

constexpr int kKept = 64;  // collectives of each rank that the others can still look up

/// In the shared memory of a communicator: the progress of each rank, then the last collectives of each.
struct Shared {
  std::atomic<int> left;
  std::atomic<std::uint64_t> last[Board::kMostRanks];
  Entry entries[1];  // ranks x kKept
};

std::size_t bytesFor(int ranks) { return sizeof(Shared) + std::size_t(ranks) * kKept * sizeof(Entry); }

/// A communicator on this rank.
struct Followed {
  std::uint64_t place = 0;
  int rank = 0, ranks = 1;
  std::uint64_t number = 0;

  Shared& shared() const { return *reinterpret_cast<Shared*>(board().at(place)); }
  Entry& entry(int of, std::uint64_t at) const { return shared().entries[std::size_t(of) * kKept + at % kKept]; }
};

std::unordered_map<MPI_Comm, Followed>& followed() {
  static auto& all = *new std::unordered_map<MPI_Comm, Followed>;
  return all;
}

/// Handles of operations are addresses, which differ between processes.
int numberOf(MPI_Op operation) {
  const MPI_Op known[] = {MPI_SUM, MPI_MAX, MPI_MIN,  MPI_PROD, MPI_LAND,   MPI_BAND,
                          MPI_LOR, MPI_BOR, MPI_LXOR, MPI_BXOR, MPI_MAXLOC, MPI_MINLOC};
  for (int k = 0; k < 12; ++k)
    if (operation == known[k]) return k + 1;
  return 0;
}

const char* nameOfOperation(int number) {
  static const char* const names[] = {"", "SUM", "MAX", "MIN", "PROD", "LAND", "BAND", "LOR", "BOR", "LXOR", "BXOR", "MAXLOC", "MINLOC"};
  return names[number];
}

std::string described(const Entry& entry) {
  std::string text = nameOf(static_cast<Function>(entry.functionIndex));
  if (entry.bytes > 0) text += ", " + std::to_string(entry.bytes) + " bytes";
  if (entry.root >= 0) text += ", root " + std::to_string(entry.root);
  if (entry.operation > 0) text += std::string(", ") + nameOfOperation(entry.operation);
  return text + ", called by\n        " + board().text(entry.placeText);
}

bool agree(const Entry& a, const Entry& b) {
  return a.functionIndex == b.functionIndex && a.bytes == b.bytes && a.root == b.root && a.operation == b.operation && a.place == b.place;
}

[[noreturn]] void end(const Followed& comm, int other) {
  board().endJob("two ranks of a communicator of " + std::to_string(comm.ranks) + " differ in their collective number " +
                 std::to_string(comm.number) + ":\n  rank " + std::to_string(comm.rank) + ": " +
                 described(comm.entry(comm.rank, comm.number)) + "\n  rank " + std::to_string(other) + ": " +
                 described(comm.entry(other, comm.number)) + "\n");
}

}  // namespace

void follow(MPI_Comm comm) {
  int inter = 0;
  if (comm == MPI_COMM_NULL) return;
  PMPI_Comm_test_inter(comm, &inter);
  if (inter) return;
  Followed own;
  PMPI_Comm_rank(comm, &own.rank);
  PMPI_Comm_size(comm, &own.ranks);
  if (own.ranks == 1) return;
  if (own.rank == 0) own.place = board().take(bytesFor(own.ranks));
  PMPI_Bcast(&own.place, 1, MPI_UINT64_T, 0, comm);
  if (own.place == 0) board().endJob("no shared memory left for another communicator\n");
  followed()[comm] = own;
}

void collective(MPI_Comm comm, Function function, std::size_t bytes, int root, MPI_Op operation) {
  const auto found = followed().find(comm);
  if (found == followed().end()) return;
  Followed& own = found->second;
  const std::uint64_t number = ++own.number;
  Shared& shared = own.shared();
  // The slowest rank must have compared the entry that is overwritten now.
  for (int other = 0; other < own.ranks; ++other)
    while (number > kKept && shared.last[other].load() + kKept < number) usleep(100);
  const Place place = placeOfCall();
  board().state().placeText = place.text;
  Entry& entry = own.entry(own.rank, number);
  entry.functionIndex = static_cast<int>(function);
  entry.bytes = bytes;
  entry.root = root;
  entry.operation = numberOf(operation);
  entry.place = place.hash;
  entry.placeText = place.text;
  entry.number.store(number);  // sequentially consistent: of two ranks that come at once, one sees the other
  for (int other = 0; other < own.ranks; ++other)
    if (other != own.rank && own.entry(other, number).number.load() == number && !agree(entry, own.entry(other, number))) end(own, other);
  shared.last[own.rank].store(number);
}

void leave(MPI_Comm comm) {
  const auto found = followed().find(comm);
  if (found == followed().end()) return;
  const Followed own = found->second;
  followed().erase(found);
  if (++own.shared().left == own.ranks) board().giveBack(own.place, bytesFor(own.ranks));
}

Inside::Inside(Function function) {
  RankState& state = board().state();
  outermost_ = state.functionIndex.load() < 0;
  if (!outermost_) return;
  state.functionIndex = static_cast<int>(function);
  ++state.steps;
}

Inside::~Inside() {
  if (!outermost_) return;
  board().state().functionIndex = -1;
  ++board().state().steps;
}

}  // namespace mpiorder
