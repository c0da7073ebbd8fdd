#include <suture/base/Errors.hpp>
#include <suture/reader/gmsh/GeoText.hpp>

#include <unistd.h>

#include <cctype>
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

// Replaces comments by blanks; quoted texts stay (names of included files).
std::string withoutComments(const std::string& text) {
  std::string bare;
  bare.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    if (text[i] == '"') {
      const std::size_t end = std::min(text.find('"', i + 1), text.size() - 1);
      bare.append(text, i, end + 1 - i);
      i = end + 1;
    } else if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "/*") == 0) {
      const std::size_t end = text.find("*/", i + 2);
      i = end == std::string::npos ? text.size() : end + 2;
      bare += ' ';
    } else {
      bare += text[i++];
    }
  }
  return bare;
}

bool isWordChar(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

std::size_t skipBlanks(const std::string& text, std::size_t at) {
  while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at]))) ++at;
  return at;
}

std::string wordAt(const std::string& text, std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && isWordChar(text[end])) ++end;
  return text.substr(at, end - at);
}

// Position after the next whole word `word` from `at` on, or npos.
std::size_t behindWord(const std::string& text, const std::string& word, std::size_t at) {
  for (at = text.find(word, at); at != std::string::npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if ((at == 0 || !isWordChar(text[at - 1])) && (end == text.size() || !isWordChar(text[end]))) return end;
  }
  return std::string::npos;
}

// Names in the list after a DefineConstant: "[ a = {1, Min 0}, b ]".
void namesInList(const std::string& text, std::size_t at, std::set<std::string>& names) {
  int depth = 0;
  bool atStart = false;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') {
      at = std::min(text.find('"', at + 1), text.size() - 1);
    } else if (c == '[' || c == '{' || c == '(') {
      atStart = depth++ == 0;
    } else if (c == ']' || c == '}' || c == ')') {
      if (--depth <= 0) return;
    } else if (c == ',' && depth == 1) {
      atStart = true;
    } else if (atStart && isWordChar(c)) {
      const std::string name = wordAt(text, at);
      names.insert(name);
      at += name.size() - 1;
      atStart = false;
    }
  }
}

void collectConstants(const fs::path& path, std::set<std::string>& names, std::set<std::string>& seen) {
  if (!seen.insert(fs::absolute(path).lexically_normal().string()).second) return;
  const std::string text = withoutComments(readText(path.string()));
  for (std::size_t at = behindWord(text, "DefineConstant", 0); at != std::string::npos; at = behindWord(text, "DefineConstant", at))
    namesInList(text, at, names);
  for (std::size_t at = behindWord(text, "Include", 0); at != std::string::npos; at = behindWord(text, "Include", at)) {
    const std::size_t open = skipBlanks(text, at);
    if (open >= text.size() || text[open] != '"') continue;
    const std::size_t close = text.find('"', open + 1);
    if (close != std::string::npos) collectConstants(path.parent_path() / text.substr(open + 1, close - open - 1), names, seen);
  }
}

bool namesOtherFiles(const std::string& text) {
  for (const char* word : {"Include", "Merge", "ShapeFromFile"})
    if (behindWord(text, word, 0) != std::string::npos) return true;
  return false;
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
  } else if (namesOtherFiles(withoutComments(text))) {
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
