#pragma once
#include "Fuzz.hpp"

#include <mpi.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <suture/base/Types.hpp>

namespace fuzz {

/// One process alone: MPI starts here, since HDF5 needs it.
inline void beginAlone() {
  int begun = 0;
  MPI_Initialized(&begun);
  if (begun) return;
  MPI_Init(nullptr, nullptr);
  std::atexit([] { MPI_Finalize(); });
}

inline const suture::Comm& alone() {
  static const Teuchos::MpiComm<int> comm(MPI_COMM_SELF);
  return comm;
}

}  // namespace fuzz
