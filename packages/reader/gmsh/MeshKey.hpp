#pragma once
#include <suture/reader/gmsh/MesherProcess.hpp>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace suture {

/// Everything that determines the mesh that Gmsh makes of a .geo or CAD file, suture_mesher included: the content of all files, the
/// constants, and the options of `order` that change the mesh. Nothing if the mesh may depend on something else: a file that may run
/// programs, a statement that reads the clock, the folder or a random number, a STEP file that refers to other files. Local. \param files
/// the file and all those that it reads, see checkGeoStatements()
std::optional<std::string> meshKey(const MesherOrder& order, const std::map<std::string, double>& constants,
                                   const std::vector<std::string>& files);

}  // namespace suture
