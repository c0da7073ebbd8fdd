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
/// \return the exit code when the program ends here (0 or 2), nothing when it goes on. Local.
std::optional<int> parseCommandLine(int argc, char* argv[], const std::string& name, const std::string& purpose,
                                    const std::function<void(CLI::App&)>& describe);

/// `--set PATH=VALUE`, as often as one likes. Without '=' it is refused.
/// \param meaning  for --help: what the values change
CLI::Option* addSetOption(CLI::App& app, std::vector<std::string>& assignments, const std::string& meaning);

/// `--plugin LIB.so`, as often as one likes: for loadPlugins().
CLI::Option* addPluginOption(CLI::App& app, std::vector<std::string>& plugins);

}  // namespace suture
