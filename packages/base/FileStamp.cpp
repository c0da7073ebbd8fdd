#include "FileStamp.hpp"

#include <sys/stat.h>

namespace suture {

std::optional<FileStamp> stampOf(const std::string& path) {
  struct stat found {};
  if (stat(path.c_str(), &found) != 0) return std::nullopt;
  return FileStamp{path, std::int64_t(found.st_size), std::int64_t(found.st_mtim.tv_sec) * 1000000000 + found.st_mtim.tv_nsec};
}

bool isUnchanged(const FileStamp& stamp) {
  const std::optional<FileStamp> now = stampOf(stamp.path);
  return now && now->bytes == stamp.bytes && now->modified == stamp.modified;
}

}  // namespace suture
