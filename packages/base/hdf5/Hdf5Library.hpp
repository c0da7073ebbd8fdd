#pragma once
#include <string>

namespace suture::hdf5 {

/// Disables HDF5's cleanup at program exit, which crashes if a file could not be closed because the disk was full. For programs, before any
/// other HDF5 call. Local.
void withoutExitHandler();

/// Version of the linked HDF5 library: "1.10.8". Local.
std::string libraryVersion();

}  // namespace suture::hdf5
