#pragma once
#include <suture/base/Types.hpp>

#include <string>

namespace suture {

/// Makes the output folder and checks that it can be written, before any work is done. Collective.
/// \throws EnvironmentError  names the folder and the system's reason
void prepareFolder(const Comm& comm, const std::string& folder);

/// Keeps other runs out of a folder while it lives. The lock is the system's (flock on the file .suture.lock, held by rank 0): it goes with
/// the process, however that ends, so that no stale one is left.
class FolderLock {
 public:
  /// Collective. \throws EnvironmentError  another run writes into the folder: names its process and machine
  FolderLock(const Comm& comm, const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::string path_;
  int file_ = -1;  ///< on rank 0
};

/// The folder of one run, prepared and locked. The files of an earlier run stay until the new results are complete; only its summary.json
/// is renamed to summary.previous.json at once: if this run fails, the earlier summary is not taken for its own. Temporary files of runs
/// that were killed while they wrote are removed.
class RunFolder {
 public:
  /// Collective. \throws EnvironmentError
  RunFolder(const Comm& comm, const std::string& folder);

 private:
  FolderLock lock_;
};

/// Writes a text file under a temporary name in the same folder and renames it, so that a reader never sees half of it. Local.
/// \throws EnvironmentError
void writeTextFile(const std::string& path, const std::string& text);

}  // namespace suture
