// A scene file and, behind a byte 0, words of --set, one per line. An accepted scene must be accepted again when printed with its defaults,
// with the same meaning.
#include "Fuzz.hpp"

#include <suture/base/Expression.hpp>
#include <suture/base/scene/SceneReader.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/solver/Method.hpp>

#include <Teuchos_ParameterList.hpp>

using namespace suture;

extern "C" int LLVMFuzzerInitialize(int*, char***) { return 0; }

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Schema schema = sceneSchema();
  std::string text(reinterpret_cast<const char*>(data), size), words;
  if (const std::size_t end = text.find('\0'); end != std::string::npos) {
    words = text.substr(end + 1) + "\n";
    text.erase(end);
  }
  std::vector<std::string> overrides;
  for (std::size_t end; (end = words.find('\n')) != std::string::npos; words.erase(0, end + 1)) overrides.push_back(words.substr(0, end));
  fuzz::accepts([&] {
    const SceneFile scene = parseScene(text, "scene.xml", schema, overrides);
    const std::string printed = toXml(*scene.parameters);
    fuzz::require(fuzz::accepts([&] { fuzz::require(toXml(*parseScene(printed, "printed.xml", schema).parameters) == printed); }));
    fuzz::accepts([&] { makeMethod(*scene.parameters, true); });
    fuzz::accepts([&] { sceneConstants(*scene.parameters); });
    fuzz::accepts([&] { makeElasticModel(*scene.parameters); });
  });
  return 0;
}
