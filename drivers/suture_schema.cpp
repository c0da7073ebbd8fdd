// Prints every parameter of a scene (or a study) with default, range and meaning, from the schema that the reader uses.
#include <CLI/CLI.hpp>
#include <iostream>
#include <suture/base/scene/SchemaDocument.hpp>
#include <suture/report/SceneSchema.hpp>

#include "schema/MaterialList.hpp"
#include "study/Schema.hpp"
#include "support/CommandLine.hpp"
#include "support/Plugins.hpp"
#include "support/Program.hpp"

namespace {

/// The scene printed by --format xml: two blocks, one pressed onto the other.
const suture::SceneExample scene = {{"Title", "Two blocks"},
                                    {"Mesh/Generator", "Boxes"},
                                    {"Mesh/Boxes/lower/X", "{0, 2}"},
                                    {"Mesh/Boxes/lower/Y", "{0, 1}"},
                                    {"Mesh/Boxes/lower/Cells", "{16, 8}"},
                                    {"Mesh/Boxes/upper/X", "{0, 2}"},
                                    {"Mesh/Boxes/upper/Y", "{1, 2}"},
                                    {"Mesh/Boxes/upper/Cells", "{16, 8}"},
                                    {"Bodies/lower/Material", "steel"},
                                    {"Bodies/upper/Material", "steel"},
                                    {"Materials/steel/Young Modulus", "2.1e11"},
                                    {"Materials/steel/Poisson Ratio", "0.3"},
                                    {"Boundary Conditions/ground/Group", "{lower_bottom}"},
                                    {"Boundary Conditions/ground/Type", "Displacement"},
                                    {"Boundary Conditions/ground/Value", "{0, 0}"},
                                    {"Boundary Conditions/guide/Group", "{upper_left}"},
                                    {"Boundary Conditions/guide/Type", "Bilateral"},
                                    {"Boundary Conditions/load/Group", "{upper_top}"},
                                    {"Boundary Conditions/load/Type", "Pressure"},
                                    {"Boundary Conditions/load/Value", "{1e6}"},
                                    {"Contact/joint/Side A", "{lower_top}"},
                                    {"Contact/joint/Side B", "{upper_bottom}"}};

}  // namespace

int main(int argc, char* argv[]) {
  const std::string name = "suture_schema";
  std::string format = "text";
  std::vector<std::string> plugins;
  bool study = false, materials = false;
  const auto describe = [&](CLI::App& app) {
    app.add_option("--format", format, "text (default) | xml (a scene that can be solved, with all defaults) | markdown")
        ->check(CLI::IsMember({"text", "xml", "markdown"}));
    app.add_flag("--study", study, "Print the parameters of a study instead of a scene");
    app.add_flag("--materials", materials, "Print the built-in materials with values and sources instead (text or markdown)");
    suture::addPluginOption(app, plugins);
  };
  if (const auto end = suture::parseCommandLine(
          argc, argv, name, "Prints the parameters of a scene or of a study, with meaning, range and default.", describe))
    return *end;
  try {
    suture::loadPlugins(plugins);
    if (materials) return suture::printed(name, suture::materialList(format));
    return suture::printed(
        name, study ? suture::documentOf(suture::study::studySchema(), format) : suture::documentOf(suture::sceneSchema(), format, scene));
  } catch (const std::exception& error) {
    const suture::Explanation end = suture::explain(name, "", error);
    std::cerr << end.message;
    return int(end.code);
  }
}
