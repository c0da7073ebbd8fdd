#pragma once
#include <mpi.h>
#include <suture/base/Types.hpp>

namespace suture {

/// The MPI communicator inside a Teuchos one; MPI_COMM_SELF if there is none inside (Teuchos::SerialComm). Local. Only for sources that
/// call MPI or a library that takes an MPI communicator.
MPI_Comm mpiComm(const Comm& comm);

}  // namespace suture
