#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

// CLI11 is expensive to compile: include it only in sources that define options.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace suture {

/// Parses the command line of a driver before MPI starts. Handles `--help` and `--version`, and refuses wrong options with the nearest
/// name. Prints once, independent of the number of processes.
/// \param describe  adds the program's own options and arguments, and its exit codes as the footer of --help if it has others than 0, 2, 3,
/// 5 and 70
/// \return the exit code if the program ends here (0, 2, or 5: standard output could not be written), otherwise nothing. Local.
std::optional<int> parseCommandLine(int argc, char* argv[], const std::string& name, const std::string& purpose,
                                    const std::function<void(CLI::App&)>& describe);

/// Prints a text once, independent of the number of processes, before MPI starts or without it.
/// \return the exit code: 0, or 5 if standard output cannot be written; then prints the reason to standard error. Local.
int printed(const std::string& name, const std::string& text);

/// Adds `--set PATH=VALUE`, which may be repeated. Refuses arguments without '='.
/// \param meaning  effect of the values, for --help
CLI::Option* addSetOption(CLI::App& app, std::vector<std::string>& assignments, const std::string& meaning);

/// Adds `--plugin LIB.so`, which may be repeated, for loadPlugins().
CLI::Option* addPluginOption(CLI::App& app, std::vector<std::string>& plugins);

}  // namespace suture
