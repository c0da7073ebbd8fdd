// The parts of suture_study that need no scene: formulas, columns, rows with medians, bands, filters.
#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <suture/base/Errors.hpp>
#include <suture/simulation/Overrides.hpp>

#include "../../drivers/study/Bands.hpp"
#include "../../drivers/study/Combinations.hpp"

using namespace suture;
using namespace suture::study;
using Json = nlohmann::ordered_json;

namespace {

const Json summary = Json::parse(R"({"dofs": 100, "subdomains": 8, "outer": {"iterations": 3, "pcg_total": 24, "condition": 4.5,
  "solver": "Chord"}, "auxiliary": {"iterations": 7, "condition": 22.5}, "converged": true,
  "contact": {"force": {"fault above": [3.0, -4.0]}, "by_piece": {"fault above": {"max_gap": null}}}})");

double number(const std::string& text) {
  const study::TableCell cell = study::Formula(text).evaluate(summary);
  return cell.isNumber() ? cell.number : std::nan("");
}

std::string complaint(const std::string& text) {
  try {
    study::Formula formula(text);
  } catch (const InputError& error) {
    return error.problems().front().message;
  }
  return "";
}

TEUCHOS_UNIT_TEST(Formula, CalculatesInTheUsualOrder) {
  TEST_EQUALITY(number("2 + 3 * 4 - 6 / 3"), 12.0);
  TEST_EQUALITY(number("(2 + 3) * 4"), 20.0);
  TEST_EQUALITY(number("10 - 3 - 2"), 5.0);
  TEST_EQUALITY(number("-1.5e1 + 1"), -14.0);
  TEST_EQUALITY(number("auxiliary.iterations + outer.pcg_total"), 31.0);
  TEST_EQUALITY(number("max(auxiliary.condition, outer.condition, 1)"), 22.5);
  TEST_EQUALITY(number("norm(contact.force.fault above) / 2"), 2.5);
  TEST_EQUALITY(number("abs(contact.force.fault above.1)"), 4.0);
  TEST_EQUALITY(number("1000 * dofs / subdomains"), 12500.0);
}

TEUCHOS_UNIT_TEST(Formula, SumsAndCountsTheEntriesOfAList) {
  const Json levels =
      Json::parse(R"({"accuracy": {"levels": [{"unknowns": 10, "seconds": 0.5}, {"unknowns": 32, "seconds": 0.25}]}, "no": []})");
  const auto value = [&](const char* text) { return Formula(text).evaluate(levels); };
  TEST_EQUALITY(value("sum(accuracy.levels.unknowns)").number, 42.0);
  TEST_ASSERT(value("sum(accuracy.levels.unknowns)").kind == study::TableCell::Kind::Integer);
  TEST_EQUALITY(value("2 * sum(accuracy.levels.seconds) + count(accuracy.levels)").number, 3.5);
  TEST_EQUALITY(value("sum(accuracy.levels.unknowns) / accuracy.levels.1.unknowns").number, 42.0 / 32.0);
  TEST_EQUALITY(value("count(no)").number, 0.0);
  for (const char* text : {"sum(accuracy.levels.nothing)", "sum(nothing.here)", "sum(accuracy.levels)", "count(accuracy)"})
    TEST_ASSERT(value(text).kind == study::TableCell::Kind::Empty);
}

TEUCHOS_UNIT_TEST(Formula, NeedsNoBlanksButAroundAMinusBehindAName) {
  TEST_EQUALITY(number("1000*dofs"), 1e5);
  TEST_EQUALITY(number("dofs*1000/subdomains"), 12500.0);
  TEST_EQUALITY(number("dofs/subdomains+1"), 13.5);
  TEST_EQUALITY(number("dofs+subdomains"), 108.0);
  TEST_EQUALITY(number("1-dofs"), -99.0);
  TEST_EQUALITY(number("dofs - 1"), 99.0);
  TEST_ASSERT(std::isnan(number("2e+1*dofs-1")));  // reads the name dofs-1, which no summary contains
  TEST_EQUALITY(number("(dofs)-1"), 99.0);
  TEST_EQUALITY(number("dofs-(1)"), 99.0);
  TEST_EQUALITY(number("2e+1*dofs"), 2000.0);
  TEST_EQUALITY(number("dofs*2e-1"), 20.0);
  TEST_EQUALITY(number("dofs*-1"), -100.0);
  TEST_EQUALITY(number("2*(dofs+1)*(3-1)"), 404.0);
  TEST_EQUALITY(number("max(dofs,subdomains)*2"), 200.0);
  const Json hyphens = Json::parse(R"({"left-side": {"half-width": 3}})");
  TEST_EQUALITY(Formula("2*left-side.half-width").evaluate(hyphens).number, 6.0);
}

