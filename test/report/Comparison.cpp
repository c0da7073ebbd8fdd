#include <suture/report/Comparison.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <suture/base/Errors.hpp>
#include <suture/report/Summary.hpp>

#include "SampleRun.hpp"

using namespace suture;
using nlohmann::json;

namespace {

// Forces of the sample: support (1, 4), joint (0, 5), crack (3, 4): the largest is 5. The tolerance is 1e-8.
json sampleSummary() {
  sample::SampleRun sample(sample::folderOf("comparison"));
  sample.solution_.converged = true;
  sample.solution_.energy = -2.0;
  prepareFolder(*sample.comm_, sample.folder_);
  const std::string text = writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, sample.folder_ + "/summary.json");
  return sample.comm_->getRank() == 0 ? json::parse(text) : json();
}

const ComparedFigure& figure(const Comparison& comparison, const std::string& name) {
  const auto found =
      std::find_if(comparison.figures.begin(), comparison.figures.end(), [&](const ComparedFigure& one) { return one.name == name; });
  if (found == comparison.figures.end()) throw std::runtime_error("no figure " + name);
  return *found;
}

TEUCHOS_UNIT_TEST(Comparison, OfARunWithItselfIsExact) {
  const json then = sampleSummary();
  if (then.is_null()) return;
  const Comparison same = compareSummaries(then.dump(), then.dump());
  TEST_ASSERT(same.agrees());
  TEST_ASSERT(same.isExact());
  TEST_ASSERT(failureOf(same).empty());
  TEST_ASSERT(tableOf(same).find("to the last bit") != std::string::npos);
}

TEUCHOS_UNIT_TEST(Comparison, MeasuresForcesByTheLargestOfThem) {
  const json then = sampleSummary();
  if (then.is_null()) return;
  json now = then;
  now["reactions"]["contacts"]["joint"]["force"][0] = 3e-6;
  now["reactions"]["contacts"]["joint"]["force"][1] = 5.0 + 4e-6;
  const Comparison off = compareSummaries(then.dump(), now.dump());
  TEST_FLOATING_EQUALITY(figure(off, "contact force 'joint'").difference, 5e-6 / 5.0, 1e-6);  // |(3, 4)| 1e-6 of 5
  TEST_EQUALITY(figure(off, "contact force 'joint'").allowed, 100 * 1e-8);
  TEST_ASSERT(figure(off, "contact force 'crack'").difference == 0.0);
  now["reactions"]["contacts"]["joint"]["force"] = {0.0, 5.0 + 6e-6};
  TEST_ASSERT(!compareSummaries(then.dump(), now.dump()).agrees());
}

TEUCHOS_UNIT_TEST(Comparison, MeasuresValuesAtOnePointTenTimesMoreLoosely) {
  const json then = sampleSummary();
  if (then.is_null()) return;
  json now = then;
  now["contact"]["max_pressure"] = 10.0 * (1 + 9e-6);
  now["energy"] = -2.0 * (1 + 9e-7);
  const Comparison off = compareSummaries(then.dump(), now.dump());
  TEST_ASSERT(off.agrees());
  TEST_ASSERT(!off.isExact());
  TEST_FLOATING_EQUALITY(figure(off, "largest pressure").difference, 9e-6, 1e-4);
  TEST_FLOATING_EQUALITY(figure(off, "energy").difference, 9e-7, 1e-4);
  now["energy"] = -2.0 * (1 + 2e-6);
  TEST_ASSERT(!compareSummaries(then.dump(), now.dump()).agrees());
}

TEUCHOS_UNIT_TEST(Comparison, TakesTheResidualThatWasReachedWhereItIsLarger) {
  const json then = sampleSummary();
  if (then.is_null()) return;
  json now = then;
  now["outer"]["residual"] = 1e-4;
  const Comparison rough = compareSummaries(then.dump(), now.dump());
  TEST_EQUALITY(rough.tolerance, 1e-4);
  now = then;
  now["parameters"]["Outer Solver"]["Tolerance"] = "1e-5";  // files have a word or a number
  TEST_EQUALITY(compareSummaries(then.dump(), now.dump()).tolerance, 1e-5);
  now["parameters"]["Outer Solver"]["Tolerance"] = "Automatic";
  now["error"]["algebraic_energy_norm_relative"] = 1e-3;
  TEST_EQUALITY(compareSummaries(then.dump(), now.dump()).tolerance, 1e-3);
  TEST_EQUALITY(figure(rough, "energy").allowed, 1e-2);
}

TEUCHOS_UNIT_TEST(Comparison, DoesNotJudgeIterationsAndSubdomains) {
  const json then = sampleSummary();
  if (then.is_null()) return;
  json now = then;
  now["outer"]["iterations"] = 17;
  now["subdomains"] = 5;
  now["ranks"] = 7;
  const Comparison other = compareSummaries(then.dump(), now.dump());
  TEST_ASSERT(other.agrees());
  TEST_EQUALITY(other.ranksNow, 7);
  TEST_EQUALITY(figure(other, "outer iterations").now, "17");
  now["nodes"] = then["nodes"].get<int>() + 1;
  TEST_ASSERT(!compareSummaries(then.dump(), now.dump()).agrees());
}

TEUCHOS_UNIT_TEST(Comparison, NeverAgreesWithValuesThatAreNotFinite) {
  const json then = sampleSummary();
  if (then.is_null()) return;
  json now = then;
  now["energy"] = nullptr;
  TEST_ASSERT(!compareSummaries(then.dump(), now.dump()).agrees());
  TEST_ASSERT(compareSummaries(now.dump(), now.dump()).agrees());
  now.erase("reactions");
  TEST_THROW(compareSummaries(then.dump(), now.dump()), InputError);
}

}  // namespace
