#pragma once
#include <optional>
#include <string>
#include <vector>

namespace suture::study {

/// The command line of suture_study.
struct Options {
  std::string study;
  std::string output;                   ///< empty: studies_out/<study> beside the study file
  std::vector<std::string> overrides;   ///< of --set for the scene of every run
  std::vector<std::string> ofTheStudy;  ///< of --set "Study/...": for the study itself, the prefix taken off
  std::vector<std::string> only;
  std::vector<std::string> plugins;
  bool check = false, quiet = false, goOn = false;
  std::vector<std::string> commandLine;  ///< as given, for provenance

  /// \return the exit code when the program ends here (--help, --version, a wrong option)
  std::optional<int> parse(int argc, char* argv[]);

  /// Where the tables go.
  std::string folder() const;
};

}  // namespace suture::study
