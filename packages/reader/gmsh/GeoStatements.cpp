#include <suture/reader/gmsh/GeoStatements.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

namespace suture {

namespace {

namespace fs = std::filesystem;

const char* const path = "Mesh/File";
constexpr std::size_t longestText = 1000;  // Gmsh cuts a text after 1,023 characters and continues reading behind the cut

const char* const runs = "runs a program";
const char* const ends = "ends or holds up the mesher";
const char* const writes = "writes a file";
const char* const asks = "reads the environment, the terminal or another file";

/// Words that are refused wherever they occur.
const std::map<std::string, std::string> refused = {
    {"SystemCall", runs},
    {"System", runs},
    {"NonBlockingSystemCall", runs},
    {"OnelabRun", runs},
    {"OnelabAction", runs},
    {"ExternalProcess", runs},
    {"CommandLine", runs},
    {"Plugin", "runs a plugin of Gmsh"},
    {"Solver", "sets programs that Gmsh may run"},
    {"Exit", ends},
    {"Abort", ends},
    {"Sleep", ends},
    {"Save", writes},
    {"Print", writes},
    {"CreateDir", writes},
    {"GetEnv", asks},
    {"GetString", asks},
    {"GetValue", asks},
    {"ListFromFile", asks},
    {"FileName", asks},
    {"WatchFilePattern", asks},
};

std::set<std::string> wordsOf(const std::string& text) {
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), std::istream_iterator<std::string>()};
}

/// Words that may begin a command, or precede another word, a text or a number. Gmsh takes any other word there for the name of a
/// command.
const std::set<std::string> harmless = wordsOf(
    "AdaptMesh Affine Alias AliasWithOptions Alternate Attractor BSpline Background Bezier Block BooleanCoherence "
    "BooleanCommon BooleanCut BooleanDifference BooleanFragments BooleanFuse BooleanIntersection BooleanSection BooleanUnion "
    "Boundary BoundaryLayer BoundingBox Box Bump Call CatmullRom Chamfer Characteristic Circle ClassifySurfaces Closed "
    "CodeName Coherence Cohomology Color Combine CombinedBoundary Compound Cone Coordinates CreateGeometry CreateTopology "
    "Curve Cylinder DefineConstant DefineNumber DefineString Degenerated Delete Dilate Disk Draw Duplicata Ellipse Ellipsis "
    "Ellipsoid Elliptic Else ElseIf EndFor EndIf Error Euclidian Extrude Field Fillet For Function HealShapes Hide Hole "
    "Homology If In Include Intersect Knots Layers Length Line Loop Macro Merge MergeWithBoundingBox Mesh MeshAlgorithm "
    "MeshSize MeshSizeFromBoundary Model NameStruct NewModel Nurbs OptimizeMesh Options Order Parametric Parent PartitionMesh "
    "Periodic Physical Physicals Plane Point PointsOf Printf Progression QuadTriAddVerts QuadTriNoNewVerts RecombLaterals "
    "Recombine RecombineMesh Rectangle Recursive RefineMesh RelocateMesh RenumberMeshElements RenumberMeshNodes ReorientMesh "
    "Return Reverse ReverseMesh Rotate Ruled ScaleLastLayer SetChanged SetFactory SetMaxTag SetName SetNumber SetOrder "
    "SetPartition SetString SetTag Sewing ShapeFromFile Show Smoother Sphere Spline Split Struct Surface Symmetry SyncModel "
    "ThickSolid ThruSections Torus TransfQuadTri Transfinite TransformMesh Translate UndefineConstant Unique Using Variables "
    "View Volume Warning Wedge Wire ");

/// Endings of files that Gmsh reads as geometry or meshes; Gmsh may run a file with any other name as a .geo file.
const std::set<std::string> cadFiles = {".step", ".stp", ".iges", ".igs", ".brep", ".stl",
                                        ".STEP", ".STP", ".IGES", ".IGS", ".BREP", ".STL"};

bool isLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)); }

std::string textOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// Checks the statements of a file and of the files that it includes.
class Checker {
 public:
  Checker(fs::path root, Problems& problems) : root_(std::move(root)), problems_(problems) {}

  const std::vector<std::string>& files() const { return files_; }

