#include <corpus/CorpusScene.hpp>
#include <corpus/Families.hpp>
#include <suture/reader/Hdf5Mesh.hpp>
#include <suture/report/SceneSchema.hpp>

#include <Teuchos_Comm.hpp>

#include <filesystem>
#include <fstream>

namespace suture::corpus {

namespace {

struct Entry {
  const char* name;
  Family family;
  int weight;
};

constexpr Entry families[] = {
    {"blocks", blocks, 3},        {"stack", stack, 3},         {"tray", tray, 3}, {"tilted", tilted, 2},
    {"layers", layers, 2},        {"bumps", bumps, 2},         {"disc", disc, 2}, {"lug", lug, 3},
    {"pushed pin", pushedPin, 1}, {"slopes", discOnSlopes, 2}, {"arch", arch, 2}, {"half-plane", onHalfPlane, 2},
    {"on disc", onDisc, 1},       {"graph", onGraph, 1},
};

std::string nameOf(std::uint64_t seed) { return std::to_string(seed); }

}  // namespace

std::vector<std::string> familyNames() {
  std::vector<std::string> names;
  for (const Entry& entry : families) names.push_back(entry.name);
  return names;
}

CorpusScene corpusScene(std::uint64_t seed) {
  Random random(seed);
  int weights = 0;
  for (const Entry& entry : families) weights += entry.weight;
  int choice = random.integer(0, weights - 1);
  const Entry* chosen = families;
  while (choice >= chosen->weight) choice -= (chosen++)->weight;

  Builder builder(random);
  builder.family = chosen->name;
  builder.mesh.source = nameOf(seed) + ".h5";
  chosen->family(builder);
  CorpusScene scene;
  scene.seed = seed;
  scene.family = chosen->name;
  scene.text = builder.finish(builder.mesh.source);
  scene.expected = builder.expected;
  scene.mesh = std::move(builder.mesh);
  return scene;
}

SceneFile resolve(const CorpusScene& scene, const std::vector<std::string>& overrides) {
  return parseScene(scene.text, nameOf(scene.seed) + ".xml", sceneSchema(), overrides);
}

void dump(const Comm& comm, const CorpusScene& scene, const std::string& folder) {
  if (comm.getRank() == 0) {
    std::filesystem::create_directories(folder);
    std::ofstream(std::filesystem::path(folder) / (nameOf(scene.seed) + ".xml")) << scene.text;
  }
  comm.barrier();
  writeHdf5Mesh(comm, scene.mesh, (std::filesystem::path(folder) / (nameOf(scene.seed) + ".h5")).string());
}

}  // namespace suture::corpus
