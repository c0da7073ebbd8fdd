#pragma once
#include <stdlib.h>

#include <filesystem>
#include <string>

namespace suture::blocks {

/// Makes a new folder `<in>/<beginning><six letters>`. \return its path; empty if it cannot be made, with the reason in errno. Local.
inline std::string makeTemporaryFolder(const std::filesystem::path& in, const std::string& beginning) {
  std::string name = (in / (beginning + std::string(6, 'X'))).string();  // mkdtemp replaces the X
  return mkdtemp(name.data()) ? name : "";
}

}  // namespace suture::blocks
