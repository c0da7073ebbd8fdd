#include "Hdf5Library.hpp"

#include <hdf5.h>

namespace suture::hdf5 {

void withoutExitHandler() { H5dont_atexit(); }

std::string libraryVersion() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(release);
}

}  // namespace suture::hdf5
