// Programs whose ranks do not call the same collectives, and one whose ranks do: test cases for the order of collectives. See planted.py.
#include <mpi.h>

#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <vector>

// Not inlined: the messages name them.
#define FUNCTION extern "C" __attribute__((noinline)) void

namespace {
int rank = 0, ranks = 1;
}

FUNCTION sumOf(int count, MPI_Comm comm) {
  std::vector<double> values(std::size_t(count), 1.0);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), count, MPI_DOUBLE, MPI_SUM, comm);
}

FUNCTION fromRoot(int root) {
  double value = 0.0;
  MPI_Bcast(&value, 1, MPI_DOUBLE, root, MPI_COMM_WORLD);
}

FUNCTION oneWay() { sumOf(1, MPI_COMM_WORLD); }
FUNCTION otherWay() { sumOf(1, MPI_COMM_WORLD); }

FUNCTION waitFor(int from) {
  double value = 0.0;
  MPI_Recv(&value, 1, MPI_DOUBLE, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
}

FUNCTION meet(MPI_Comm comm) { MPI_Barrier(comm); }

namespace {

/// Root far ahead of the others, groups of ranks, communicators of one rank, point-to-point messages: all of it is correct.
void sound() {
  for (int i = 0; i < 1000; ++i) fromRoot(0);
  for (int i = 0; i < 200; ++i) {
    MPI_Comm half = MPI_COMM_NULL, copy = MPI_COMM_NULL;
    MPI_Comm_split(MPI_COMM_WORLD, rank % 2, rank, &half);
    MPI_Comm_dup(half, &copy);
    for (int k = 0; k < 1 + rank % 2; ++k) sumOf(1 + rank % 2, copy);
    MPI_Comm_free(&copy);
    MPI_Comm_free(&half);
  }
  if (rank == 0) sumOf(3, MPI_COMM_SELF);
  double value = 0.0;
  if (rank == 1) MPI_Send(&value, 1, MPI_DOUBLE, 0, 0, MPI_COMM_WORLD);
  if (rank == 0) waitFor(1);
  if (rank == 0) usleep(1500000);  // the others wait for one that works: longer than the patience of the tests
  MPI_Request request;
  MPI_Ibarrier(MPI_COMM_WORLD, &request);
  MPI_Wait(&request, MPI_STATUS_IGNORE);
}

bool play(const char* name) {
  const auto is = [&](const char* other) { return std::strcmp(name, other) == 0; };
  const bool last = rank == ranks - 1;
  MPI_Comm copy = MPI_COMM_NULL;
  MPI_Comm_dup(MPI_COMM_WORLD, &copy);
  oneWay();
  if (is("sound"))
    sound();
  else if (is("function"))
    last ? fromRoot(0) : sumOf(1, MPI_COMM_WORLD);
  else if (is("size"))
    sumOf(last ? 2 : 1, MPI_COMM_WORLD);
  else if (is("root"))
    fromRoot(last ? 1 : 0);
  else if (is("place"))
    last ? otherWay() : oneWay();
  else if (is("message"))  // one waits for a message that nobody sends
    last ? waitFor(0) : sumOf(1, MPI_COMM_WORLD);
  else if (is("communicators"))
    meet(last ? copy : MPI_COMM_WORLD);
  else
    return false;
  MPI_Comm_free(&copy);
  return true;
}

}  // namespace

int main(int argc, char* argv[]) {
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const bool known = argc == 2 && play(argv[1]);
  MPI_Finalize();
  if (!known) std::fputs("no such case\n", stderr);
  return known ? 0 : 2;
}
