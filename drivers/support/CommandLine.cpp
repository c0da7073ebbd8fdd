#include "CommandLine.hpp"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <iostream>
#include <suture/base/Errors.hpp>
#include <suture/base/Version.hpp>

#include "Program.hpp"

namespace suture {
namespace {

std::vector<std::string> optionNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

// Adds the nearest option name to CLI11's message about an unexpected word.
std::string complaint(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> extra = app.remaining();
  if (dynamic_cast<const CLI::ExtrasError*>(&error) && !extra.empty() && extra.front().rfind("--", 0) == 0)
    return unknownName("option", extra.front().substr(0, extra.front().find('=')), optionNames(app));
  return error.what();
}

}  // namespace

std::optional<int> parseCommandLine(int argc, char* argv[], const std::string& name, const std::string& purpose,
                                    const std::function<void(CLI::App&)>& describe) {
  openStandardFiles();
  CLI::App app(purpose, name);
  app.set_version_flag("--version", name + " " + version() + " (" + commit() + ")", "Print version and commit");
  app.get_formatter()->column_width(34);
  app.footer("Exit codes: 0 done, 2 command line, 3 input, 5 environment (memory, files, libraries), 70 a bug in Suture.");
  describe(app);
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::CallForHelp&) {
    return printed(name, app.help());
  } catch (const CLI::CallForVersion& text) {
    return printed(name, std::string(text.what()) + "\n");
  } catch (const CLI::ParseError& error) {
    // Prints before MPI starts, because mpirun ends all ranks with the first that fails, perhaps before rank 0 has printed.
    const std::string text = complaint(app, error);
    return runProgram(name, "", [&](const CommPtr&) -> ExitCode { throw CommandLineError(text); });
  }
}

int printed(const std::string& name, const std::string& text) {
  if (!isFirstProcess()) return 0;
  errno = 0;
  std::cout << text << std::flush;
  if (std::cout.good()) return 0;
  std::cerr << outputFailure(name, errno != 0 ? errno : EIO);
  return int(ExitCode::Environment);
}

CLI::Option* addSetOption(CLI::App& app, std::vector<std::string>& assignments, const std::string& meaning) {
  return app.add_option("--set", assignments, meaning + "; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false)
      ->check([](const std::string& text) {
        return text.find('=') == std::string::npos ? "'" + text + "' is not of the form Path/To/Parameter=value" : "";
      });
}

CLI::Option* addPluginOption(CLI::App& app, std::vector<std::string>& plugins) {
  return app.add_option("--plugin", plugins, "Load a library with user-defined strategies; may be repeated")
      ->type_name("LIB.so")
      ->allow_extra_args(false);
}

}  // namespace suture
