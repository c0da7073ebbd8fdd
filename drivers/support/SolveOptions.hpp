#pragma once
#include <suture/report/RunRecord.hpp>

#include <optional>
#include <string>
#include <vector>

namespace suture {

/// The command line of suture_solve, and of each run of suture_study.
struct SolveOptions {
  std::string scene;
  std::string again;                   ///< summary.json of a run to make again, or empty; then `scene` and all that changes it are its
  std::string restart;                 ///< checkpoint to go on from, or empty
  std::vector<std::string> overrides;  ///< of --set, and --output as "Output/Folder=DIR"
  std::vector<std::string> plugins;
  bool check = false, printDefaults = false, quiet = false, verbose = false, strict = false;
  std::vector<std::string> commandLine;  ///< as given, for provenance

  std::optional<RunRecord> record;  ///< run that is made again

  /// \return the exit code when the program ends here (--help, --version, a wrong option)
  std::optional<int> parse(int argc, char* argv[]);

  /// Plugins and checkpoint with their hashes, and the rest, for the record of a run. Collective. \throws InputError  a file is gone
  Invocation invocation(const Comm& comm) const;
};

}  // namespace suture
