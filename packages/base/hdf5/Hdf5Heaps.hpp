#pragma once
#include <cstddef>
#include <string>

namespace suture::hdf5 {

/// Checks the global heaps of a file, where HDF5 keeps texts of variable length. HDF5 1.10 walks through them without looking: an object
/// without a size makes it walk for ever, one with a wrong size takes it out of its memory. Inside this package only.
///
/// `lengthBytes`: bytes of a length in the file, as its superblock says. Reads the whole file; local.
/// \throws Failed  if the objects of a heap do not fill it exactly.
void checkHeaps(const std::string& path, std::size_t lengthBytes);

}  // namespace suture::hdf5
