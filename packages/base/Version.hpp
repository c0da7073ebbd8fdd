#pragma once
#include <map>
#include <string>

namespace suture {

std::string version();  ///< "1.0.0"
std::string commit();   ///< short commit of the build, "unknown" outside a git checkout, with "+" if the tree has uncommitted changes

/// Library -> version, as linked: Trilinos, MPI, HDF5, CHOLMOD, METIS, Gmsh (or "not built in"), Eigen, compiler.
std::map<std::string, std::string> libraryVersions();

}  // namespace suture
