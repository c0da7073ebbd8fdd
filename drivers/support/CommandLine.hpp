#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

// CLI11 is expensive: only the sources that name options include it.
namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace suture {

/// Parses the command line of a driver before MPI begins: `--help` and `--version` are answered here, wrong options refused with the
/// nearest name. Prints once, however many processes there are.
/// \param describe  adds the program's own options and arguments
/// \return the exit code when the program ends here (0, 2, or 5: its text could not be written), nothing when it goes on. Local.
std::optional<int> parseCommandLine(int argc, char* argv[], const std::string& name, const std::string& purpose,
                                    const std::function<void(CLI::App&)>& describe);

/// Prints a text once, however many processes there are, before MPI begins or without it.
/// \return the exit code: 0, or 5 where standard output cannot be written; then the reason is on standard error. Local.
int printed(const std::string& name, const std::string& text);

/// `--set PATH=VALUE`, as often as one likes. Without '=' it is refused.
/// \param meaning  for --help: what the values change
CLI::Option* addSetOption(CLI::App& app, std::vector<std::string>& assignments, const std::string& meaning);

/// `--plugin LIB.so`, as often as one likes: for loadPlugins().
CLI::Option* addPluginOption(CLI::App& app, std::vector<std::string>& plugins);

}  // namespace suture
