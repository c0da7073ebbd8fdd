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

}  // namespace

std::optional<std::string> meshKey(const MesherOrder& order, const std::map<std::string, double>& constants,
                                   const std::vector<std::string>& files) {
  if (order.allowPrograms || files.empty()) return std::nullopt;
  Packer key;
  key.put(stampOf(mesherProgram()).value_or(FileStamp{}));
  const char* const libraries = std::getenv("LD_LIBRARY_PATH");  // other libraries may be loaded
  key.put(std::string(libraries ? libraries : ""));
  key.put(order.meshSizeFactor);
  key.put(order.order);
  key.put(order.largest);
  key.put(order.scale);
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
