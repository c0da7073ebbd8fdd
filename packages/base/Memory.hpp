#pragma once
#include <cstddef>
#include <string>

namespace suture {

/// Memory that this machine could still give to programs, in 2^20 bytes: MemAvailable of Linux, or the rest below the limits of
/// the control group if that is less; infinite where the system does not tell. Local.
double availableMegabytes();

/// Address space that this process may still take, in 2^20 bytes, under its limit (ulimit -v); infinite without one. Local.
double addressSpaceLeft();

/// Refuses work that needs more memory than there is, before any of it is taken. Local.
/// \param what  begins the message: "the mesh of Mesh/Boxes with 10 elements"
/// \throws EnvironmentError  names the memory needed and the memory there is
void mustFit(double megabytes, const std::string& what);

/// "1.25 GB". Local.
std::string gigabytes(double megabytes);

}  // namespace suture
