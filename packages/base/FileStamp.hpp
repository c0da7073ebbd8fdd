#pragma once
#include <cstdint>
#include <optional>
#include <string>

namespace suture {

/// A file that a result depends on, as it was when the result was made.
struct FileStamp {
  std::string path;
  std::int64_t bytes = 0, modified = 0;  ///< size; time of the last change [ns since 1970]
  template <typename Self, typename Each>
  static void forEachField(Self& self, Each each) {
    each(self.path), each(self.bytes), each(self.modified);
  }
};

/// Stamp of a file as it is now; nothing if there is no such file. Local.
std::optional<FileStamp> stampOf(const std::string& path);

/// True if the file still has this stamp. Local.
bool isUnchanged(const FileStamp& stamp);

}  // namespace suture
