#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/Version.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/ParametersJson.hpp>
#include <suture/report/RunRecord.hpp>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace suture {

namespace {

constexpr std::uintmax_t kLargestSummary = 1u << 30;
constexpr std::size_t kMostDifferences = 20;

Json jsonOf(const UsedFile& file) { return file.path.empty() ? Json() : Json{{"path", file.path}, {"hash", file.hash}}; }

UsedFile usedFileOf(const Json& json) {
  if (json.is_null()) return {};
  return {json.at("path").get<std::string>(), json.at("hash").get<std::string>()};
}

bool isOutputFolder(const std::string& assignment) {
  std::string path = assignment.substr(0, assignment.find('='));
  path.erase(std::remove(path.begin(), path.end(), ' '), path.end());
  return path == "Output/Folder";
}

/// Lists parameters that differ between two runs: "Path/To/Parameter" and both values.
void differences(const Json& then, const Json& now, const std::string& path, Problems& problems) {
  if (path == "Output/Folder" || then == now || problems.list().size() >= kMostDifferences) return;
  if (!then.is_object() || !now.is_object()) {
    const auto told = [](const Json& value) {
      return value.is_discarded() ? std::string("none") : value.dump(-1, ' ', false, Json::error_handler_t::replace);
    };
    problems.add(path, told(now) + " in the scene now, " + told(then) + " in the original run");
    return;
  }
  const Json none(Json::value_t::discarded);
  const auto below = [&](const std::string& name) { return path.empty() ? name : path + "/" + name; };
  for (const auto& [name, value] : then.items()) differences(value, now.contains(name) ? now.at(name) : none, below(name), problems);
  for (const auto& [name, value] : now.items())
    if (!then.contains(name)) differences(none, value, below(name), problems);
}

/// \throws InputError  the run of the summary cannot be repeated
RunRecord recordOf(const std::string& path, const std::string& text) {
  const Json all = Json::parse(text, nullptr, false);
  if (all.is_discarded()) throw InputError(path, "is not JSON; expected the summary.json of a run");
  const Json format = all.is_object() && all.contains("format") ? all.at("format") : Json();
  if (!format.is_object() || format.value("name", Json()) != RunRecord::kName) {
    const bool isOld = all.is_object() && all.contains("converged") && all.contains("mesh_hash") && !all.contains("format");
    throw InputError(path, isOld ? "was written by an earlier version of Suture, which did not record how the run was started; solve the "
                                   "scene with this version first"
                                 : "is not a summary of Suture; expected the summary.json of a run");
  }
  const Json version = format.value("version", Json());
  if (version != RunRecord::kVersion)
    throw InputError(path, "has format " + version.dump() + "; this version of Suture (" + suture::version() + ") reads format " +
                               std::to_string(RunRecord::kVersion) + ": repeat the run with the version that wrote it (" +
                               all.value("versions", Json::object()).value("suture", "unknown") + ")");
  RunRecord run;
  try {
    const Json& record = all.at("record");
    if (all.at("exit_code") == int(ExitCode::Stopped))
      throw InputError(path,
                       "the run was stopped on request and cannot be repeated; continue from its checkpoint.h5 with "
                       "--restart");
    if (record.at("scene").is_null())
      throw InputError(path, "the scene of this run, '" + all.at("scene").get<std::string>() +
                                 "', is not a file; repeat the run with the program that created it");
    run.scene = usedFileOf(record.at("scene"));
    for (const Json& assignment : record.at("overrides"))
      if (!isOutputFolder(assignment.get<std::string>())) run.overrides.push_back(assignment.get<std::string>());
    for (const Json& plugin : record.at("plugins")) run.plugins.push_back(usedFileOf(plugin));
    run.restart = usedFileOf(record.at("restart"));
    run.strict = record.at("strict").get<bool>();
    if (record.contains("material_files"))
      for (const Json& file : record.at("material_files")) run.materialFiles.push_back(usedFileOf(file));
    run.meshHash = all.at("mesh_hash").get<std::string>();
    if (!all.at("parameters").is_object()) throw InputError(path, "'parameters' is not an object");
  } catch (const Json::exception& error) {
    throw InputError(path, std::string("is damaged: ") + error.what());
  }
  return run;
}

}  // namespace

