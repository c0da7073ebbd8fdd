#include <reader/MeshTesting.hpp>
#include <support/TemporaryFolder.hpp>

namespace meshtesting {

Folder::Folder() {
  std::string name;
  suture::collectivelyOnRoot(*world(), "making a folder for the test", [&] {
    name = suture::blocks::makeTemporaryFolder(std::filesystem::temp_directory_path(), "suture-test-");
    if (name.empty()) throw suture::EnvironmentError(std::string("cannot make a folder for the test: ") + std::strerror(errno));
  });
  path_ = suture::broadcast(*world(), name);
}

Folder::~Folder() {
  world()->barrier();
  std::error_code ignored;
  if (world()->getRank() == 0) std::filesystem::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
  const std::string path = path_ + "/" + name;
  if (world()->getRank() == 0) std::ofstream(path, std::ios::binary) << text;
  world()->barrier();
  return path;
}

suture::SceneFile sceneWithMesh(const std::string& parameters) {
  suture::Schema schema("scene");
  schema.list("Mesh", suture::meshSchema(), true);
  return suture::parseScene(
      "<ParameterList name=\"Suture\"><ParameterList name=\"Mesh\">" + parameters + "</ParameterList></ParameterList>", "test.xml", schema);
}

suture::Mesh read(const std::string& parameters, const std::string& folder) {
  const suture::SceneFile scene = sceneWithMesh(parameters);
  return suture::readMesh(*world(), scene.parameters->sublist("Mesh"), folder);
}

bool sameEverywhere(const std::string& text) {
  for (const std::string& other : suture::allGather(*world(), text))
    if (other != text) return false;
  return true;
}

}  // namespace meshtesting
