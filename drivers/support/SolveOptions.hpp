#pragma once
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// The command line of suture_solve.
struct SolveOptions {
  std::string scene;
  std::string restart;                 ///< checkpoint to go on from, or empty
  std::vector<std::string> overrides;  ///< of --set, and --output as "Output/Folder=DIR"
  std::vector<std::string> plugins;
  bool check = false, printDefaults = false, quiet = false, verbose = false, strict = false;
  std::vector<std::string> commandLine;  ///< as given, for provenance

  /// \return the exit code when the program ends here (--help, --version, a wrong option)
  std::optional<int> parse(int argc, char* argv[]);
};

}  // namespace suture
