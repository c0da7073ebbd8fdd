#pragma once
#include <string>
#include <vector>

namespace suture {

/// Makes Open MPI start faster in a process that no launcher started; create it before MPI_Init, and destroy it after. By default such a
/// process waits .3 s: Open MPI opens the transports of all networks (pml), and starts a daemon (orted) that only MPI_Comm_spawn and
/// MPI_Comm_connect need, which Suture does not call. The settings are made in the environment and taken back by the destructor: programs
/// that this one starts do not inherit them.
/// A setting of the user wins: one in the environment, or in the parameter file of Open MPI in the home folder.
/// Below mpirun nothing is set, although pml=ob1 saves .15 s there, too: between nodes ob1 excludes the transports that a fast network has,
/// and on one node all programs of an mpirun must choose the same pml, of which this one sees only itself.
class MpiStart {
 public:
  MpiStart();
  ~MpiStart();
  MpiStart(const MpiStart&) = delete;
  MpiStart& operator=(const MpiStart&) = delete;

 private:
  std::vector<std::string> set_;  // names of variables that were not there
};

/// Rank that a launcher (mpirun, srun) gave this process, also before MPI begins; null without one.
const char* launchedRank();

}  // namespace suture
