#pragma once
#include <suture/base/Types.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/report/Invocation.hpp>

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace suture {

/// `record` of summary.json: everything needed to repeat the run. Null for a scene that is not a file. Local.
nlohmann::ordered_json recordJson(const SceneFile& scene, const Invocation& invocation);

/// A summary.json as the record of a run to be repeated.
struct RunRecord {
  /// Version of summary.json, incremented when a key is renamed, removed or changes its meaning, not when one is added.
  static constexpr int kVersion = 1;
  static constexpr const char* kName = "suture summary";

  std::string path, text;  ///< place and content of summary.json
  UsedFile scene;
  std::vector<std::string> overrides;  ///< overrides of the run, without Output/Folder
  std::vector<UsedFile> plugins;
  std::vector<UsedFile> materialFiles;  ///< from which materials were taken
  UsedFile restart;
  bool strict = false;
  std::string meshHash;

  /// The output folder of the repeated run: the folder of the summary with `_again` appended.
  std::string folderOfAgain() const;

  /// Refuses missing plugins, and a checkpoint that is missing or has changed. On rank 0.
  /// \return notes on plugins that have changed  \throws InputError
  std::vector<std::string> checkFiles() const;

  /// Refuses a scene whose parameters differ from those of the run. Local, the same on all ranks.
  /// \return a note if the file has changed but no parameter  \throws InputError  each parameter that differs
  std::vector<std::string> checkScene(const SceneFile& file) const;

  /// Refuses another mesh. Local. \throws InputError
  void checkMesh(const std::string& hash) const;
};

/// Reads a summary.json, given by its path or folder, on rank 0 and sends it to all ranks. Collective.
/// \throws InputError  not a summary, another version, a stopped run, or a scene created in C++
RunRecord readRunRecord(const Comm& comm, const std::string& path);

}  // namespace suture
