#include "SolveOptions.hpp"

#include <CLI/CLI.hpp>

#include "CommandLine.hpp"

namespace suture {

std::optional<int> SolveOptions::parse(int argc, char* argv[]) {
  commandLine.assign(argv, argv + argc);
  std::string output;
  const auto describe = [&](CLI::App& app) {
    app.add_option("SCENE", scene, "Scene file (XML); 'suture_schema' documents it")->required()->type_name("FILE");
    addSetOption(app, overrides, "Change a parameter, e.g. --set \"Outer Solver/Tolerance=1e-9\"");
    app.add_option("--output", output, "Output folder, instead of the scene's Output/Folder")->type_name("DIR");
    app.add_option("--restart", restart,
                   "Start from the checkpoint.h5 of a run of this mesh: one that did not end, or an earlier load step")
        ->type_name("FILE");
    app.add_flag("--check", check, "Read everything, cut the mesh, print the sizes, solve nothing");
    app.add_flag("--print-defaults", printDefaults, "Print the scene with all defaults filled in and stop");
    CLI::Option* silent = app.add_flag("--quiet", quiet, "Print errors only");
    app.add_flag("--verbose", verbose, "Print the inner iterations, too")->excludes(silent);
    addPluginOption(app, plugins);
    app.add_flag("--strict", strict, "Treat warnings (something repaired or assumed for you) as errors");
  };
  const auto end = parseCommandLine(argc, argv, "suture_solve",
                                    "Equilibrium of elastic bodies in unilateral contact, by domain decomposition.", describe);
  if (!output.empty()) overrides.push_back("Output/Folder=" + output);
  return end;
}

}  // namespace suture
