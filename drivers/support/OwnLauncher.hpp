#pragma once
#include <string>

namespace suture {

/// Replaces this process by an mpirun that starts the same program, with the same arguments except `--ranks N`, on several ranks. Call it
/// before MPI starts. Uses the mpirun of the MPI library that Suture was built with, otherwise `mpirun` or `mpiexec` in PATH.
///
/// Settings of Open MPI, as environment variables that do not replace those of the user: more ranks than cores are allowed, ranks are not
/// bound to cores (two runs at the same time would share theirs), root may start it, ranks do not read each other's memory (containers
/// forbid it), and mpirun does not comment on exit codes.
/// \param ranks  if 1, nothing happens: this process is the only rank
/// \throws CommandLineError  the process was itself started by an MPI launcher. \throws EnvironmentError  no mpirun. Local.
void startOwnRanks(int ranks, int argc, char* argv[]);

}  // namespace suture
