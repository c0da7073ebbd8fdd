#pragma once
#include <suture/base/Types.hpp>

#include <string>

namespace suture {

/// Creates the output folder and checks that it is writable, before any work is done. Collective.
/// \throws EnvironmentError  names the folder and the system's reason
void prepareFolder(const Comm& comm, const std::string& folder);

/// Locks a folder against other runs during its lifetime. Uses a lock of the operating system (flock on the file .suture.lock, held by
/// rank 0), which ends with the process: stale locks cannot occur.
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

/// The prepared and locked folder of one run. Files of an earlier run stay until the new results are complete, except its summary.json,
/// which is renamed to summary.previous.json at once so that it is not mistaken for the summary of this run if this run fails. Removes
/// temporary files of killed runs, and at its end the LiveHistory of this run.
class RunFolder {
 public:
  /// Collective. \throws EnvironmentError
  RunFolder(const Comm& comm, const std::string& folder);
  /// Local.
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// Path of the LiveHistory; empty on other ranks than 0.
  const std::string& liveHistory() const { return live_; }

 private:
  FolderLock lock_;
  std::string live_;
};

/// Writes a text file under a temporary name in the same folder and renames it, so that readers never see an incomplete file. Local.
/// \throws EnvironmentError
void writeTextFile(const std::string& path, const std::string& text);

}  // namespace suture
