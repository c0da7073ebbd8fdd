#pragma once
#include <string>

namespace suture {

/// `suture_solve --watch DIR`: shows the outer iterations of the run that writes into a folder, as soon as they are known, until the run
/// ends, and how it ended. The run may be in progress, about to start, or over. Only reads files; does not need MPI. On a terminal, a last
/// line counts the seconds since the last iteration.
///
/// \return the exit code of the run; 4 if it ended without results; 3 if no run uses the folder; 5 if standard output cannot be written
int watch(const std::string& folder);

}  // namespace suture
