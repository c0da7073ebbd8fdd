#pragma once
#include <cstddef>
#include <string>

namespace suture {

/// Memory still available on this machine, in 2^20 bytes: MemAvailable of Linux, or what the limits of the control group leave if that is
/// less; infinite if unknown. Local.
double availableMegabytes();

/// Address space that this process may still allocate under its limit (ulimit -v), in 2^20 bytes; infinite without a limit. Local.
double addressSpaceLeft();

/// Refuses work that needs more memory than is available, before allocating any. Local.
/// \param what  begins the message: "the mesh of Mesh/Boxes with 10 elements"
/// \throws EnvironmentError  names the memory needed and the memory available
void mustFit(double megabytes, const std::string& what);

/// "1.25 GB". Local.
std::string gigabytes(double megabytes);

}  // namespace suture
