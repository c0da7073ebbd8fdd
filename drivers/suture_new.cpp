// Writes a scene file for a geometry, a CAD file or a mesh: lists its groups, identifies its bodies, and proposes contacts between sides
// that face each other. The scene can be solved as it is.
#include <CLI/CLI.hpp>
#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Point.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/reader/MeshReader.hpp>
#include <suture/reader/cad/CadFile.hpp>
#include <suture/reader/cad/SideDescriptions.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/SceneSchema.hpp>

#include "new/SceneText.hpp"
#include "support/CommandLine.hpp"
#include "support/Program.hpp"

using namespace suture;
using namespace suture::proposal;
namespace fs = std::filesystem;

namespace {

const std::vector<std::string> models{"Plane Strain", "Plane Stress", "Axisymmetric", "Solid"};

struct Options {
  std::string geometry, output, model, units = "m, N, Pa";
  std::vector<std::string> constants;
  bool force = false, unitsGiven = false;

  std::optional<int> parse(int argc, char* argv[]) {
    const auto describe = [&](CLI::App& app) {
      app.add_option("GEOMETRY", geometry, "Geometry (.geo), CAD file (.step, .stp, .iges, .igs, .brep, .stl) or mesh (.msh, .h5)")
          ->required()
          ->type_name("FILE");
      app.add_option("--output", output, "Scene file to write; default: <geometry>.xml in the current folder")->type_name("FILE");
      app.add_option("--model", model, "2D: Plane Strain (default) | Plane Stress | Axisymmetric; 3D: Solid")
          ->check(CLI::IsMember(models))
          ->type_name("NAME");
      app.add_option("--constant", constants, "Set a constant of DefineConstant in the .geo file; may be repeated")
          ->type_name("NAME=VALUE")
          ->check([](const std::string& text) {
            return text.find('=') == std::string::npos ? "found '" + text + "', expected NAME=VALUE" : std::string();
          });
      app.add_option(
             "--units", units,
             "Units of length, force and stress; mm, m and in select \"mm, N, MPa\", \"m, N, Pa\" and \"in, lbf, psi\". STEP and IGES "
             "files are converted to this unit of length; everything else must be in these units")
          ->type_name("NAMES")
          ->capture_default_str()
          ->each([this](const std::string&) { unitsGiven = true; });
      app.add_flag("--force", force, "Overwrite an existing scene file");
    };
    const std::optional<int> end = parseCommandLine(
        argc, argv, "suture_new",
        "Writes a scene for a geometry, a CAD file or a mesh. It can be solved as it is; placeholders are marked FILL IN.", describe);
    units = completeUnits(units);
    return end;
  }
};

/// The path of a file relative to the folder of the scene.
std::string relativeTo(const fs::path& scene, const fs::path& file) {
  const fs::path folder = fs::absolute(scene).parent_path();
  const fs::path near = fs::absolute(file).lexically_relative(folder);
  return (near.empty() ? fs::absolute(file) : near).string();
}

/// The model of the scene. \throws InputError  a 2D model for a 3D mesh, or vice versa
std::string modelOf(const Mesh& mesh, const Options& options) {
  const bool inSpace = mesh.dimension == 3;
  if (options.model.empty()) return inSpace ? "Solid" : models.front();
  if (inSpace != (options.model == "Solid"))
    throw InputError("--model",
                     "'" + options.model + "' for " + mesh.source +
                         (inSpace ? ", a 3D mesh; expected Solid" : ", a 2D mesh; expected Plane Strain, Plane Stress or Axisymmetric"));
  return options.model;
}

NewScene propose(Mesh& mesh, const SideDescriptions& descriptions, const Options& options, const fs::path& output) {
  NewScene scene;
  scene.descriptions = descriptions;
  scene.isConverted = hasLengthUnit(cadFormat(options.geometry));
  scene.model = modelOf(mesh, options);
  scene.bodies = proposeBodies(mesh);
  Problems problems;
  for (const std::string& note : scene.bodies.notes) problems.add("Bodies", note);
  if (scene.bodies.names.empty() && scene.bodies.notes.empty())
    problems.add("Bodies", mesh.source + " has no elements in a " + mesh.elementGroupKind() + "; expected at least one");
  problems.throwIfAny();
  assignBodies(mesh, scene.bodies.names);
  if (scene.model == "Axisymmetric") makeAxisymmetric(mesh);
  scene.meshNotes = mesh.notes;
  scene.title = fs::path(options.geometry).stem().string();
  scene.file = relativeTo(output, options.geometry);
  scene.constants = options.constants;
  scene.boxes = boxesOf(mesh);
  scene.groups = groupsOf(mesh);
  scene.contacts = proposeContacts(mesh, scene.groups);
  scene.dimension = mesh.dimension;
  scene.units = ExampleUnits(options.units);
  scene.supports = proposeSupports(mesh, scene.groups, scene.contacts, scene.units.youngModulus());
  return scene;
}

void write(const fs::path& output, const std::string& text) {
  std::ofstream file(output);
  file << text << std::flush;
  if (!file) throw EnvironmentError("cannot write '" + output.string() + "'");
}

/// A hint if the default units make a body as large as a building: most drawings are in mm.
std::string unitsHint(const NewScene& scene) {
  constexpr double kLarge = 10.0;  // m
  std::size_t largest = 0;
  std::vector<double> sizes;
  for (const auto& [low, high] : scene.boxes) {
    const Point edges = minus(high, low);
    sizes.push_back(std::max({edges[0], edges[1], edges[2]}));
    if (sizes.back() > sizes[largest]) largest = sizes.size() - 1;
  }
  if (scene.isConverted || sizes.empty() || sizes[largest] <= kLarge) return "";
  return "   note: '" + scene.bodies.names[largest] + "' is " + format("%g", sizes[largest]) +
         " m long in the default units (m, N, Pa). If the geometry is in mm, add: --units \"mm, N, MPa\" --force\n";
}

void tell(std::ostream& out, const NewScene& scene, const fs::path& output, bool unitsGiven) {
  const std::string sides = scene.dimension == 2 ? "curve group" : "surface group";
  out << output.string() << ": "
      << (scene.bodies.names.size() == 1 ? "1 body" : grouped(static_cast<long long>(scene.bodies.names.size())) + " bodies") << ", "
      << counted(static_cast<long long>(scene.groups.size()), sides) << ", "
      << counted(static_cast<long long>(scene.contacts.all.size()), "contact") << " proposed\n";
  for (const proposal::Contact& contact : scene.contacts.all)
    out << "   contact: " << joinNames(contact.sideA) << " on " << joinNames(contact.sideB) << ", " << distanceText(contact) << "\n";
  if (scene.bodies.names.size() > 1) out << "   " << searchText(scene.contacts) << "\n";
  for (const proposal::Contact& contact : scene.contacts.all)
    for (const std::string& problem : contact.problems) out << "   note: left out of the scene: " << problem << "\n";
  for (const std::string& note : scene.meshNotes) out << "   note: " << note << "\n";
  for (const std::string& note : scene.contacts.notes) out << "   note: " << note << "\n";
  const Supports& supports = scene.supports;
  std::vector<std::string> parts;
  if (!supports.held.empty()) parts.push_back("'" + supports.held + "' held");
  if (!supports.pushed.empty()) parts.push_back("'" + supports.pushed + "' pushed" + (supports.byForce ? " by a force" : ""));
  if (!supports.softBodies.empty()) parts.push_back("soft springs on " + joinNames(supports.softBodies, 5));
  for (std::size_t i = 0; i < parts.size(); ++i) out << (i == 0 ? "   placeholders: " : "; ") << parts[i];
  if (!parts.empty()) out << "\n";
  for (const std::string& body : supports.loose)
    out << "   note: body '" << body << "' has no " << sides
        << ": it cannot be held, and the scene does not run yet. Name one of its sides\n";
  if (!unitsGiven) out << unitsHint(scene);
  out << "   next: suture_plot --scene " << output.string() << " draws the parts with the names of their sides\n"
      << "   next: replace the placeholders marked FILL IN, then run: suture_solve " << output.string() << std::endl;
}

ExitCode run(const CommPtr& comm, const Options& options) {
  const fs::path output = options.output.empty() ? fs::path(fs::path(options.geometry).stem().string() + ".xml") : fs::path(options.output);
  onRoot(*comm, "looking for the scene file", [&] {
    if (!options.force && fs::exists(output))
      throw InputError("--output", "'" + output.string() + "' exists; choose another name, or overwrite it with --force");
    return 0;
  });
  std::vector<std::string> settings{"Mesh/File=" + fs::absolute(options.geometry).string(), "Units=" + options.units};
  for (const std::string& constant : options.constants) settings.push_back("Mesh/Constants/" + constant);
  const SceneFile file = parseScene("<ParameterList name=\"Suture\"/>", options.geometry, settingsSchema(), settings);
  SideDescriptions descriptions;
  Mesh mesh = readMesh(*comm, file.parameters->sublist("Mesh"), ".", descriptions);
  const NewScene scene = onRoot(*comm, "reading the groups", [&] {
    NewScene made = propose(mesh, descriptions, options, output);
    write(output, sceneText(made));
    return made;
  });
  if (std::ostream* out = consoleOf(*comm, false)) tell(*out, scene, output, options.unitsGiven);
  return ExitCode::Done;
}

}  // namespace

int main(int argc, char* argv[]) {
  Options options;
  if (const auto end = options.parse(argc, argv)) return *end;
  return runProgram("suture_new", options.geometry, [&](const CommPtr& comm) { return run(comm, options); });
}
