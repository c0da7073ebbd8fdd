#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/report/OutputFolder.hpp>
#include <system_error>

namespace fs = std::filesystem;

namespace suture {
namespace {

// Two runs into one folder must not write into one temporary file.
std::string temporaryName(const std::string& path) { return path + ".part" + std::to_string(::getpid()); }

}  // namespace

void prepareFolder(const Comm& comm, const std::string& folder) {
  collectivelyOnRoot(comm, "preparing the output folder", [&] {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder)) {
      const std::string why = error ? error.message() : "a file of that name is in the way";
      throw EnvironmentError("the output folder '" + folder + "' cannot be made: " + why);
    }
    // Asking for permissions is not enough: a full or read-only disk shows itself only when something is written.
    const std::string probe = temporaryName((fs::path(folder) / "writable").string());
    errno = 0;
    std::ofstream file(probe);
    file << "x" << std::flush;
    const bool good = file.good();
    const std::string why = std::strerror(errno);
    file.close();
    fs::remove(probe, error);
    if (!good) throw EnvironmentError("the output folder '" + folder + "' cannot be written: " + why);
  });
}

void writeTextFile(const std::string& path, const std::string& text) {
  const std::string temporary = temporaryName(path);
  errno = 0;
  std::ofstream file(temporary, std::ios::binary);
  file << text << std::flush;
  const bool good = file.good();
  const std::string why = std::strerror(errno);
  file.close();
  std::error_code error;
  if (!good) {
    fs::remove(temporary, error);
    throw EnvironmentError("cannot write '" + path + "': " + why);
  }
  fs::rename(temporary, path, error);
  if (error) throw EnvironmentError("cannot rename '" + temporary + "' to '" + path + "': " + error.message());
}

}  // namespace suture
