#pragma once
#include <optional>
#include <string>
#include <vector>

namespace suture::study {

/// The command line of suture_study.
struct Options {
  std::string study;
  std::string output;                   ///< empty: studies_out/<study> next to the study file
  std::vector<std::string> overrides;   ///< from --set, for the scene of every run
  std::vector<std::string> ofTheStudy;  ///< from --set "Study/...", for the study itself, without the prefix
  std::vector<std::string> only;
  std::vector<std::string> plugins;
  bool check = false, quiet = false, goOn = false;
  std::vector<std::string> commandLine;  ///< as given, for provenance

  /// \return the exit code if the program ends here (--help, --version, a wrong option)
  std::optional<int> parse(int argc, char* argv[]);

  /// Output folder of the tables.
  std::string folder() const;
};

}  // namespace suture::study
