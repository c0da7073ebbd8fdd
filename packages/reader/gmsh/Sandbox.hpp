#pragma once
#include <cstddef>

namespace suture {

/// Limits of this process and its children: so many bytes of address space, so many seconds of processor time, no core file, and the
/// end with its parent's.
void limitThisProcess(std::size_t bytes, double seconds);

/// Takes from this process, for good, the right to start programs, to write, make, rename or remove files, to open sockets and to signal
/// other processes: the system answers such calls with "operation not permitted". \return false where the system cannot do so
bool forbidProgramsAndFiles();

}  // namespace suture