  void check(const fs::path& file) {
    if (!read(file)) return;
    std::vector<GeoToken> tokens;
    try {
      tokens = geoTokens(textOf(file), file.string());
    } catch (const InputError& error) {
      problems_.add(error);
      return;
    }
    int depth = 0;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
      const GeoToken& token = tokens[i];
      if (token.kind == GeoToken::Kind::Sign) {
        if (token.text == "{" || token.text == "[" || token.text == "(") ++depth;
        if (token.text == "}" || token.text == "]" || token.text == ")") depth = std::max(0, depth - 1);
      }
      if (token.kind == GeoToken::Kind::Word) checkWord(file, tokens, i, depth);
    }
  }

 private:
  /// Adds a file to those that are read. \return false if it is among them
  bool read(const fs::path& file) {
    if (!seen_.insert(file.string()).second) return false;
    files_.push_back(file.string());
    return true;
  }

  void refuse(const fs::path& file, const GeoToken& token, const std::string& why) {
    problems_.add(path, file.string() + ", line " + std::to_string(token.line) + ": '" + token.text + "' " + why);
  }

  static bool isSign(const std::vector<GeoToken>& tokens, std::size_t i, const std::string& sign) {
    return i < tokens.size() && tokens[i].kind == GeoToken::Kind::Sign && tokens[i].text == sign;
  }

  void checkWord(const fs::path& file, const std::vector<GeoToken>& tokens, std::size_t i, int depth) {
    const GeoToken& token = tokens[i];
    const std::string& word = token.text;
    const std::string hint = "; refused unless Mesh/Allow Programs is true";
    if (const auto found = refused.find(word); found != refused.end()) {
      const bool isOption = word == "Print" && isSign(tokens, i + 1, ".");  // an option of pictures: writes nothing
      if (!isOption) refuse(file, token, found->second + hint);
      return;
    }
    if (word == "Include" || word == "Merge" || word == "MergeWithBoundingBox" || word == "ShapeFromFile") {
      checkOtherFile(file, tokens, i, hint);
      return;
    }
    if (word == "Printf" || word == "Error" || word == "Warning") checkRedirection(file, tokens, i, hint);
    if (depth > 0 || harmless.count(word) > 0 || i + 1 >= tokens.size()) return;
    const GeoToken& next = tokens[i + 1];
    if (next.kind == GeoToken::Kind::Sign || (next.kind == GeoToken::Kind::Word && next.text == "In")) return;
    static const std::set<std::string> beforeName = {"Macro", "Function", "Call"};
    if (i > 0 && beforeName.count(tokens[i - 1].text) > 0) return;
    refuse(file, token, "is not known to be a harmless command" + suggestedCommand(word) + hint);
  }

  static std::string suggestedCommand(const std::string& word) {
    const std::string near = nearestName(word, {harmless.begin(), harmless.end()});
    return near.empty() ? "" : " (did you mean '" + near + "'?)";
  }

  // Printf("...") > "file": a sign > after the bracket that closes the list.
  void checkRedirection(const fs::path& file, const std::vector<GeoToken>& tokens, std::size_t i, const std::string& hint) {
    int depth = 0;
    for (std::size_t k = i + 1; k < tokens.size() && !(depth == 0 && isSign(tokens, k, ";")); ++k) {
      if (tokens[k].kind != GeoToken::Kind::Sign) continue;
      const std::string& sign = tokens[k].text;
      if (sign == "(" || sign == "[" || sign == "{") ++depth;
      if (sign == ")" || sign == "]" || sign == "}") --depth;
      if (depth <= 0 && sign == ">") {
        refuse(file, tokens[i], std::string("with '>' ") + writes + hint);
        return;
      }
    }
  }

  void checkOtherFile(const fs::path& file, const std::vector<GeoToken>& tokens, std::size_t i, const std::string& hint) {
    const GeoToken& token = tokens[i];
    std::size_t at = i + 1;
    while (isSign(tokens, at, "(") || isSign(tokens, at, "[")) ++at;
    if (at >= tokens.size() || tokens[at].kind != GeoToken::Kind::Text) {
      refuse(file, token, "without the literal name of a file, expected as in " + token.text + " \"part.geo\"" + hint);
      return;
    }
    const fs::path name = tokens[at].text;
    const fs::path other = (file.parent_path() / name).lexically_normal();
    std::error_code failed;
    const fs::path real = fs::weakly_canonical(other, failed), inside = fs::weakly_canonical(root_, failed);
    const fs::path relative = real.lexically_relative(inside);
    if (name.is_absolute() || failed || relative.empty() || *relative.begin() == "..") {
      refuse(file, token, "\"" + name.string() + "\" is outside the folder " + root_.string() + hint);
    } else if (!fs::is_regular_file(real, failed)) {
      refuse(file, token, "\"" + name.string() + "\": there is no such file");
    } else if (cadFiles.count(name.extension().string()) > 0 || beginsAsMsh(real.string())) {
      read(other);
    } else {
      if (name.extension() != ".geo")
        refuse(file, token,
               "\"" + name.string() + "\" is neither a .geo file nor a mesh nor one of " + joinNames({cadFiles.begin(), cadFiles.end()}) +
                   hint);
      else
        check(other);
    }
  }

  fs::path root_;
  Problems& problems_;
  std::set<std::string> seen_;
  std::vector<std::string> files_;  // as in seen_, in the order of their first names
};

}  // namespace

