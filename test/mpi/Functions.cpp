// MPI's functions (the profiling interface PMPI): this library is loaded before the others.
#include "Board.hpp"
#include "Order.hpp"
#include "Watch.hpp"

#include <cstdlib>

using mpiorder::collective;
using mpiorder::Function;
using mpiorder::Inside;

namespace {

bool isOn = false;

/// With one rank there is nothing to compare.
void begin() {
  unsetenv("LD_PRELOAD");  // child programs of the run do not load the library
  int ranks = 1;
  PMPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (ranks == 1) return;
  mpiorder::board().open();
  mpiorder::follow(MPI_COMM_WORLD);
  mpiorder::watch();
  isOn = true;
}

std::size_t bytesOf(int count, MPI_Datatype type) {
  int size = 0;
  PMPI_Type_size(type, &size);
  return static_cast<std::size_t>(count) * static_cast<std::size_t>(size);
}

/// Bytes per rank of a rooted function: the root may pass MPI_IN_PLACE.
std::size_t bytesAt(int root, MPI_Comm comm, int rootCount, MPI_Datatype rootType, int count, MPI_Datatype type) {
  int rank = 0;
  PMPI_Comm_rank(comm, &rank);
  return rank == root ? bytesOf(rootCount, rootType) : bytesOf(count, type);
}

}  // namespace

// A function in which a rank may wait.
#define MPI_ORDER_WAITING(name, parameters, arguments) \
  int MPI_##name parameters {                          \
    if (!isOn) return PMPI_##name arguments;           \
    const Inside inside(Function::name);               \
    return PMPI_##name arguments;                      \
  }
// A collective on `comm`; the remaining arguments are passed to collective(): bytes, root, operation.
#define MPI_ORDER_COLLECTIVE(name, parameters, arguments, ...) \
  int MPI_##name parameters {                                  \
    if (!isOn) return PMPI_##name arguments;                   \
    const Inside inside(Function::name);                       \
    collective(comm, Function::name, __VA_ARGS__);             \
    return PMPI_##name arguments;                              \
  }
// A collective on `comm` that makes another communicator.
#define MPI_ORDER_MAKING(name, parameters, arguments) \
  int MPI_##name parameters {                         \
    if (!isOn) return PMPI_##name arguments;          \
    const Inside inside(Function::name);              \
    collective(comm, Function::name);                 \
    const int code = PMPI_##name arguments;           \
    if (code == MPI_SUCCESS) mpiorder::follow(*made); \
    return code;                                      \
  }

