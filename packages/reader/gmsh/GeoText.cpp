#include <suture/base/Errors.hpp>
#include <suture/reader/gmsh/GeoStatements.hpp>
#include <suture/reader/gmsh/GeoText.hpp>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace suture {

namespace {

namespace fs = std::filesystem;

std::string readText(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// Names in the list after a DefineConstant: "[ a = {1, Min 0}, b ]".
void namesInList(const std::vector<GeoToken>& tokens, std::size_t at, std::set<std::string>& names) {
  int depth = 0;
  bool atStart = false;
  for (; at < tokens.size(); ++at) {
    const auto& [kind, text, line] = tokens[at];
    if (kind == GeoToken::Kind::Sign) {
      if (text == "[" || text == "{" || text == "(") atStart = depth++ == 0;
      if ((text == "]" || text == "}" || text == ")") && --depth <= 0) return;
      if (text == "," && depth == 1) atStart = true;
    } else if (atStart && kind == GeoToken::Kind::Word) {
      names.insert(text);
      atStart = false;
    }
  }
}

void collectConstants(const fs::path& path, std::set<std::string>& names, std::set<std::string>& seen) {
  if (!seen.insert(fs::absolute(path).lexically_normal().string()).second) return;
  const std::vector<GeoToken> tokens = geoTokens(readText(path.string()), path.string());
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (tokens[i].kind != GeoToken::Kind::Word) continue;
    if (tokens[i].text == "DefineConstant") namesInList(tokens, i + 1, names);
    if (tokens[i].text == "Include" && tokens[i + 1].kind == GeoToken::Kind::Text)
      collectConstants(path.parent_path() / tokens[i + 1].text, names, seen);
  }
}

bool namesOtherFiles(const std::vector<GeoToken>& tokens) {
  return std::any_of(tokens.begin(), tokens.end(), [](const GeoToken& token) {
    return token.kind == GeoToken::Kind::Word &&
           (token.text == "Include" || token.text == "Merge" || token.text == "MergeWithBoundingBox" || token.text == "ShapeFromFile");
  });
}

std::string writeTemporary(const std::string& text) {
  std::error_code failed;
  fs::path folder = fs::temp_directory_path(failed);
  if (failed) folder = "/tmp";
  const std::string letters(6, 'X'), suffix = ".geo";  // mkstemps replaces these six X
  std::string path = (folder / ("suture-" + letters + suffix)).string();
  const int file = mkstemps(path.data(), static_cast<int>(suffix.size()));
  if (file < 0) throw EnvironmentError("cannot write a temporary file in " + folder.string() + " for Gmsh: " + std::strerror(errno));
  close(file);
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) {
    fs::remove(path, failed);
    throw EnvironmentError("cannot write " + path + " for Gmsh");
  }
  return path;
}

}  // namespace

std::vector<std::string> geoConstants(const std::string& path) {
  std::set<std::string> names, seen;
  collectConstants(path, names, seen);
  return {names.begin(), names.end()};
}

GeoWrapper::GeoWrapper(const std::string& path, const std::map<std::string, double>& constants) : path_(path) {
  const std::string text = readText(path);
  const bool complete = !text.empty() && text.back() == '\n';
  if (complete && constants.empty()) return;

  // Constants go on the first line: where the text of the file is copied, the line numbers in Gmsh's messages stay correct.
  std::string wrapper;
  for (const auto& [name, value] : constants) {
    char number[40];
    std::snprintf(number, sizeof number, "%.17g", value);
    wrapper += name + " = " + number + "; ";
  }
  if (complete) {
    wrapper += "Include \"" + fs::absolute(path).string() + "\";\n";
  } else if (namesOtherFiles(geoTokens(text, path))) {
    throw InputError("Mesh/File", path + ": the last line has no newline, and Gmsh would drop it; end the file with an empty line");
  } else {
    wrapper += text + "\n";
  }
  path_ = writeTemporary(wrapper);
  temporary_ = true;
}

GeoWrapper::~GeoWrapper() {
  std::error_code ignored;
  if (temporary_) fs::remove(path_, ignored);
}

}  // namespace suture
