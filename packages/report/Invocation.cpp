#include <suture/base/Errors.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/Invocation.hpp>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace suture {

std::string bytesOfFile(const std::string& path, const std::string& expected) {
  std::error_code ignored;
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    throw InputError(path, "is not a regular file; expected " + expected);
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  if (file) bytes << file.rdbuf();
  if (!file) throw InputError(path, std::string("cannot be read: ") + std::strerror(errno != 0 ? errno : ENOENT));
  return bytes.str();
}

std::string absolutePath(const std::string& path) {
  std::error_code error;
  const std::filesystem::path found = std::filesystem::absolute(path, error);
  return error ? path : found.lexically_normal().string();
}

std::string hashOf(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  return format("%016llx", static_cast<unsigned long long>(hash));
}

UsedFile usedFile(const std::string& path) { return {absolutePath(path), hashOf(bytesOfFile(path, "a file"))}; }

}  // namespace suture
