#pragma once
#include "Names.hpp"

#include <mpi.h>

#include <cstddef>

namespace mpiorder {

/// The order of the collectives on a communicator. Each rank records each of its collectives before it begins: function, size, root,
/// operation and calling place. A rank that comes later compares its record with those of the others at the same number, and ends the job
/// with both places if they differ. No messages: the ranks wait for each other as they do without this library.

/// From now on the order on `comm` is checked, unless it has one rank. Collective over it.
void follow(MPI_Comm comm);

/// A collective of this rank begins. \param bytes  that all ranks must agree on, 0: none; \param root  -1: none
void collective(MPI_Comm comm, Function function, std::size_t bytes = 0, int root = -1, MPI_Op operation = MPI_OP_NULL);

/// The last collective on `comm`: MPI_Comm_free.
void leave(MPI_Comm comm);

/// Marks that this rank is in a function in which it may wait for others, as long as the object lives.
class Inside {
 public:
  explicit Inside(Function function);
  ~Inside();
  Inside(const Inside&) = delete;

 private:
  bool outermost_;
};

}  // namespace mpiorder