Json recordJson(const SceneFile& scene, const Invocation& invocation) {
  std::error_code ignored;
  const bool isFile = fs::is_regular_file(scene.path, ignored);
  Json plugins = Json::array();
  for (const UsedFile& plugin : invocation.plugins) plugins.push_back(jsonOf(plugin));
  Json record = {{"scene", isFile ? jsonOf({absolutePath(scene.path), hashOf(scene.text)}) : Json()},
                 {"overrides", scene.overrides},
                 {"plugins", plugins},
                 {"restart", jsonOf(invocation.restart)},
                 {"strict", invocation.strict}};
  if (!scene.included.empty()) record["material_files"] = Json::array();
  for (const auto& [path, file] : scene.included) record["material_files"].push_back(jsonOf({absolutePath(path), hashOf(file.text)}));
  return record;
}

std::string RunRecord::folderOfAgain() const { return fs::path(absolutePath(path)).parent_path().string() + "_again"; }

std::vector<std::string> RunRecord::checkFiles() const {
  std::vector<std::string> notes;
  Problems problems;
  const auto hashNow = [&](const UsedFile& file, const std::string& what) {
    try {
      return usedFile(file.path).hash;
    } catch (const InputError& error) {
      problems.add(what, "'" + file.path + "' " + error.problems().front().message);
      return file.hash;
    }
  };
  for (const UsedFile& plugin : plugins)
    if (hashNow(plugin, "--plugin") != plugin.hash) notes.push_back("the plugin '" + plugin.path + "' has changed since the run");
  if (!restart.path.empty() && hashNow(restart, "--restart") != restart.hash)
    problems.add("--restart", "'" + restart.path +
                                  "' has changed since the run started from it. Every run writes checkpoint.h5 into its output folder: "
                                  "use a separate folder for each run");
  problems.throwIfAny();
  return notes;
}

std::vector<std::string> RunRecord::checkScene(const SceneFile& file) const {
  std::vector<std::string> then, now;
  for (const UsedFile& one : materialFiles) then.push_back(one.hash);
  for (const auto& one : file.included) now.push_back(hashOf(one.second.text));
  std::sort(then.begin(), then.end());
  std::sort(now.begin(), now.end());
  if (hashOf(file.text) == scene.hash && then == now) return {};
  Problems problems;
  differences(Json::parse(text).at("parameters"), toJson(*file.parameters), "", problems);
  problems.throwIfAny();
  return {std::string(hashOf(file.text) == scene.hash ? "a material file" : "the scene file") +
          " has changed since the run, but none of its parameters has"};
}

void RunRecord::checkMesh(const std::string& hash) const {
  if (hash == meshHash) return;
  const Json all = Json::parse(text);
  const Json& mesh = all.at("parameters").value("Mesh", Json::object());
  const std::string file = mesh.value("File", Json("")).is_string() ? mesh.value("File", "") : "";
  const std::string gmsh = all.value("versions", Json::object()).value("Gmsh", ""), gmshNow = libraryVersions()["Gmsh"];
  std::string why = "; the mesh of the run cannot be reproduced";
  if (!file.empty())
    why = gmsh != gmshNow ? "; '" + file + "' was read with Gmsh " + gmsh + " in the run, with " + gmshNow + " now"
                          : "; '" + file + "', or a file that it includes, has changed";
  throw InputError("Mesh", "is not the mesh of the run (hash " + hash + " now, " + meshHash + " then)" + why);
}

RunRecord readRunRecord(const Comm& comm, const std::string& path) {
  std::string text, file = path;
  collectivelyOnRoot(comm, "reading " + path, [&] {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) file = (fs::path(path) / "summary.json").string();
    if (const auto size = fs::file_size(file, ignored); !ignored && size > kLargestSummary)
      throw InputError(file, "has " + std::to_string(size) + " bytes; expected the summary.json of a run");
    text = bytesOfFile(file, "the summary.json of a run");
  });
  text = broadcast(comm, text);
  file = broadcast(comm, file);
  RunRecord record = recordOf(file, text);  // throws the same on all ranks
  record.path = file;
  record.text = text;
  return record;
}

}  // namespace suture
