#include "MpiStart.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <utility>

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
  const std::pair<const char*, const char*> settings[] = {{"pml", "ob1"}, {"ess_singleton_isolated", "1"}};
  for (const auto& [name, value] : settings) {
    const std::string variable = std::string("OMPI_MCA_") + name;
    if (std::getenv(variable.c_str()) || isInUsersFile(name)) continue;
    setenv(variable.c_str(), value, 0);
    set_.push_back(variable);
  }
}

MpiStart::~MpiStart() {
  for (const std::string& variable : set_) unsetenv(variable.c_str());
}

const char* launchedRank() {
  for (const char* variable : {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
    if (const char* rank = std::getenv(variable)) return rank;
  return nullptr;
}

}  // namespace suture
