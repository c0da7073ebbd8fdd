#pragma once
#include <cstdint>
#include <map>
#include <string>

#include <suture/base/Errors.hpp>

namespace suture::hdf5 {

/// The file being written, for a rank that writes its numbers without HDF5, at the offsets that rank 0 gives it. Internal to this package.
struct RawFile {
  std::string path;     ///< as given by the user
  int descriptor = -1;  ///< the temporary file, open on every rank
  bool checksums = false;
  std::map<std::string, std::uint64_t> sums;  ///< dataset -> sum of the checksums of this rank's values
  unsigned long long owed = 0;                ///< rows of this rank that were announced and not yet given

  EnvironmentError cannotWrite(const std::string& at, const std::string& reason) const {
    return EnvironmentError(path + ": cannot write '" + at + "': " + reason);
  }
};

}  // namespace suture::hdf5
