#pragma once
#include <mpi.h>
#include <suture/base/Types.hpp>

namespace suture {

/// The MPI communicator inside a Teuchos one; that of this process alone when there is no MPI inside (Teuchos::SerialComm). Local.
/// Only for sources that call MPI or a library that wants a communicator.
MPI_Comm mpiComm(const Comm& comm);

}  // namespace suture
