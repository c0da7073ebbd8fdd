// The random scenes: the same everywhere for one seed, and as varied as documented.
#include <Teuchos_ParameterList.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <corpus/CorpusScene.hpp>
#include <suture/mesh/CellGeometry.hpp>

#include <set>

namespace suture::corpus {
namespace {

// By an implementation in another language.
TEUCHOS_UNIT_TEST(Random, GivesTheBitsOfSplitMix64) {
  Random random(1);
  for (const std::uint64_t bits : {0xfccac7c96d3a1e78ull, 0x93df7413971b78d9ull, 0x494f4724213d3138ull}) TEST_ASSERT(random.bits() == bits);
}

TEUCHOS_UNIT_TEST(Random, PermutesAll) {
  Random random(3);
  const std::vector<int> all = random.permutation(50);
  TEST_EQUALITY(std::set<int>(all.begin(), all.end()).size(), 50u);
}

TEUCHOS_UNIT_TEST(CorpusScene, IsTheSameForASeed) {
  for (const std::uint64_t seed : {1, 17, 250}) {
    const CorpusScene one = corpusScene(seed), two = corpusScene(seed);
    TEST_EQUALITY(one.text, two.text);
    TEST_EQUALITY(one.mesh.hash(), two.mesh.hash());
  }
  TEST_ASSERT(corpusScene(1).text != corpusScene(2).text);
}

TEUCHOS_UNIT_TEST(CorpusScene, HasSoundMeshes) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const CorpusScene scene = corpusScene(seed);
    for (int e = 0; e < scene.mesh.elements(); ++e) TEST_ASSERT(smallestJacobian(scene.mesh, e) > 0.0);
    TEST_ASSERT(scene.mesh.nodes() <= 3000);
  }
}

TEUCHOS_UNIT_TEST(CorpusScene, CoversTheDocumentedVariety) {
  std::set<std::string> families, obstacles;
  std::set<Cell> cells;
  std::set<std::size_t> bodies, contacts;
  double largestJump = 1, poisson = 0, smallestUnit = 1e300, largestUnit = 0;
  int unsolvable = 0, named = 0, turned = 0, gaps = 0, mixed = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const CorpusScene scene = corpusScene(seed);
    const SceneFile file = resolve(scene, {});
    const Parameters& all = *file.parameters;
    families.insert(scene.family);
    cells.insert(scene.mesh.cells.begin(), scene.mesh.cells.end());
    bodies.insert(sublistNames(all.sublist("Bodies")).size());
    contacts.insert(sublistNames(all.sublist("Contact")).size());
    double low = 1e300, high = 0;
    for (const std::string& name : sublistNames(all.sublist("Materials"))) {
      const Parameters& material = all.sublist("Materials").sublist(name);
      low = std::min(low, material.get<double>("Young Modulus"));
      high = std::max(high, material.get<double>("Young Modulus"));
      poisson = std::max(poisson, material.get<double>("Poisson Ratio"));
      mixed += material.get<std::string>("Element") == "Mixed";
    }
    largestJump = std::max(largestJump, high / low);
    smallestUnit = std::min(smallestUnit, low);
    largestUnit = std::max(largestUnit, low);
    for (const std::string& name : sublistNames(all.sublist("Contact"))) {
      const Parameters& contact = all.sublist("Contact").sublist(name);
      obstacles.insert(contact.get<std::string>("Obstacle"));
      gaps += contact.isParameter("Initial Gap");
    }
    unsolvable += scene.expected == Expected::Unsolvable;
    named += all.sublist("Partition").get<std::string>("Type") == "Named Groups";
    turned += scene.text.find("{0, ") == std::string::npos;
  }
  TEST_EQUALITY(families.size(), familyNames().size());
  TEST_EQUALITY(cells.size(), 5u);
  TEST_EQUALITY(obstacles.size(), 4u);  // None, Line, Circle, Height
  TEST_ASSERT(*bodies.begin() == 2 && *bodies.rbegin() == 6 && contacts.count(1) == 1 && *contacts.rbegin() >= 6);
  TEST_COMPARE(largestJump, >, 1e5);
  TEST_COMPARE(poisson, >, 0.498);
  TEST_COMPARE(largestUnit / smallestUnit, >, 1e12);
  for (const int count : {unsolvable, named, turned, gaps, mixed}) TEST_COMPARE(count, >=, 9);
}

}  // namespace
}  // namespace suture::corpus
