// The judge of the corpus accepts solutions of the reference and detects planted errors.
#include <Teuchos_DefaultComm.hpp>
#include <Teuchos_UnitTestHarness.hpp>
#include <corpus/CorpusJudge.hpp>

#include <Teuchos_CommHelpers.hpp>
#include <map>

namespace suture::corpus {
namespace {

CommPtr world() { return Teuchos::DefaultComm<int>::getComm(); }

struct Solved {
  Whole whole;
  Outcome outcome;
  explicit Solved(std::uint64_t seed) : outcome(run(world(), corpusScene(seed), ways().front(), whole)) {}
  /// Body of a node, and the largest displacement of a body.
  double largest(int body) const {
    double most = 0;
    for (int i = 0; i < outcome.displacement.size(); ++i)
      if (whole.mesh.bodyOfNode[i / 2] == body) most = std::max(most, std::abs(outcome.displacement[i]));
    return most;
  }
};

/// Scenes that double precision solves within the bound, of several families.
std::vector<std::uint64_t> solvedSeeds() {
  std::vector<std::uint64_t> seeds;
  std::map<std::string, int> ofFamily;
  for (std::uint64_t seed = 1; seeds.size() < 12; ++seed) {
    const CorpusScene scene = corpusScene(seed);
    if (scene.expected != Expected::Solvable || ofFamily[scene.family] == 2) continue;
    Solved solved(seed);
    int good = 0;
    if (world()->getRank() == 0) {
      const Judge judge(solved.whole);
      good = solved.outcome.ending == Ending::Solved && judge.rounding(solved.outcome) == 1.0 && judge.neutralMotions(solved.outcome) == 0;
    }
    Teuchos::broadcast(*world(), 0, Teuchos::outArg(good));
    if (!good) continue;
    ++ofFamily[scene.family];
    seeds.push_back(seed);
  }
  return seeds;
}

int strongest(const Outcome& outcome) {
  return static_cast<int>(std::max_element(outcome.forces.begin(), outcome.forces.end()) - outcome.forces.begin());
}

TEUCHOS_UNIT_TEST(CorpusJudge, SeesPlantedErrors) {
  for (const std::uint64_t seed : solvedSeeds()) {
    const Solved solved(seed);
    if (world()->getRank() != 0) continue;
    const Judge judge(solved.whole);
    const Mesh& mesh = solved.whole.mesh;
    TEST_EQUALITY(judge.verdict(solved.outcome), "");
    TEST_EQUALITY(judge.difference(solved.outcome, solved.outcome), "");
    const auto seen = [&](const char* what, const Outcome& planted) {
      out << seed << " " << what << ": " << judge.verdict(planted) << "\n";
      TEST_ASSERT(!judge.verdict(planted).empty());
    };
    const int pair = strongest(solved.outcome), node = solved.whole.constraints.pairs[pair].node(), body = mesh.bodyOfNode[node];

    Outcome planted = solved.outcome;
    planted.displacement[2 * node] += 1e-4 * solved.largest(body);
    planted.displacement[2 * node + 1] += 1e-4 * solved.largest(body);
    seen("one node disturbed", planted);
    TEST_ASSERT(!judge.difference(planted, solved.outcome).empty());

    planted = solved.outcome;
    for (int i = 0; i < planted.displacement.size(); ++i)
      if (mesh.bodyOfNode[i / 2] == body) planted.displacement[i] += 1e-4 * solved.largest(body);
    seen("a body moved", planted);

    planted = solved.outcome;
    planted.forces[pair] *= 1.001;
    seen("a force scaled by 1.001", planted);
    TEST_ASSERT(!judge.difference(planted, solved.outcome).empty());

    planted = solved.outcome;
    planted.forces[pair] = -planted.forces[pair];
    seen("a pair that pulls", planted);

    planted = solved.outcome;
    planted.displacement *= 1.0001;
    seen("all scaled by 1.0001", planted);

    planted = solved.outcome;
    planted.displacement[0] = std::nan("");
    seen("not a number", planted);

    planted = solved.outcome;
    planted.seam = 1e-5;
    seen("a broken seam", planted);
  }
}

TEUCHOS_UNIT_TEST(CorpusJudge, FindsFeasibilityAsScenesWereMade) {
  int none = 0, held = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const CorpusScene scene = corpusScene(seed);
    if (scene.expected == Expected::Unknown) continue;
    const Solved solved(seed);
    if (world()->getRank() != 0) continue;
    const Feasibility found = Judge(solved.whole).feasibility();
    TEST_EQUALITY(found == Feasibility::None, scene.expected == Expected::Unsolvable);
    (found == Feasibility::None ? none : held) += 1;
  }
  if (world()->getRank() == 0) {
    TEST_COMPARE(none, >=, 8);
    TEST_COMPARE(held, >=, 100);
  }
}

TEUCHOS_UNIT_TEST(CorpusJudge, FindsABlockThatSlides) {
  Random random(1);
  Builder builder(random);
  builder.family = "slides";
  const auto level = [](double y) { return [y](double) { return y; }; };
  builder.box("lower", 0, 1, level(0), level(1), 3, 3);
  builder.box("upper", 0, 1, level(1), level(2), 3, 3);
  builder.fix("lower_bottom");
  builder.contact("lower_top", "upper_bottom", true);
  builder.pressure("upper_top", 1);
  CorpusScene scene;
  scene.text = builder.finish("0.h5");
  scene.mesh = builder.mesh;
  Whole whole;
  run(world(), scene, ways().front(), whole);
  if (world()->getRank() == 0) TEST_ASSERT(Judge(whole).feasibility() == Feasibility::Slides);
}

}  // namespace
}  // namespace suture::corpus