extern "C" {

int MPI_Init(int* argc, char*** argv) {
  const int code = PMPI_Init(argc, argv);
  if (code == MPI_SUCCESS) begin();
  return code;
}

int MPI_Init_thread(int* argc, char*** argv, int wanted, int* given) {
  const int code = PMPI_Init_thread(argc, argv, wanted, given);
  if (code == MPI_SUCCESS) begin();
  return code;
}

int MPI_Finalize() {
  if (!isOn) return PMPI_Finalize();
  const Inside inside(Function::Finalize);
  collective(MPI_COMM_WORLD, Function::Finalize);
  return PMPI_Finalize();
}

int MPI_Comm_free(MPI_Comm* comm) {
  if (!isOn) return PMPI_Comm_free(comm);
  const Inside inside(Function::Comm_free);
  collective(*comm, Function::Comm_free);
  mpiorder::leave(*comm);
  return PMPI_Comm_free(comm);
}

MPI_ORDER_COLLECTIVE(Allreduce, (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm),
                     (in, out, n, type, op, comm), bytesOf(n, type), -1, op)
MPI_ORDER_COLLECTIVE(Reduce, (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm),
                     (in, out, n, type, op, root, comm), bytesOf(n, type), root, op)
MPI_ORDER_COLLECTIVE(Bcast, (void* data, int n, MPI_Datatype type, int root, MPI_Comm comm), (data, n, type, root, comm), bytesOf(n, type),
                     root)
MPI_ORDER_COLLECTIVE(Barrier, (MPI_Comm comm), (comm), 0)
MPI_ORDER_COLLECTIVE(Allgather, (const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, MPI_Comm comm),
                     (in, n, type, out, m, other, comm), bytesOf(m, other))
MPI_ORDER_COLLECTIVE(Allgatherv,
                     (const void* in, int n, MPI_Datatype type, void* out, const int counts[], const int places[], MPI_Datatype other,
                      MPI_Comm comm),
                     (in, n, type, out, counts, places, other, comm), 0)
MPI_ORDER_COLLECTIVE(Gather, (const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, int root, MPI_Comm comm),
                     (in, n, type, out, m, other, root, comm), bytesAt(root, comm, m, other, n, type), root)
MPI_ORDER_COLLECTIVE(Gatherv,
                     (const void* in, int n, MPI_Datatype type, void* out, const int counts[], const int places[], MPI_Datatype other,
                      int root, MPI_Comm comm),
                     (in, n, type, out, counts, places, other, root, comm), 0, root)
MPI_ORDER_COLLECTIVE(Scatter, (const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, int root, MPI_Comm comm),
                     (in, n, type, out, m, other, root, comm), bytesAt(root, comm, n, type, m, other), root)
MPI_ORDER_COLLECTIVE(Scatterv,
                     (const void* in, const int counts[], const int places[], MPI_Datatype type, void* out, int m, MPI_Datatype other,
                      int root, MPI_Comm comm),
                     (in, counts, places, type, out, m, other, root, comm), 0, root)
MPI_ORDER_COLLECTIVE(Alltoall, (const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, MPI_Comm comm),
                     (in, n, type, out, m, other, comm), bytesOf(m, other))
MPI_ORDER_COLLECTIVE(Alltoallv,
                     (const void* in, const int counts[], const int places[], MPI_Datatype type, void* out, const int others[],
                      const int at[], MPI_Datatype other, MPI_Comm comm),
                     (in, counts, places, type, out, others, at, other, comm), 0)
MPI_ORDER_COLLECTIVE(Reduce_scatter, (const void* in, void* out, const int counts[], MPI_Datatype type, MPI_Op op, MPI_Comm comm),
                     (in, out, counts, type, op, comm), 0, -1, op)
MPI_ORDER_COLLECTIVE(Reduce_scatter_block, (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm),
                     (in, out, n, type, op, comm), bytesOf(n, type), -1, op)
MPI_ORDER_COLLECTIVE(Scan, (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm), (in, out, n, type, op, comm),
                     bytesOf(n, type), -1, op)
MPI_ORDER_COLLECTIVE(Exscan, (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm), (in, out, n, type, op, comm),
                     bytesOf(n, type), -1, op)
MPI_ORDER_COLLECTIVE(Iallreduce, (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm, MPI_Request* request),
                     (in, out, n, type, op, comm, request), bytesOf(n, type), -1, op)
MPI_ORDER_COLLECTIVE(Ireduce,
                     (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, int root, MPI_Comm comm, MPI_Request* request),
                     (in, out, n, type, op, root, comm, request), bytesOf(n, type), root, op)
MPI_ORDER_COLLECTIVE(Ibcast, (void* data, int n, MPI_Datatype type, int root, MPI_Comm comm, MPI_Request* request),
                     (data, n, type, root, comm, request), bytesOf(n, type), root)
MPI_ORDER_COLLECTIVE(Ibarrier, (MPI_Comm comm, MPI_Request* request), (comm, request), 0)
MPI_ORDER_COLLECTIVE(Iallgather,
                     (const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, MPI_Comm comm, MPI_Request* request),
                     (in, n, type, out, m, other, comm, request), bytesOf(m, other))
MPI_ORDER_COLLECTIVE(Iallgatherv,
                     (const void* in, int n, MPI_Datatype type, void* out, const int counts[], const int places[], MPI_Datatype other,
                      MPI_Comm comm, MPI_Request* request),
                     (in, n, type, out, counts, places, other, comm, request), 0)
MPI_ORDER_COLLECTIVE(Igather,
                     (const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, int root, MPI_Comm comm,
                      MPI_Request* request),
                     (in, n, type, out, m, other, root, comm, request), bytesAt(root, comm, m, other, n, type), root)
MPI_ORDER_COLLECTIVE(Igatherv,
                     (const void* in, int n, MPI_Datatype type, void* out, const int counts[], const int places[], MPI_Datatype other,
                      int root, MPI_Comm comm, MPI_Request* request),
                     (in, n, type, out, counts, places, other, root, comm, request), 0, root)
MPI_ORDER_COLLECTIVE(Iscatter,
                     (const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, int root, MPI_Comm comm,
                      MPI_Request* request),
                     (in, n, type, out, m, other, root, comm, request), bytesAt(root, comm, n, type, m, other), root)
MPI_ORDER_COLLECTIVE(Iscatterv,
                     (const void* in, const int counts[], const int places[], MPI_Datatype type, void* out, int m, MPI_Datatype other,
                      int root, MPI_Comm comm, MPI_Request* request),
                     (in, counts, places, type, out, m, other, root, comm, request), 0, root)
MPI_ORDER_COLLECTIVE(Ialltoall,
                     (const void* in, int n, MPI_Datatype type, void* out, int m, MPI_Datatype other, MPI_Comm comm, MPI_Request* request),
                     (in, n, type, out, m, other, comm, request), bytesOf(m, other))
MPI_ORDER_COLLECTIVE(Ialltoallv,
                     (const void* in, const int counts[], const int places[], MPI_Datatype type, void* out, const int others[],
                      const int at[], MPI_Datatype other, MPI_Comm comm, MPI_Request* request),
                     (in, counts, places, type, out, others, at, other, comm, request), 0)
MPI_ORDER_COLLECTIVE(Ireduce_scatter,
                     (const void* in, void* out, const int counts[], MPI_Datatype type, MPI_Op op, MPI_Comm comm, MPI_Request* request),
                     (in, out, counts, type, op, comm, request), 0, -1, op)
MPI_ORDER_COLLECTIVE(Ireduce_scatter_block,
                     (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm, MPI_Request* request),
                     (in, out, n, type, op, comm, request), bytesOf(n, type), -1, op)
MPI_ORDER_COLLECTIVE(Iscan, (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm, MPI_Request* request),
                     (in, out, n, type, op, comm, request), bytesOf(n, type), -1, op)
MPI_ORDER_COLLECTIVE(Iexscan, (const void* in, void* out, int n, MPI_Datatype type, MPI_Op op, MPI_Comm comm, MPI_Request* request),
                     (in, out, n, type, op, comm, request), bytesOf(n, type), -1, op)

MPI_ORDER_MAKING(Comm_dup, (MPI_Comm comm, MPI_Comm* made), (comm, made))
MPI_ORDER_MAKING(Comm_dup_with_info, (MPI_Comm comm, MPI_Info info, MPI_Comm* made), (comm, info, made))
MPI_ORDER_MAKING(Comm_split, (MPI_Comm comm, int colour, int key, MPI_Comm* made), (comm, colour, key, made))
MPI_ORDER_MAKING(Comm_split_type, (MPI_Comm comm, int kind, int key, MPI_Info info, MPI_Comm* made), (comm, kind, key, info, made))
MPI_ORDER_MAKING(Comm_create, (MPI_Comm comm, MPI_Group group, MPI_Comm* made), (comm, group, made))

MPI_ORDER_WAITING(Send, (const void* data, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm), (data, n, type, to, tag, comm))
MPI_ORDER_WAITING(Ssend, (const void* data, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm), (data, n, type, to, tag, comm))
MPI_ORDER_WAITING(Rsend, (const void* data, int n, MPI_Datatype type, int to, int tag, MPI_Comm comm), (data, n, type, to, tag, comm))
MPI_ORDER_WAITING(Recv, (void* data, int n, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status),
                  (data, n, type, from, tag, comm, status))
MPI_ORDER_WAITING(Sendrecv,
                  (const void* in, int n, MPI_Datatype type, int to, int tag, void* out, int m, MPI_Datatype other, int from, int theirs,
                   MPI_Comm comm, MPI_Status* status),
                  (in, n, type, to, tag, out, m, other, from, theirs, comm, status))
MPI_ORDER_WAITING(Probe, (int from, int tag, MPI_Comm comm, MPI_Status* status), (from, tag, comm, status))
MPI_ORDER_WAITING(Wait, (MPI_Request * request, MPI_Status* status), (request, status))
MPI_ORDER_WAITING(Waitall, (int n, MPI_Request requests[], MPI_Status statuses[]), (n, requests, statuses))
MPI_ORDER_WAITING(Waitany, (int n, MPI_Request requests[], int* which, MPI_Status* status), (n, requests, which, status))
MPI_ORDER_WAITING(Waitsome, (int n, MPI_Request requests[], int* done, int which[], MPI_Status statuses[]),
                  (n, requests, done, which, statuses))
}
