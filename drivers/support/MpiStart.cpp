#include "MpiStart.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace suture {

namespace {

/// True if the user's parameter file has a line "name = value", which an environment variable would override.
bool isInUsersFile(const std::string& name) {
  const char* home = std::getenv("HOME");
  std::ifstream file(std::string(home ? home : "") + "/.openmpi/mca-params.conf");
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line.substr(0, line.find('=')));
    std::string word;
    if (words >> word && word == name) return true;
  }
  return false;
}

}  // namespace

MpiStart::MpiStart() {
  if (launchedRank() || std::getenv("OMPI_COMM_WORLD_SIZE")) return;
  set("pml", "ob1");
  // All isolated processes have the same folder for temporary files, and each removes it at its end: of 600 runs, four at a time, four
  // ended with "Error in file session_dir.c".
  if (set("ess_singleton_isolated", "1")) set("orte_create_session_dirs", "0");
}

bool MpiStart::set(const std::string& name, const char* value) {
  const std::string variable = "OMPI_MCA_" + name;
  if (std::getenv(variable.c_str()) || isInUsersFile(name)) return false;
  setenv(variable.c_str(), value, 0);
  set_.push_back(variable);
  return true;
}

MpiStart::~MpiStart() {
  for (const std::string& variable : set_) unsetenv(variable.c_str());
}

const char* launchedRank() {
  for (const char* variable : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (const char* rank = std::getenv(variable)) return rank;
  return nullptr;
}

bool launchedByMpi() { return std::getenv("OMPI_COMM_WORLD_RANK") || std::getenv("PMIX_RANK") || std::getenv("PMI_RANK"); }

}  // namespace suture
