#pragma once
#include <cstddef>

namespace suture {

/// Limits address space and processor time of this process and its children, disables core files, and makes the process die with its
/// parent.
void limitThisProcess(std::size_t bytes, double seconds);

/// Permanently removes the right of this process to start programs, to write, make, rename or remove files, to open sockets and to signal
/// other processes: such system calls fail with "operation not permitted". \return false if the system does not support this
bool forbidProgramsAndFiles();

}  // namespace suture