TEUCHOS_UNIT_TEST(Formula, AMissingFigureMakesAnEmptyCell) {
  for (const char* text : {"nothing", "dofs + nothing", "contact.by_piece.fault above.max_gap", "1 / 0", "outer.solver + 1", "norm(outer)"})
    TEST_ASSERT(study::Formula(text).evaluate(summary).kind == study::TableCell::Kind::Empty);
  TEST_EQUALITY(study::Formula("outer.solver").evaluate(summary).text, "Chord");
  TEST_EQUALITY(study::Formula("converged").evaluate(summary).text, "true");
}

TEUCHOS_UNIT_TEST(Formula, SaysWhatIsWrong) {
  for (const char* text :
       {"", "(1", "1 +", "max(", "max()", "1 2)", "norm(1 + 2)", "abs(1, 2)", "sum(1 + 2)", "sum()", "count(2)", "sum(a, b)"})
    TEST_INEQUALITY(complaint(text), "");
  TEST_INEQUALITY(complaint("nrom(a)").find("Did you mean 'norm'?"), std::string::npos);
}

TEUCHOS_UNIT_TEST(StudyColumns, KnowTheSummaryBeforeThereIsOne) {
  Problems problems;
  for (const char* text : {"pcg", "phases.read.max", "contact.force.fault above", "contact.force.fault above.0", "outer.estimates.mu",
                           "parameters.Outer Solver.Tolerance", "mine = pcg / steps", "1000 * setup_seconds / subdomains",
                           "count(neutral_motions) + 1", "sum(undetermined_forces.pairs)"})
    readColumn(text, "Columns", problems);
  TEST_ASSERT(problems.empty());
  for (const char* text : {"outre.iterations", "outer", "phases.read", "a = b", "= pcg", "contact.force.fault above.0.0",
                           "sum(neutral_motions)", "count(neutral_motion)"})
    readColumn(text, "Columns", problems);
  TEST_EQUALITY(problems.list().size(), 8u);
  TEST_INEQUALITY(problems.list().front().message.find("Did you mean 'outer.iterations'?"), std::string::npos);
  const study::Column pcg = readColumn("pcg", "Columns", problems);
  TEST_EQUALITY(pcg.formula.evaluate(summary).number, 31.0);
}

TEUCHOS_UNIT_TEST(Overrides, TakeThePlaceOfThoseOfTheSameParameter) {
  std::vector<std::string> all{"A/B c=1", "D=2"};
  setOverride(all, " A / B c =3");
  setOverride(all, "A/B=4");
  TEST_ASSERT((all == std::vector<std::string>{" A / B c =3", "D=2", "A/B=4"}));
  TEST_EQUALITY(overridePath(" A / B c =3=x/y"), "A/B c");
}

// Two sweeps of 2 x 3; the column is 10 * first + second.
Study sample() {
  Study study;
  study.sweeps = {{"size", {"small", "large"}, {{"a", "A", {"1", "2"}}}}, {"seed", {"1", "2", "3"}, {{"b", "B", {"x", kUnchanged, "z"}}}}};
  study.columns = {{"dofs", study::Formula("dofs")}};
  return study;
}

std::vector<study::Row> rowsOf(const Study& study, const std::vector<study::Combination>& runs) {
  std::vector<study::Row> rows;
  for (const study::Combination& run : runs) {
    const Json one{{"dofs", 10 * (run.choice[0] + 1) + run.choice[1]}};
    rows.push_back(studyRow(study, run, {one.dump()}, 0, ""));
  }
  return rows;
}

TEUCHOS_UNIT_TEST(StudyRuns, CombineAllSweepsTheLastOneFastest) {
  Problems problems;
  const Study study = sample();
  const auto all = combinations(study, {"C=1"}, {}, problems);
  TEST_EQUALITY(all.size(), 6u);
  TEST_EQUALITY(labelsOf(study, all[0]), "size=small  seed=1");
  TEST_EQUALITY(labelsOf(study, all[1]), "size=small  seed=2");
  TEST_EQUALITY(labelsOf(study, all[5]), "size=large  seed=3");
  TEST_ASSERT((all[0].overrides == std::vector<std::string>{"A=1", "B=x", "C=1", "Output/Fields=false"}));
  TEST_ASSERT((all[1].overrides == std::vector<std::string>{"A=1", "C=1", "Output/Fields=false"}));  // "-": the scene's value
  const auto some = combinations(study, {}, readOnly(study, {"large", "seed=3", "seed=1"}, problems), problems);
  TEST_EQUALITY(some.size(), 2u);
  TEST_EQUALITY(some[0].number, 4);
  TEST_EQUALITY(some[1].number, 6);
  TEST_ASSERT(problems.empty());
  readOnly(study, {"lrage", "seed=4"}, problems);
  combinations(study, {"A=3"}, {}, problems);
  TEST_EQUALITY(problems.list().size(), 3u);
}

