#pragma once

// The MPI functions that this library intercepts: collectives, and others in which a rank may wait.
// clang-format off
#define MPI_ORDER_FUNCTIONS(X) \
  X(Allreduce) X(Reduce) X(Bcast) X(Barrier) X(Allgather) X(Allgatherv) X(Gather) X(Gatherv) X(Scatter) X(Scatterv) X(Alltoall) \
  X(Alltoallv) X(Reduce_scatter) X(Reduce_scatter_block) X(Scan) X(Exscan) X(Iallreduce) X(Ireduce) X(Ibcast) X(Ibarrier) \
  X(Iallgather) X(Iallgatherv) X(Igather) X(Igatherv) X(Iscatter) X(Iscatterv) X(Ialltoall) X(Ialltoallv) X(Ireduce_scatter) \
  X(Ireduce_scatter_block) X(Iscan) X(Iexscan) X(Comm_dup) X(Comm_dup_with_info) X(Comm_split) X(Comm_split_type) X(Comm_create) \
  X(Send) X(Ssend) X(Rsend) X(Recv) X(Sendrecv) X(Probe) X(Wait) X(Waitall) X(Waitany) X(Waitsome) X(Comm_free) X(Finalize)
// clang-format on

namespace mpiorder {

enum class Function : int {
#define MPI_ORDER_NAME(name) name,
  MPI_ORDER_FUNCTIONS(MPI_ORDER_NAME)
#undef MPI_ORDER_NAME
};

inline const char* nameOf(Function function) {
  static const char* const names[] = {
#define MPI_ORDER_NAME(name) "MPI_" #name,
      MPI_ORDER_FUNCTIONS(MPI_ORDER_NAME)
#undef MPI_ORDER_NAME
  };
  return names[static_cast<int>(function)];
}

}  // namespace mpiorder
