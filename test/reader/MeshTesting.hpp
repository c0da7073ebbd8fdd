#pragma once
#include <support/CheckSays.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/reader/MeshReader.hpp>

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

/// A temporary folder for the files of one test, the same on all ranks; removed at the end.
class Folder {
 public:
  Folder();
  ~Folder();
  const std::string& path() const { return path_; }
  /// Writes a file on rank 0; returns its path.
  std::string write(const std::string& name, const std::string& text) const;

 private:
  std::string path_;
};

/// The resolved list `Mesh` of a scene with these parameters in it.
suture::SceneFile sceneWithMesh(const std::string& parameters);

suture::Mesh read(const std::string& parameters, const std::string& folder);

inline std::string fileParameter(const std::string& name) { return "<Parameter name=\"File\" type=\"string\" value=\"" + name + "\"/>"; }

/// All problems of the InputError that `work` throws, one per line as "path: message"; "no error" if it throws none.
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

using texts::contains;

/// True if all ranks have the same text.
bool sameEverywhere(const std::string& text);

}  // namespace meshtesting
