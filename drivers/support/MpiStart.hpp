#pragma once
#include <string>
#include <vector>

namespace suture {

/// Speeds up the start of Open MPI in a process without a launcher. Create it before MPI_Init and destroy it afterwards. By default such a
/// process waits .3 s: Open MPI opens the transports of all networks (pml), and starts a daemon (orted) that is needed only by
/// MPI_Comm_spawn and MPI_Comm_connect, which Suture does not call. The settings are environment variables; the destructor removes them,
/// so child processes do not inherit them.
/// User settings take precedence, from the environment or from the parameter file of Open MPI in the home folder.
/// Nothing is set below mpirun, although pml=ob1 would save .15 s there: between nodes, ob1 excludes the transports of fast networks, and
/// on one node all programs of an mpirun must choose the same pml, which this process cannot ensure.
class MpiStart {
 public:
  MpiStart();
  ~MpiStart();
  MpiStart(const MpiStart&) = delete;
  MpiStart& operator=(const MpiStart&) = delete;

 private:
  /// False if the user has set it.
  bool set(const std::string& name, const char* value);

  std::vector<std::string> set_;  // variables that were not set before
};

/// Rank assigned by a launcher (mpirun, srun), available before MPI starts; null without a launcher.
const char* launchedRank();

/// True if an MPI launcher started this process. Unlike launchedRank(), not for the script of a Slurm job, which has a rank but may call
/// mpirun.
bool launchedByMpi();

}  // namespace suture
