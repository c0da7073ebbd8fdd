// Prepares the mesh of a scene for many runs: meshes the geometry, cuts it as specified by the scene's Partition, and writes an HDF5 file
// with the subdomains as element groups. A scene with Mesh/File = that file reads it in a fraction of the time.
#include <CLI/CLI.hpp>
#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Timers.hpp>
#include <suture/partition/Partition.hpp>
#include <suture/reader/Hdf5Mesh.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/CutStage.hpp>
#include <suture/simulation/ReadStage.hpp>

#include "support/CommandLine.hpp"
#include "support/Heartbeat.hpp"
#include "support/Plugins.hpp"
#include "support/Program.hpp"
#include "support/TellingOverrides.hpp"

using namespace suture;

namespace {

// The reader recognises the format by the file name extension.
std::string endsWithH5(const std::string& path) {
  return std::filesystem::path(path).extension() == ".h5" ? "" : "found '" + path + "', expected a file name that ends in .h5";
}

struct Options {
  std::string scene, output, groups = "cut";
  std::vector<std::string> overrides, plugins;
  bool noCut = false, quiet = false;

  std::optional<int> parse(int argc, char* argv[]) {
    const auto describe = [&](CLI::App& app) {
      app.add_option("SCENE", scene, "Scene file (XML); 'suture_schema' documents it")->required()->type_name("FILE");
      app.add_option("--output", output, "Mesh file to write (.h5)")->required()->type_name("FILE")->check(endsWithH5);
      app.add_option("--groups", groups, "Prefix of the subdomains' names in the file: <prefix>_0000, <prefix>_0001, ...")
          ->capture_default_str();
      app.add_flag("--no-cut", noCut, "Write the mesh without subdomains");
      addSetOption(app, overrides, "Change a parameter of the scene");
      app.add_flag("--quiet", quiet, "Print errors only");
      addPluginOption(app, plugins);
    };
    return parseCommandLine(argc, argv, "suture_partition", "Meshes and partitions a scene once, into an HDF5 mesh file.", describe);
  }
};

std::string numbered(const std::string& name, int i) {
  std::ostringstream text;
  text << name << "_" << std::setw(4) << std::setfill('0') << i;
  return text.str();
}

// The pattern <name>_* must match the new groups only.
void checkGroups(const Mesh& mesh, const std::string& name) {
  for (const std::string& group : mesh.elementGroupNames())
    if (group.rfind(name + "_", 0) == 0)
      throw InputError("--groups", "the mesh has an element group '" + group + "'; expected another prefix than '" + name + "'");
}

void addGroups(Mesh& mesh, const Partition& partition, const std::string& name) {
  std::vector<std::vector<int>> elements(std::size_t(partition.subdomains()));
  for (std::size_t e = 0; e < partition.subdomainOfElement.size(); ++e)
    elements[std::size_t(partition.subdomainOfElement[e])].push_back(int(e));
  for (int i = 0; i < partition.subdomains(); ++i) mesh.elementGroups[numbered(name, i)] = std::move(elements[std::size_t(i)]);
}

ExitCode run(const CommPtr& comm, const Options& options) {
  loadPlugins(options.plugins);
  std::ostream* const console = consoleOf(*comm, options.quiet);
  const Heartbeat heartbeat(console);
  Timers timers;
  const Scene scene = sceneOf(*comm, readScene(*comm, options.scene, sceneSchema(), options.overrides));
  Mesh mesh = timed(timers, "read", [&] { return readBodies(*comm, scene); });
  const int elements = int(mesh.elements());
  if (!options.noCut) {
    collectivelyOnRoot(*comm, "checking the name of the subdomains", [&] { checkGroups(mesh, options.groups); });
    const Constraints constraints = timed(timers, "read", [&] { return readConstraints(*comm, mesh, scene); });
    checkElements(*comm, mesh, scene.model);
    const Parameters& way = scene.settings().sublist("Partition");
    const Partition partition = timed(timers, "partition", [&] { return makePartition(*comm, mesh, constraints, way, false); });
    const Timers::Scope write(timers, "write");
    checkSolvability(*comm, mesh, constraints, scene.model, partition);
    const Whole whole = wholeOf(*comm, mesh, constraints, partition);
    collectivelyOnRoot(*comm, "naming the subdomains", [&] { addGroups(mesh, partition, options.groups); });
    std::optional<Mesh> plain;
    if (scene.coat) plain = mesh, removeCoatings(*plain);
    writeHdf5Mesh(*comm, plain ? *plain : mesh, options.output,
                  [&](Hdf5Writer& to) { addCut(to, mesh, constraints, partition, whole, scene); });
  } else {
    removeCoatings(mesh);
    writeHdf5Mesh(*comm, mesh, options.output);
  }
  if (console) {
    *console << options.output << ": " << counted(elements, "element");
    if (!options.noCut)
      *console << ", subdomains " << options.groups
               << "_*: use it with Mesh/File = this file and Partition/Type = Partitioned Mesh in this scene, or with Named Groups and "
                  "this Pattern in another one";
    *console << std::endl;
  }
  return ExitCode::Done;
}

}  // namespace

int main(int argc, char* argv[]) {
  Options options;
  if (const auto end = options.parse(argc, argv)) return *end;
  return runProgram("suture_partition", options.scene,
                    [&](const CommPtr& comm) { return tellingOverrides(options.overrides, [&] { return run(comm, options); }); });
}
