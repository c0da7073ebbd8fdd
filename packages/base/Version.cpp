#include "Version.hpp"

#include <mpi.h>
#include <Commit.hpp>  // written by cmake/Version.cmake in every build
#include <Eigen/Core>
#include <Libraries.hpp>

#include <suture/base/hdf5/Hdf5Library.hpp>
#include "Expression.hpp"

namespace suture {
namespace {

/// "Open MPI v4.1.4" of "Open MPI v4.1.4, package: Debian OpenMPI, ident: ...".
std::string mpiVersion() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING];
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string all(text, length);
  return all.substr(0, all.find_first_of(",\n"));
}

std::string eigenVersion() {
  return std::to_string(EIGEN_WORLD_VERSION) + "." + std::to_string(EIGEN_MAJOR_VERSION) + "." + std::to_string(EIGEN_MINOR_VERSION);
}

std::string compilerVersion() {
#if defined(__clang__)
  return "Clang " __clang_version__;
#elif defined(__GNUC__)
  return "GCC " __VERSION__;
#else
  return "unknown";
#endif
}

}  // namespace

std::string version() { return SUTURE_VERSION; }

std::string commit() { return SUTURE_COMMIT; }

std::map<std::string, std::string> libraryVersions() {
  return {{"Trilinos", SUTURE_TRILINOS_VERSION},
          {"MPI", mpiVersion()},
          {"HDF5", hdf5::libraryVersion()},
          {"CHOLMOD", SUTURE_CHOLMOD_VERSION},
          {"METIS", SUTURE_METIS_VERSION},
          {"Gmsh", SUTURE_GMSH_VERSION},
          {"Eigen", eigenVersion()},
          {"muParser", Expression::libraryVersion()},
          {"compiler", compilerVersion()}};
}

}  // namespace suture
