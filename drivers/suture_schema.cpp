// Prints every parameter that a scene (or a study) may have, with defaults, ranges and meaning: from the same description as the reader.
#include <CLI/CLI.hpp>
#include <iostream>
#include <suture/report/SceneSchema.hpp>

#include "study/Schema.hpp"
#include "support/CommandLine.hpp"
#include "support/Plugins.hpp"
#include "support/Program.hpp"

int main(int argc, char* argv[]) {
  const std::string name = "suture_schema";
  std::string format = "text";
  std::vector<std::string> plugins;
  bool study = false;
  const auto describe = [&](CLI::App& app) {
    app.add_option("--format", format, "text | xml (a scene with all defaults) | markdown")
        ->check(CLI::IsMember({"text", "xml", "markdown"}));
    app.add_flag("--study", study, "The parameters of a study, not of a scene");
    suture::addPluginOption(app, plugins);
  };
  if (const auto end = suture::parseCommandLine(argc, argv, name, "The documented parameters of a Suture scene.", describe)) return *end;
  try {
    suture::loadPlugins(plugins);
    if (suture::isFirstProcess())
      std::cout << (study ? suture::study::studySchema() : suture::sceneSchema()).document(format) << std::flush;
    return std::cout.good() ? 0 : int(suture::ExitCode::Environment);
  } catch (const std::exception& error) {
    const suture::Explanation end = suture::explain(name, "", error);
    std::cerr << end.message;
    return int(end.code);
  }
}
