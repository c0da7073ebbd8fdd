#pragma once
#include <suture/base/Errors.hpp>

#include <string>
#include <vector>

namespace suture {

/// Token of a .geo file as Gmsh's own scanner sees it. A comment is no token; a quoted text is one token.
struct GeoToken {
  enum class Kind { Word, Text, Number, Sign };
  Kind kind;
  std::string text;  ///< text of a Text without its quotes
  int line;          ///< counted from 1
};

/// Splits a .geo file into tokens by the rules of Gmsh's scanner. Local.
/// \throws InputError  where Gmsh's scanner would take the inside of a text or comment for statements: a text of more than 1,000
///                     characters, an unterminated text or comment, a zero byte
std::vector<GeoToken> geoTokens(const std::string& text, const std::string& file);

/// Refuses statements that meshing a scene does not need: run programs (SystemCall, OnelabRun, a field ExternalProcess, ...), end or hold
/// up the mesher (Exit, Abort, Sleep, ...), write files (Save, Print, Printf > "file"), read the environment or the terminal, and any
/// unknown command. Other files (Include, Merge, ShapeFromFile) must be named by a literal text, lie in the folder of the .geo file or
/// below, and be CAD files, meshes, or .geo files that pass the same check. Local.
/// \param path  path of the .geo file; every finding is added to `problems` under "Mesh/File", with file and line
/// \return the file and all files that it reads, in the order of their first names
std::vector<std::string> checkGeoStatements(const std::string& path, Problems& problems);

/// True if Gmsh reads the file as a mesh; Gmsh runs any other file as a .geo file, regardless of its name. Local.
bool beginsAsMsh(const std::string& path);

}  // namespace suture
