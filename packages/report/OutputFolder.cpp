#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/report/History.hpp>
#include <suture/report/OutputFolder.hpp>
#include <system_error>
#include <vector>

namespace fs = std::filesystem;

namespace suture {
namespace {

// Unique per process, so that two runs into one folder never write the same temporary file.
std::string temporaryName(const std::string& path) { return path + ".part" + std::to_string(::getpid()); }

/// True for the temporary name of a file that runs write directly into their folder; other results are staged in a separate folder.
bool isTemporary(const std::string& name) {
  const std::size_t end = name.rfind(".part");
  if (end == std::string::npos || name.find_first_not_of("0123456789", end + 5) != std::string::npos) return false;
  const std::string own = name.substr(0, end);
  return own == "checkpoint.h5" || own == "summary.json" || own == "history.csv" || own == "writable";
}

/// Removes temporary files of killed runs. Requires the folder's lock, such that no other run is active.
void removeTemporaries(const std::string& folder) {
  std::error_code ignored;
  std::vector<fs::path> left;
  for (fs::directory_iterator file(folder, ignored), none; file != none; file.increment(ignored))
    if (isTemporary(file->path().filename().string()) && file->is_regular_file(ignored)) left.push_back(file->path());
  for (const fs::path& path : left) fs::remove(path, ignored);
}

}  // namespace

void prepareFolder(const Comm& comm, const std::string& folder) {
  collectivelyOnRoot(comm, "preparing the output folder", [&] {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error || !fs::is_directory(folder)) {
      const std::string why = error ? error.message() : "a file with this name exists";
      throw EnvironmentError("the output folder '" + folder + "' cannot be created: " + why);
    }
    // Checking permissions is not enough: a full or read-only disk fails only when something is written.
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

FolderLock::FolderLock(const Comm& comm, const std::string& folder) : path_((fs::path(folder) / ".suture.lock").string()) {
  collectivelyOnRoot(comm, "locking the output folder", [&] {
    for (bool mine = false; !mine;) {
      const int file = ::open(path_.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
      if (file < 0) throw EnvironmentError("the output folder '" + folder + "' cannot be locked: " + std::strerror(errno));
      if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
        const int why = errno;
        char owner[200] = "";
        const ssize_t length = ::pread(file, owner, sizeof owner - 1, 0);
        ::close(file);
        if (why != EWOULDBLOCK) return;  // the file system has no locks
        throw EnvironmentError("another run is writing into the output folder '" + folder + "'" +
                               (length > 0 ? " (" + std::string(owner, static_cast<std::size_t>(length)) + ")" : "") +
                               "; wait until it ends, or choose another folder with --output");
      }
      // The previous run may have removed the file after it was opened and before it was locked here.
      struct stat locked {
      }, there{};
      mine = ::fstat(file, &locked) == 0 && ::stat(path_.c_str(), &there) == 0 && locked.st_ino == there.st_ino;
      if (!mine) {
        ::close(file);
        continue;
      }
      char host[100] = "";
      ::gethostname(host, sizeof host - 1);
      const std::string owner = "process " + std::to_string(::getpid()) + " on " + host;
      if (::ftruncate(file, 0) != 0 || ::pwrite(file, owner.data(), owner.size(), 0) < 0) {  // only for messages
      }
      file_ = file;
    }
  });
}

FolderLock::~FolderLock() {
  if (file_ < 0) return;
  ::unlink(path_.c_str());
  ::close(file_);
}

RunFolder::RunFolder(const Comm& comm, const std::string& folder) : lock_((prepareFolder(comm, folder), comm), folder) {
  collectivelyOnRoot(comm, "preparing the output folder", [&] {
    removeTemporaries(folder);
    live_ = (fs::path(folder) / LiveHistory::kName).string();
    const fs::path summary = fs::path(folder) / "summary.json";
    std::error_code error;
    if (!fs::exists(summary, error)) return;
    fs::rename(summary, fs::path(folder) / "summary.previous.json", error);
    if (error) throw EnvironmentError("cannot rename '" + summary.string() + "': " + error.message());
  });
}

RunFolder::~RunFolder() {
  std::error_code ignored;
  if (!live_.empty()) fs::remove(live_, ignored);
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
