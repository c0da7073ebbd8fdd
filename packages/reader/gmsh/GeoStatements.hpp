#pragma once
#include <suture/base/Errors.hpp>

#include <string>
#include <vector>

namespace suture {

/// A piece of a .geo file as Gmsh's own scanner sees it: a comment is none, a text in quotes is one.
struct GeoToken {
  enum class Kind { Word, Text, Number, Sign };
  Kind kind;
  std::string text;  ///< text of a Text without its quotes
  int line;          ///< counted from 1
};

/// Splits the text of a .geo file by the rules of Gmsh's scanner. Local.
/// \throws InputError  where Gmsh's scanner would go astray and take the inside of a text or comment for statements: a text of more than
///                     1,000 letters, an open text or comment, a byte 0
std::vector<GeoToken> geoTokens(const std::string& text, const std::string& file);

/// Refuses what a .geo file has no business to do when it is meshed for a scene: run programs (SystemCall, OnelabRun, a field
/// ExternalProcess, ...), end or hold up the mesher (Exit, Abort, Sleep, ...), write files (Save, Print, Printf > "file"), read the
/// environment or the terminal, and any command that is not known. Other files (Include, Merge, ShapeFromFile) must be named by a literal
/// text, lie in the folder of the .geo file or below, and be CAD files, meshes, or .geo files that pass the same check. Local.
/// \param path  path of the .geo file;  every finding goes to `problems` under "Mesh/File", with file and line
void checkGeoStatements(const std::string& path, Problems& problems);

/// True if Gmsh takes the file for a mesh; it runs any other file as a .geo file, whatever its name. Local.
bool beginsAsMsh(const std::string& path);

}  // namespace suture
