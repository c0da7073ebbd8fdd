#include <suture/base/Buffer.hpp>
#include <suture/base/Errors.hpp>
#include <suture/reader/cad/CadFile.hpp>
#include <suture/reader/gmsh/GeoStatements.hpp>
#include <suture/reader/gmsh/MeshKey.hpp>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace suture {

namespace {

/// Words of a .geo file whose value is not determined by the files.
const std::set<std::string> kVolatile = {"AbsolutePath",       "Cpu",        "CurrentDir",      "CurrentDirectory",
                                         "CurrentFileName",    "FileExists", "FixRelativePath", "Rand",
                                         "GmshExecutableName", "Memory",     "Today",           "TotalMemory"};

bool isVolatile(const std::string& text, const std::string& file) {
  const std::vector<GeoToken> tokens = geoTokens(text, file);
  return std::any_of(tokens.begin(), tokens.end(),
                     [](const GeoToken& token) { return token.kind == GeoToken::Kind::Word && kVolatile.count(token.text) > 0; });
}

/// True if the parts of an assembly are in other files (ISO 10303-21: entities DOCUMENT_FILE).
bool refersToFiles(const std::string& step) { return step.find("DOCUMENT_FILE") != std::string::npos; }

/// Folders of LD_LIBRARY_PATH from which another Gmsh may be loaded. The other ones may differ between runs, such as that of mpirun.
std::string otherGmsh() {
  const char* const all = std::getenv("LD_LIBRARY_PATH");
  std::istringstream folders(all ? all : "");
  std::string found;
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::error_code failure;
    for (std::filesystem::directory_iterator file(folder, failure), end; !failure && file != end; file.increment(failure))
      if (file->path().filename().string().rfind("libgmsh", 0) == 0) {
        found += folder + ":";
        break;
      }
  }
  return found;
}

}  // namespace

std::optional<std::string> meshKey(const MesherOrder& order, const std::map<std::string, double>& constants,
                                   const std::vector<std::string>& files) {
  if (order.allowPrograms || files.empty()) return std::nullopt;
  Packer key;
  key.put(stampOf(mesherProgram()).value_or(FileStamp{}));
  key.put(otherGmsh());
  key.put(order.meshSizeFactor);
  key.put(order.order);
  key.put(order.largest);
  key.put(order.scale);
  key.put(order.simplices);
  key.put(order.sizes ? *order.sizes : SizeField{});
  key.put(constants);
  const std::filesystem::path folder = std::filesystem::path(files.front()).parent_path();
  for (const std::string& file : files) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream content;
    content << in.rdbuf();
    if (!in) return std::nullopt;
    const std::string text = content.str();
    if (cadFormat(file) == CadFormat::Step && refersToFiles(text)) return std::nullopt;
    if (std::filesystem::path(file).extension() == ".geo" && isVolatile(text, file)) return std::nullopt;
    key.put(std::filesystem::path(file).lexically_relative(folder).string());
    key.put(text);
  }
  return std::move(key).bytes();
}

}  // namespace suture
