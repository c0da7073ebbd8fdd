#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace suture {

/// Format of a CAD file.
enum class CadFormat { None, Step, Iges, Brep, Stl };

/// Format by the ending of the name, in lower or upper case; None for any other file. Local.
CadFormat cadFormat(const std::string& path);

/// ".step", ".stp", ...: all endings.
const std::vector<std::string>& cadEndings();

/// True if a file carries a unit of length, which OpenCASCADE converts: STEP and IGES.
inline bool hasLengthUnit(CadFormat format) { return format == CadFormat::Step || format == CadFormat::Iges; }

/// Reason why a file is not a complete file of its format, from its first and last lines: empty, another format, cut off. OpenCASCADE
/// reads the rest of such a file without a message. "" if the file looks complete. Local.
std::string cadFileProblem(const std::string& path);

/// Number of solids that a STEP file defines; an assembly may use a solid several times. 0 for other formats. Local.
std::size_t solidsDefinedIn(const std::string& path);

}  // namespace suture
