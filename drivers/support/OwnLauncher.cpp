#include "OwnLauncher.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <suture/base/Errors.hpp>
#include <vector>

#include "MpiStart.hpp"

namespace suture {

namespace {

bool isProgram(const std::string& path) { return access(path.c_str(), X_OK) == 0 && !std::filesystem::is_directory(path); }

std::string findInPath(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (const std::string file = (folder.empty() ? "." : folder) + "/" + name; isProgram(file)) return file;
  return std::string();
}

std::string findLauncher() {
  const std::string built = SUTURE_MPIEXEC;
  if (isProgram(built)) return built;
  for (const char* name : {"mpirun", "mpiexec"})
    if (std::string file = findInPath(name); !file.empty()) return file;
  throw EnvironmentError("--ranks needs mpirun: there is none at " + built +
                         " or in PATH; install it (Debian: apt-get install openmpi-bin)");
}

// This program; argv[0] may be a name that is found in PATH.
std::string ownPath(const char* name) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::read_symlink("/proc/self/exe", error);
  return error ? std::string(name) : path.string();
}

void setUnlessSet(const char* name, const char* value) { setenv(name, value, 0); }

void allowOnThisMachine() {
  setUnlessSet("OMPI_MCA_rmaps_base_oversubscribe", "1");
  setUnlessSet("OMPI_MCA_hwloc_base_binding_policy", "none");
  setUnlessSet("OMPI_MCA_btl_vader_single_copy_mechanism", "none");
  setUnlessSet("OMPI_MCA_orte_execute_quiet", "1");
  if (geteuid() != 0) return;
  setUnlessSet("OMPI_ALLOW_RUN_AS_ROOT", "1");
  setUnlessSet("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1");
}

}  // namespace

void startOwnRanks(int ranks, int argc, char* argv[]) {
  if (const char* others = std::getenv("OMPI_COMM_WORLD_SIZE"); others || launchedByMpi())
    throw CommandLineError("--ranks starts mpirun, but this process was itself started by an MPI launcher" +
                           (others ? " with " + std::string(others) + " ranks" : std::string()) + "; use either --ranks or mpirun");
  if (ranks == 1) return;
  std::vector<std::string> words{findLauncher(), "-np", std::to_string(ranks), ownPath(argv[0])};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--ranks")
      ++i;
    else if (word.rfind("--ranks=", 0) != 0)
      words.push_back(word);
  }
  allowOnThisMachine();
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(pointers[0], pointers.data());
  throw EnvironmentError("--ranks: cannot start " + words[0] + ": " + std::strerror(errno));
}

}  // namespace suture
