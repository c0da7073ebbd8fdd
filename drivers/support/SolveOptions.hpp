#pragma once
#include <suture/report/RunRecord.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// The command line of suture_solve and of each run of suture_study.
struct SolveOptions {
  std::string scene;
  std::string again;                   ///< summary.json of a run to repeat, or empty; its record replaces `scene` and overrides
  std::string restart;                 ///< checkpoint to start from, or empty
  std::vector<std::string> overrides;  ///< from --set, and --output as "Output/Folder=DIR"
  std::vector<std::string> plugins;
  std::string sceneData;  ///< file for the data of a drawing, or empty
  bool check = false, printDefaults = false, quiet = false, verbose = false, strict = false;
  bool drawing = true;                   ///< --check draws the scene, unless `quiet`
  std::vector<std::string> commandLine;  ///< as given, for provenance

  std::optional<RunRecord> record;  ///< the run to repeat

  /// \return the exit code if the program ends here (--help, --version, a wrong option)
  std::optional<int> parse(int argc, char* argv[]);

  /// Command line, plugins and checkpoint with their hashes, for the record of a run. Collective. \throws InputError  a file is missing
  Invocation invocation(const Comm& comm) const;
};

}  // namespace suture