std::vector<GeoToken> geoTokens(const std::string& text, const std::string& file) {
  std::vector<GeoToken> tokens;
  int line = 1;
  const auto wrong = [&](const std::string& what) { throw InputError(path, file + ", line " + std::to_string(line) + ": " + what); };
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
    line += static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n'));
    wrong("a zero byte; expected a text file");
  }
  for (std::size_t i = 0; i < text.size();) {
    const char c = text[i];
    const std::size_t begin = i;
    if (c == '\n') {
      ++line;
      ++i;
    } else if (std::isspace(static_cast<unsigned char>(c))) {
      ++i;
    } else if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "/*") == 0) {
      const std::size_t end = text.find("*/", i + 2);
      if (end == std::string::npos) wrong("an unterminated comment; expected */");
      line += static_cast<int>(
          std::count(text.begin() + static_cast<std::ptrdiff_t>(i), text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = end + 2;
    } else if (c == '"' || c == '\'') {
      const std::size_t end = text.find(c, i + 1);
      if (end == std::string::npos) wrong(std::string("an unterminated text; expected ") + c);
      if (end - i > longestText)
        wrong("a text of " + std::to_string(end - i - 1) + " characters; expected at most " + std::to_string(longestText));
      tokens.push_back({GeoToken::Kind::Text, text.substr(i + 1, end - i - 1), line});
      line += static_cast<int>(
          std::count(text.begin() + static_cast<std::ptrdiff_t>(i), text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      i = end + 1;
    } else if (isLetter(c)) {
      while (i < text.size() && (isLetter(text[i]) || isDigit(text[i]))) ++i;
      tokens.push_back({GeoToken::Kind::Word, text.substr(begin, i - begin), line});
    } else if (isDigit(c)) {
      while (i < text.size() && isDigit(text[i])) ++i;
      if (i < text.size() && text[i] == '.')
        for (++i; i < text.size() && isDigit(text[i]);) ++i;
      if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
        std::size_t end = i + 1;
        if (end < text.size() && (text[end] == '+' || text[end] == '-')) ++end;
        if (end < text.size() && isDigit(text[end])) {
          while (end < text.size() && isDigit(text[end])) ++end;
          i = end;
        }
      }
      tokens.push_back({GeoToken::Kind::Number, text.substr(begin, i - begin), line});
    } else {
      tokens.push_back({GeoToken::Kind::Sign, std::string(1, c), line});
      ++i;
    }
  }
  return tokens;
}

std::vector<std::string> checkGeoStatements(const std::string& file, Problems& problems) {
  const fs::path folder = fs::path(file).parent_path();
  Checker checker(folder.empty() ? fs::path(".") : folder, problems);
  checker.check(file);
  return checker.files();
}

bool beginsAsMsh(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  std::string begin(11, '\0');
  in.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  for (const std::string mark : {"$MeshFormat", "$Comments", "$PARA", "$ELM", "$PTS", "$NO"})
    if (begin.compare(0, mark.size(), mark) == 0) return true;
  return false;
}

}  // namespace suture
