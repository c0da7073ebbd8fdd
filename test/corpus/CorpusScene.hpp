#pragma once
#include <corpus/Builder.hpp>
#include <suture/base/scene/SceneReader.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace suture::corpus {

/// A random contact scene of two to six bodies; the same for a seed on every machine and with any number of ranks.
struct CorpusScene {
  std::uint64_t seed = 0;
  std::string family;
  Expected expected = Expected::Solvable;
  Mesh mesh;         ///< as in a mesh file, without bodies
  std::string text;  ///< the scene file
};

std::vector<std::string> familyNames();

CorpusScene corpusScene(std::uint64_t seed);

/// The scene file through the scene reader, all checks and defaults included. \throws InputError
SceneFile resolve(const CorpusScene& scene, const std::vector<std::string>& overrides);

/// Writes <folder>/<seed>.h5 and <seed>.xml for suture_solve. Collective.
void dump(const Comm& comm, const CorpusScene& scene, const std::string& folder);

}  // namespace suture::corpus
