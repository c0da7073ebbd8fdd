#include <suture/base/Version.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <regex>

namespace {

using namespace suture;

TEUCHOS_UNIT_TEST(Version, HasThreeNumbers) { TEST_ASSERT(std::regex_match(version(), std::regex("[0-9]+\\.[0-9]+\\.[0-9]+"))); }

TEUCHOS_UNIT_TEST(Version, CommitIsShortOrUnknown) { TEST_ASSERT(std::regex_match(commit(), std::regex("[0-9a-f]{7,}\\+?|unknown"))); }

TEUCHOS_UNIT_TEST(Version, NamesEveryLibraryWithANumber) {
  const auto all = libraryVersions();
  for (const char* name : {"Trilinos", "MPI", "HDF5", "CHOLMOD", "METIS", "Eigen", "muParser", "compiler"}) {
    TEST_ASSERT(all.count(name) == 1 && std::regex_search(all.at(name), std::regex("[0-9]+\\.[0-9]+")));
  }
  TEST_ASSERT(all.at("Gmsh") == "not built in" || std::regex_match(all.at("Gmsh"), std::regex("[0-9]+\\.[0-9]+\\.[0-9]+")));
}

}  // namespace
