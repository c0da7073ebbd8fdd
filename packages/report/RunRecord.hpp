#pragma once
#include <suture/base/Types.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/report/Invocation.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace suture {

/// `record` of summary.json: what starts the run once more. A scene that is no file is null. Local.
nlohmann::ordered_json recordJson(const SceneFile& scene, const Invocation& invocation);

/// A summary.json as the record of a run that is to be made again.
struct RunRecord {
  /// Version of summary.json: grows when a key is renamed, removed or changes its meaning, not when one is added.
  static constexpr int kVersion = 1;
  static constexpr const char* kName = "suture summary";

  std::string path, text;  ///< place and content of summary.json
  UsedFile scene;
  std::vector<std::string> overrides;  ///< assignments of the run, without Output/Folder
  std::vector<UsedFile> plugins;
  UsedFile restart;
  bool strict = false;
  std::string meshHash;

  /// The folder that a run made again writes into: that of the summary with `_again`.
  std::string folderOfAgain() const;

  /// Refuses plugins and a checkpoint that are gone, and a checkpoint that has changed. On rank 0.
  /// \return notes on plugins that have changed  \throws InputError
  std::vector<std::string> checkFiles() const;

  /// Refuses a scene whose parameters are others than those of the run. Local, the same on all ranks.
  /// \return notes: the file has changed without changing a parameter  \throws InputError  each parameter that differs
  std::vector<std::string> checkScene(const SceneFile& file) const;

  /// Refuses another mesh. Local. \throws InputError
  void checkMesh(const std::string& hash) const;
};

/// Reads a summary.json, or that of a folder, on rank 0 and gives it to all. Collective.
/// \throws InputError  it is none, of another version, of a run that was stopped, or of a scene made in C++
RunRecord readRunRecord(const Comm& comm, const std::string& path);

}  // namespace suture