TEUCHOS_UNIT_TEST(StudyBands, AreKeptUpToTheirLimitsAndMissedBeyond) {
  Problems problems;
  Study study = sample();
  const study::Formula dofs("dofs");
  study.bands = {{"1", "dofs", dofs, {}, 22.0, 10.0, {}, {}},
                 {"2", "dofs", dofs, {}, 21.0, {}, {}, {}},
                 {"3", "dofs", dofs, {{"size", {"small"}}}, 12.0, {}, 1.2, 2.0},
                 {"4", "dofs", dofs, {{"size", {"small"}}}, {}, {}, 1.19, {}},
                 {"5", "dofs", dofs, {{"seed", {"1", "3"}}}, {}, {}, {}, 11.0},
                 {"6", "dofs", dofs, {}, {}, 11.0, {}, {}}};
  const auto runs = combinations(study, {}, {}, problems);
  const auto verdicts = judgeBands(study, rowsOf(study, runs));
  const std::vector<bool> expected{true, false, true, false, false, false};  // 10 11 12 20 21 22
  for (std::size_t b = 0; b < expected.size(); ++b) TEST_EQUALITY(verdicts[b].kept, expected[b]);
}

TEUCHOS_UNIT_TEST(StudyBands, ARunThatFailedMissesTheBandUnlessTheBandIsAboutThat) {
  Problems problems;
  Study study = sample();
  study.bands = {{"dofs", "dofs", study::Formula("dofs"), {}, 100.0, {}, {}, {}},
                 {"code", "exit_code", study::Formula("exit_code"), {}, 4.0, {}, {}, {}},
                 {"others", "dofs", study::Formula("dofs"), {{"size", {"large"}}}, 100.0, {}, {}, {}}};
  const auto runs = combinations(study, {}, {}, problems);
  auto rows = rowsOf(study, runs);
  rows[1] = studyRow(study, runs[1], {R"({"dofs": 11})"}, 4, "not converged");
  TEST_ASSERT(!judgeBands(study, rows)[0].kept);
  TEST_ASSERT(judgeBands(study, rows)[1].kept);
  TEST_ASSERT(judgeBands(study, rows)[2].kept);
  rows.resize(2);  // as with --only
  TEST_ASSERT(!judgeBands(study, rows)[2].judged);
}

TEUCHOS_UNIT_TEST(StudyTable, KeepsTheMedianOfTimesAndTheFirstOfAllElse) {
  Problems problems;
  Study study = sample();
  study.columns = {{"dofs", study::Formula("dofs")}, {"solve", study::Formula("phases.solve.max")}, {"all", study::Formula("seconds")}};
  const auto runs = combinations(study, {}, {}, problems);
  std::vector<std::string> summaries;
  for (const double seconds : {3.0, 1.0, 2.0})
    summaries.push_back(Json{{"dofs", int(seconds)}, {"phases", {{"solve", {{"max", seconds}}}}}, {"seconds", 10 - seconds}}.dump());
  const study::Row row = studyRow(study, runs[0], summaries, 0, "");
  TEST_EQUALITY(row.cells[0].number, 3.0);
  TEST_EQUALITY(row.cells[1].number, 2.0);
  TEST_EQUALITY(row.cells[2].number, 8.0);
}

TEUCHOS_UNIT_TEST(StudyTable, EscapesWhatItsFormatsUse) {
  Problems problems;
  Study study = sample();
  study.sweeps[0].labels = {"a, \"b\"", "c|d"};
  const auto runs = combinations(study, {}, {}, problems);
  const std::vector<study::Row> rows{studyRow(study, runs[0], {R"({"dofs": 1234567})"}, 0, ""),
                                     studyRow(study, runs[3], {}, 3, "two\nlines")};
  TEST_EQUALITY(tableCsv(study, rows), "size,seed,dofs,failure\n\"a, \"\"b\"\"\",1,1234567,\nc|d,1,,two lines\n");
  TEST_INEQUALITY(tableMarkdown(study, rows).find("| a, \"b\" | 1 | 1,234,567 |  |\n| c\\|d | 1 |  | two lines |"), std::string::npos);
}

}  // namespace
