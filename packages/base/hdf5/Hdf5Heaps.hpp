#pragma once
#include <cstddef>
#include <string>

namespace suture::hdf5 {

/// Checks the global heaps of a file, where HDF5 stores texts of variable length. HDF5 1.10 traverses them without checks: an object of
/// size zero makes it loop forever, an object of wrong size makes it read out of bounds. Internal to this package.
///
/// `lengthBytes`: bytes of a length in the file, according to its superblock. Reads the whole file; local.
/// \throws Failed  if the objects of a heap do not fill it exactly.
void checkHeaps(const std::string& path, std::size_t lengthBytes);

}  // namespace suture::hdf5
