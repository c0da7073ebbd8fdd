#include <suture/reader/cad/CadFile.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>

namespace suture {

namespace {

std::string textOf(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool beginsWith(const std::string& text, const std::string& word) {
  const std::size_t at = text.find_first_not_of(" \t\r\n");
  return at != std::string::npos && text.compare(at, word.size(), word) == 0;
}

const std::string cutOff = "is cut off: ";

std::string stepProblem(const std::string& text) {
  if (!beginsWith(text, "ISO-10303-21;")) return "is not a STEP file: it does not begin with ISO-10303-21";
  if (text.rfind("END-ISO-10303-21") == std::string::npos) return cutOff + "the last line, END-ISO-10303-21, is missing";
  return "";
}

// Lines of 80 characters; column 73 names the section: S, G, D, P, and one line T.
std::string igesProblem(const std::string& text) {
  constexpr std::size_t kColumn = 72;
  char first = 0, last = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    if (end - begin > kColumn) {
      last = text[begin + kColumn];
      if (first == 0) first = last;
    }
    begin = end + 1;
  }
  if (first != 'S' && first != 'C' && first != 'B') return "is not an IGES file: its first line has no S in column 73";
  return last == 'T' ? "" : cutOff + "the last line, the terminate section (T in column 73), is missing";
}

std::string stlProblem(const std::string& text) {
  constexpr std::size_t kHead = 84, kFacet = 50;
  std::uint32_t facets = 0;
  if (text.size() >= kHead) std::memcpy(&facets, text.data() + 80, sizeof facets);
  const bool isBinary = text.size() >= kHead && text.size() == kHead + kFacet * std::size_t(facets);
  if (isBinary) return "";
  if (beginsWith(text, "solid") && text.find("facet") != std::string::npos)
    return text.rfind("endsolid") == std::string::npos ? cutOff + "the last line, endsolid, is missing" : "";
  if (text.size() >= kHead && text.size() < kHead + kFacet * std::size_t(facets) && !beginsWith(text, "solid"))
    return "is not an STL file, or is cut off: " + std::to_string(facets) + " triangles are announced, but the file has bytes for " +
           std::to_string((text.size() - kHead) / kFacet);
  return "is not an STL file: it has neither the word 'solid' nor the size of a binary file";
}

std::string brepProblem(const std::string& text) {
  if (text.find("CASCADE Topology V") == std::string::npos) return "is not a BREP file of OpenCASCADE: it has no line 'CASCADE Topology'";
  // The last section lists the shapes; the last line but one is "*", the last one the main shape.
  const std::size_t shapes = text.rfind("TShapes ");
  if (shapes == std::string::npos) return cutOff + "the section TShapes is missing";
  const std::size_t announced = std::strtoull(text.c_str() + shapes + 8, nullptr, 10);
  std::size_t found = 0;
  for (std::size_t at = text.find("\n*", shapes); at != std::string::npos; at = text.find("\n*", at + 1)) ++found;
  for (std::size_t at = text.find(" *\n", shapes); at != std::string::npos; at = text.find(" *\n", at + 1)) ++found;
  return found >= announced ? ""
                            : cutOff + "its last section has " + std::to_string(found) + " of " + std::to_string(announced) + " shapes";
}

}  // namespace

const std::vector<std::string>& cadEndings() {
  static const std::vector<std::string> endings{".step", ".stp", ".iges", ".igs", ".brep", ".stl"};
  return endings;
}

CadFormat cadFormat(const std::string& path) {
  static const std::map<std::string, CadFormat> known{{".step", CadFormat::Step}, {".stp", CadFormat::Step},  {".iges", CadFormat::Iges},
                                                      {".igs", CadFormat::Iges},  {".brep", CadFormat::Brep}, {".stl", CadFormat::Stl},
                                                      {".STEP", CadFormat::Step}, {".STP", CadFormat::Step},  {".IGES", CadFormat::Iges},
                                                      {".IGS", CadFormat::Iges},  {".BREP", CadFormat::Brep}, {".STL", CadFormat::Stl}};
  const std::size_t dot = path.find_last_of("./");
  if (dot == std::string::npos) return CadFormat::None;
  const auto at = known.find(path.substr(dot));
  return at == known.end() ? CadFormat::None : at->second;
}

std::string cadFileProblem(const std::string& path) {
  const std::string text = textOf(path);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) return "is empty";
  switch (cadFormat(path)) {
    case CadFormat::Step:
      return stepProblem(text);
    case CadFormat::Iges:
      return igesProblem(text);
    case CadFormat::Brep:
      return brepProblem(text);
    case CadFormat::Stl:
      return stlProblem(text);
    case CadFormat::None:
      break;
  }
  return "";
}

std::size_t solidsDefinedIn(const std::string& path) {
  if (cadFormat(path) != CadFormat::Step) return 0;
  const std::string text = textOf(path);
  std::size_t count = 0;
  for (const std::string word : {"MANIFOLD_SOLID_BREP", "FACETED_BREP", "BREP_WITH_VOIDS"})
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      // "#12 = WORD(": not inside a longer word or a list of several types, which would count twice.
      const std::size_t before = text.find_last_not_of(" \t\r\n", at == 0 ? 0 : at - 1),
                        after = text.find_first_not_of(" \t\r\n", at + word.size());
      if (before != std::string::npos && text[before] == '=' && after != std::string::npos && text[after] == '(') ++count;
    }
  return count;
}

}  // namespace suture
