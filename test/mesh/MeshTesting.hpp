#pragma once
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/SceneReader.hpp>
#include <suture/mesh/MeshReader.hpp>

#include <unistd.h>
#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <Tpetra_Core.hpp>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

namespace meshtesting {

inline Teuchos::RCP<const suture::Comm> world() { return Tpetra::getDefaultComm(); }

/// A folder of its own for the files of one test, the same on all ranks; removed at the end.
class Folder {
 public:
  Folder() {
    const std::string letters(6, 'X');  // mkdtemp wants six X, and puts its own letters there
    std::string name = (std::filesystem::temp_directory_path() / ("suture-test-" + letters)).string();
    suture::collectivelyOnRoot(*world(), "making a folder for the test", [&] {
      if (!mkdtemp(name.data())) throw suture::EnvironmentError("cannot make the folder " + name + ": " + std::strerror(errno));
    });
    path_ = suture::broadcast(*world(), name);
  }
  ~Folder() {
    world()->barrier();
    std::error_code ignored;
    if (world()->getRank() == 0) std::filesystem::remove_all(path_, ignored);
  }
  const std::string& path() const { return path_; }
  /// Writes a file on rank 0; its path.
  std::string write(const std::string& name, const std::string& text) const {
    const std::string path = path_ + "/" + name;
    if (world()->getRank() == 0) std::ofstream(path, std::ios::binary) << text;
    world()->barrier();
    return path;
  }

 private:
  std::string path_;
};

/// The resolved list `Mesh` of a scene with these parameters in it.
inline suture::SceneFile sceneWithMesh(const std::string& parameters) {
  suture::Schema schema("scene");
  schema.list("Mesh", suture::meshSchema(), true);
  return suture::parseScene(
      "<ParameterList name=\"Suture\"><ParameterList name=\"Mesh\">" + parameters + "</ParameterList></ParameterList>", "test.xml", schema);
}

inline suture::Mesh read(const std::string& parameters, const std::string& folder) {
  const suture::SceneFile scene = sceneWithMesh(parameters);
  return suture::readMesh(*world(), scene.parameters->sublist("Mesh"), folder);
}

inline std::string fileParameter(const std::string& name) { return "<Parameter name=\"File\" type=\"string\" value=\"" + name + "\"/>"; }

/// All problems of the InputError that `work` throws, one a line as "path: message"; "no error" if it throws none.
template <typename Work>
std::string problemsOf(Work work) {
  try {
    work();
  } catch (const suture::InputError& error) {
    std::string all;
    for (const suture::Problem& problem : error.problems()) all += problem.path + ": " + problem.message + "\n";
    return all;
  }
  return "no error";
}

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The same text on all ranks?
inline bool sameEverywhere(const std::string& text) {
  for (const std::string& other : suture::allGather(*world(), text))
    if (other != text) return false;
  return true;
}

}  // namespace meshtesting

/// Asserts that the text `problems` holds `part`, and shows the whole if it does not.
#define SUTURE_CHECK_SAYS(problems, part)                                                    \
  do {                                                                                       \
    const std::string suture_whole = problems, suture_part = part;                           \
    const bool suture_found = meshtesting::contains(suture_whole, suture_part);              \
    if (!suture_found) out << "not in the message: " << suture_part << "\n" << suture_whole; \
    TEST_ASSERT(suture_found);                                                               \
  } while (false)
