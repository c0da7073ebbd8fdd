#pragma once

namespace mpiorder {

/// Starts a thread that ends the job with each rank's place once all of them have waited in MPI functions for some seconds
/// (MPI_ORDER_PATIENCE, 20) without progress: this detects what the order on one communicator cannot. Once per process.
void watch();

}  // namespace mpiorder
