#include "SolveOptions.hpp"

#include <CLI/CLI.hpp>

#include <suture/base/Collective.hpp>

#include "CommandLine.hpp"
#include "OwnLauncher.hpp"
#include "Program.hpp"
#include "Watch.hpp"

namespace suture {

std::optional<int> SolveOptions::parse(int argc, char* argv[]) {
  commandLine.assign(argv, argv + argc);
  std::string output, watched;
  bool noDrawing = false;
  int ranks = 0;
  const auto describe = [&](CLI::App& app) {
    CLI::Option* file = app.add_option("SCENE", scene, "Scene file (XML); 'suture_schema' documents it")->type_name("FILE");
    CLI::Option* set = addSetOption(app, overrides, "Change a parameter, e.g. --set \"Outer Solver/Tolerance=1e-9\"");
    app.add_option("--output", output, "Output folder; default: Output/Folder of the scene, or <scene>_out in the current folder")
        ->type_name("DIR");
    CLI::Option* from = app.add_option("--restart", restart,
                                       "Start from the checkpoint.h5 of a run on the same mesh: an unfinished run, or an earlier load step")
                            ->type_name("FILE");
    CLI::Option* look = app.add_flag(
        "--check", check, "Read the scene, partition the mesh, print sizes and memory, and draw loads and supports, without solving");
    app.add_flag("--no-drawing", noDrawing, "With --check: do not draw the scene (suture_plot draws it, into the output folder)")
        ->needs(look);
    CLI::Option* draw = app.add_option("--scene-data", sceneData,
                                       "Read scene and mesh, write the data of their drawing to FILE (VTKHDF), and stop; "
                                       "'suture_plot --scene SCENE' does this and draws it")
                            ->type_name("FILE")
                            ->excludes(look);
    CLI::Option* print = app.add_flag("--print-defaults", printDefaults, "Print the scene with all defaults and stop");
    app.add_flag("--quiet", quiet, "Print errors only");
    app.add_flag("--verbose", verbose, "Also print the inner iterations; not together with --quiet");
    CLI::Option* plugin = addPluginOption(app, plugins);
    CLI::Option* severe = app.add_flag("--strict", strict, "Treat warnings as errors (exit code 3)");
    CLI::Option* repeat = app.add_option("--again", again,
                                         "Repeat the run recorded in a summary.json, instead of SCENE, and compare the results; default of "
                                         "--output: the folder of that run with '_again'")
                              ->type_name("FILE");
    app.add_option("--ranks", ranks,
                   "Use N ranks on this machine: the program starts itself under mpirun; on several machines use mpirun or srun")
        ->type_name("N")
        ->check(CLI::Range(1, 1000000).description(""));
    CLI::Option* live = app.add_option("--watch", watched,
                                       "Show the iterations of the run that writes into a folder, instead of solving; ends with that run")
                            ->type_name("DIR");
    app.footer(
        "Exit codes: 0 converged and verified, 2 command line, 3 input, 4 not converged or not verified, 5 environment (memory, files,\n"
        "libraries), 70 a bug in Suture, 75 stopped on request. Without solving: 0 done. --watch: the code of that run.");
    app.callback([=, &app] {
      if (quiet && verbose) throw CLI::ExcludesError("--verbose", "--quiet");
      if (live->count() > 0) {
        for (const CLI::Option* other : app.get_options())
          if (other != live && other->count() > 0) throw CLI::ExcludesError(other->get_name(), live->get_name());
        return;
      }
      if (scene.empty() && again.empty()) throw CLI::RequiredError("SCENE");
      for (const CLI::Option* other : {file, set, from, look, draw, print, plugin, severe})
        if (!again.empty() && other->count() > 0) throw CLI::ExcludesError(other->get_name(), repeat->get_name());
    });
  };
  const auto end =
      parseCommandLine(argc, argv, "suture_solve",
                       "Solves a scene: equilibrium of elastic bodies in unilateral contact, by domain decomposition.", describe);
  if (!end && !watched.empty()) return watch(watched);
  if (!end && ranks > 0) {
    try {
      startOwnRanks(ranks, argc, argv);
    } catch (const Error&) {  // runProgram prints it, once for all ranks of an mpirun
      return runProgram("suture_solve", "",
                        [&, error = std::current_exception()](const CommPtr&) -> ExitCode { std::rethrow_exception(error); });
    }
  }
  drawing = !noDrawing;
  if (!output.empty()) overrides.push_back("Output/Folder=" + output);
  return end;
}

Invocation SolveOptions::invocation(const Comm& comm) const {
  const auto used = [&](const std::string& path) {
    const UsedFile file = onRoot(comm, "reading " + path, [&] { return usedFile(path); });
    return UsedFile{broadcast(comm, file.path), broadcast(comm, file.hash)};
  };
  Invocation all{commandLine, {}, {}, strict};
  for (const std::string& plugin : plugins) all.plugins.push_back(used(plugin));
  if (!restart.empty()) all.restart = used(restart);
  return all;
}

}  // namespace suture
