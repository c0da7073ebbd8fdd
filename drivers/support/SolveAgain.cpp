#include "SolveAgain.hpp"

#include <Teuchos_Comm.hpp>

#include <suture/base/Collective.hpp>
#include <suture/report/Comparison.hpp>
#include <suture/simulation/Overrides.hpp>

#include <filesystem>
#include <iostream>

#include "Plugins.hpp"
#include "Program.hpp"
#include "SolveScene.hpp"
#include "TellingOverrides.hpp"

namespace fs = std::filesystem;

namespace suture {

namespace {

constexpr const char* kFolder = "Output/Folder=";

/// The run of a record as a command line; output folder and verbosity are taken from `options`.
SolveOptions optionsOf(const RunRecord& record, SolveOptions options) {
  const std::string folder = options.overrides.empty() ? kFolder + record.folderOfAgain() : options.overrides.back();
  options.scene = record.scene.path;
  options.overrides = record.overrides;
  options.overrides.push_back(folder);
  options.restart = record.restart.path;
  options.strict = record.strict;
  options.plugins.clear();
  for (const UsedFile& plugin : record.plugins) options.plugins.push_back(plugin.path);
  options.record = record;
  return options;
}

/// \throws CommandLineError  the run would overwrite its record
void keepRecord(const Comm& comm, const RunRecord& record, const std::string& folder) {
  collectivelyOnRoot(comm, "comparing folders", [&] {
    std::error_code ignored;
    const fs::path own = fs::absolute(fs::path(record.path), ignored).parent_path();
    if (fs::equivalent(own, folder, ignored) || fs::weakly_canonical(own) == fs::weakly_canonical(fs::absolute(folder, ignored)))
      throw CommandLineError("--output '" + folder +
                             "' is the folder of the original run, whose results would be replaced; "
                             "choose another folder");
  });
}

}  // namespace

ExitCode solveAgain(const CommPtr& comm, SolveOptions options, std::string& subject) {
  const RunRecord record = readRunRecord(*comm, options.again);
  options = optionsOf(record, options);
  const std::string folder = options.overrides.back().substr(std::string(kFolder).size());
  keepRecord(*comm, record, folder);
  const std::vector<std::string> notes = onRoot(*comm, "comparing files", [&] { return record.checkFiles(); });
  loadPlugins(options.plugins);
  subject = record.scene.path;
  RunResult result;
  tellingOverrides(options.overrides, [&] { return (result = solveScene(comm, options)).code; });
  subject = options.again;
  int agrees = 1;
  collectivelyOnRoot(*comm, "comparing results", [&] {
    const Comparison comparison = compareSummaries(record.text, result.summary);
    writeComparison(comparison, (fs::path(folder) / "comparison.csv").string());
    agrees = comparison.agrees();
    if (!options.quiet) {
      for (const std::string& note : notes) std::cout << "note: " << note << "\n";
      std::cout << tableOf(comparison) << std::flush;
    } else if (!agrees) {
      std::cerr << "suture_solve: the results do not agree with " << record.path << ": " << failureOf(comparison) << std::endl;
    }
  });
  broadcastBytes(*comm, &agrees, sizeof agrees);
  return result.code != ExitCode::Done || agrees ? result.code : ExitCode::Numerical;
}

void sameScene(const SolveOptions& options, const SceneFile& file, RunMonitor& monitor) {
  if (!options.record) return;
  for (const std::string& note : options.record->checkScene(file)) monitor.note(note);
}

void sameMesh(const Comm& comm, const SolveOptions& options, const PartitionedScene& scene) {
  if (!options.record || scene.scene().accuracy) return;  // refined meshes are compared by their sizes
  collectivelyOnRoot(comm, "comparing meshes", [&] { options.record->checkMesh(scene.meshHash()); });
}

}  // namespace suture
