// Records the environment at MPI_Init and afterwards (mpi_start.py); preloaded (LD_PRELOAD).
//   SUTURE_TEST_PROBE=FILE   one line "init|after pml=VALUE isolated=VALUE" for each, from rank 0; - for an unset variable
#include <mpi.h>

#include <cstdlib>
#include <fstream>

namespace {

void write(const char* when) {
  const char* path = std::getenv("SUTURE_TEST_PROBE");
  int rank = 0, hasBegun = 0;
  PMPI_Initialized(&hasBegun);
  if (hasBegun) PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  const char* launched = std::getenv("OMPI_COMM_WORLD_RANK");
  if (!path || rank != 0 || (launched && launched[0] != '0')) return;
  const auto value = [](const char* name) {
    const char* set = std::getenv(name);
    return set ? set : "-";
  };
  std::ofstream(path, std::ios::app) << when << " pml=" << value("OMPI_MCA_pml") << " isolated=" << value("OMPI_MCA_ess_singleton_isolated")
                                     << " folders=" << value("OMPI_MCA_orte_create_session_dirs") << '\n';
}

}  // namespace

extern "C" {
int MPI_Init(int* argc, char*** argv) {
  write("init");
  return PMPI_Init(argc, argv);
}
int MPI_Init_thread(int* argc, char*** argv, int required, int* provided) {
  write("init");
  return PMPI_Init_thread(argc, argv, required, provided);
}
int MPI_Finalize() {
  write("after");
  return PMPI_Finalize();
}
}
