#include "SceneReader.hpp"

#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include "SceneResolver.hpp"

namespace suture {
namespace {

const char* const arrow = "->";  // Teuchos' separator between the names of nested lists

constexpr std::uintmax_t largestFile = 16u << 20;  // bytes; Suture's largest scene has 9,000

/// Hint for a file whose extension is that of a geometry or a mesh; "" for others.
std::string hintFor(const std::string& path) {
  std::string end = std::filesystem::path(path).extension().string();
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
  for (const char* known : {".geo", ".msh", ".h5"})
    if (end == known) return "is a geometry or a mesh, not a scene; 'suture_new " + path + "' writes a scene that names it in Mesh/File";
  return "";
}

std::string readFile(const std::string& path) {
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) throw InputError(path, "is a folder; expected an XML file");
  if (std::filesystem::exists(path, ignored)) {
    if (const std::string hint = hintFor(path); !hint.empty()) throw InputError(path, hint);
    // A pipe or a device may never end.
    if (!std::filesystem::is_regular_file(path, ignored)) throw InputError(path, "is not a regular file; expected an XML file");
    if (const auto size = std::filesystem::file_size(path, ignored); !ignored && size > largestFile)
      throw InputError(path, "has " + std::to_string(size) + " bytes; expected an XML file of at most " + std::to_string(largestFile));
  }
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) throw InputError(path, std::string("cannot be read: ") + std::strerror(errno != 0 ? errno : ENOENT));
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad() || (text.fail() && file.peek() != std::ifstream::traits_type::eof())) throw InputError(path, "cannot be read to its end");
  return text.str();
}

/// Reads files that are not known yet, and keeps them.
SceneCompletion::Reader readerInto(IncludedFiles& files) {
  return [&files](const std::string& path) -> const IncludedFile& {
    const auto known = files.find(path);
    if (known != files.end()) return known->second;
    IncludedFile& file = files[path];
    try {
      file.text = readFile(path);
    } catch (const InputError& error) {
      file.failure = error.problems().front().message;
    }
    return file;
  };
}

std::string folderOf(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// Files that complete a scene, read by this process; errors are found again when the scene is parsed.
IncludedFiles filesFor(const std::string& text, const std::string& path, const Schema& schema, const std::vector<std::string>& overrides) {
  IncludedFiles files;
  Problems problems;
  std::vector<std::string> notes;
  RawList tree = parseTree(text, path, problems);
  for (const std::string& assignment : overrides) applyOverride(tree, assignment, problems);
  schema.completion()->complete(tree, folderOf(path), readerInto(files), problems, notes);
  return files;
}

}  // namespace

SceneFile readScene(const Comm& comm, const std::string& path, const Schema& schema, const std::vector<std::string>& overrides) {
  std::string text;
  collectivelyOnRoot(comm, "reading " + path, [&] { text = readFile(path); });
  text = broadcast(comm, text);
  IncludedFiles included;
  if (schema.completion() && comm.getSize() > 1) {
    Packer packer;
    collectivelyOnRoot(comm, "reading the files of " + path, [&] { packer.put(filesFor(text, path, schema, overrides)); });
    Unpacker(broadcast(comm, packer.bytes())).get(included);
  }
  // Every rank checks the same texts: all ranks throw the same error, or none does, and no rank waits.
  return parseScene(text, path, schema, overrides, std::nullopt, included);
}

SceneFile parseScene(const std::string& text, const std::string& path, const Schema& schema, const std::vector<std::string>& overrides,
                     const std::optional<std::string>& folder, const IncludedFiles& included) {
  Problems problems;
  RawList tree = parseTree(text, path, problems);
  if (tree.parameters.empty() && tree.lists.empty() && !problems.empty()) {  // not XML: do not report missing parameters as well
    if (const std::string hint = hintFor(path); !hint.empty()) throw InputError(path, hint);
    problems.throwIfAny();
  }
  for (const std::string& assignment : overrides) applyOverride(tree, assignment, problems);

  SceneFile scene;
  scene.path = path;
  scene.folder = folder.value_or(folderOf(path));
  scene.text = text;
  scene.overrides = overrides;
  scene.parameters = Teuchos::rcp(new Parameters(tree.name.empty() ? "Suture" : tree.name));
  scene.included = included;
  std::vector<std::string> notes;
  if (schema.completion()) schema.completion()->complete(tree, scene.folder, readerInto(scene.included), problems, notes);
  scene.notes = resolve(tree, schema, *scene.parameters, problems);
  scene.notes.insert(scene.notes.end(), notes.begin(), notes.end());
  problems.throwIfAny();
  return scene;
}

std::string pathOf(const Parameters& list, const std::string& parameter) {
  const std::string name = list.name();
  std::string path;
  // The first name is that of the whole scene and is left out.
  for (std::size_t at = name.find(arrow); at != std::string::npos;) {
    const std::size_t begin = at + 2;
    at = name.find(arrow, begin);
    path = joinPath(path, name.substr(begin, at == std::string::npos ? at : at - begin));
  }
  return joinPath(path, parameter);
}

std::vector<std::string> sublistNames(const Parameters& list) {
  std::vector<std::string> names;
  for (auto entry = list.begin(); entry != list.end(); ++entry) {
    if (list.isSublist(list.name(entry))) names.push_back(list.name(entry));
  }
  return names;
}

}  // namespace suture
