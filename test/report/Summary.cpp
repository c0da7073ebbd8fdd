#include <suture/report/Summary.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <algorithm>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <suture/report/History.hpp>
#include <suture/report/answers/Tables.hpp>

#include "SampleRun.hpp"

using namespace suture;
using nlohmann::json;

namespace {

json readJson(const std::string& path) { return json::parse(std::ifstream(path)); }

TEUCHOS_UNIT_TEST(Summary, HoldsTheKeysOfTheContract) {
  sample::SampleRun sample(sample::folderOf("summary"));
  prepareFolder(*sample.comm_, sample.folder_);
  writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, sample.folder_ + "/summary.json");
  const json all = readJson(sample.folder_ + "/summary.json");
  for (const char* key : {"/converged",
                          "/exit_code",
                          "/dofs",
                          "/nodes",
                          "/elements",
                          "/subdomains",
                          "/ranks",
                          "/interface_dofs",
                          "/auxiliary/iterations",
                          "/auxiliary/condition",
                          "/auxiliary/tolerance",
                          "/outer/solver",
                          "/outer/iterations",
                          "/outer/pcg_total",
                          "/outer/residual",
                          "/contact/pieces",
                          "/contact/pairs",
                          "/contact/active",
                          "/contact/max_pressure",
                          "/contact/force",
                          "/contact/max_gap",
                          "/contact/max_penetration",
                          "/energy",
                          "/max_displacement",
                          "/equilibrium/applied",
                          "/equilibrium/reactions",
                          "/equilibrium/imbalance",
                          "/error",
                          "/phases",
                          "/peak_memory_mb/min",
                          "/peak_memory_mb/avg",
                          "/peak_memory_mb/max",
                          "/peak_memory_mb/sum",
                          "/versions",
                          "/parameters"})
    if (!all.contains(json::json_pointer(key))) {
      out << "missing: " << key << "\n";
      success = false;
    }
}

// "outer.pcg_total" of every leaf; the parameters of the scene are one name.
void leaves(const json& value, const std::string& path, std::vector<std::string>& all) {
  if (path == "parameters")
    all.push_back("parameters.<path>");
  else if (!value.is_structured())
    all.push_back(path);
  else
    for (const auto& [name, inner] : value.items()) leaves(inner, path.empty() ? name : path + "." + name, all);
}

std::vector<std::string> parts(const std::string& path) {
  std::vector<std::string> all(1);
  for (const char c : path) c == '.' ? all.emplace_back() : all.back() += c;
  return all;
}

bool fits(const std::string& path, const std::string& pattern) {
  if (pattern == "versions.<name>") return path.rfind("versions.", 0) == 0;  // libraries have names with dots
  const std::vector<std::string> a = parts(path), b = parts(pattern);
  bool same = a.size() == b.size();
  for (std::size_t i = 0; same && i < a.size(); ++i) same = b[i].front() == '<' || a[i] == b[i];
  return same;
}

TEUCHOS_UNIT_TEST(Summary, ReturnsOnRootWhatItWrote) {
  sample::SampleRun sample(sample::folderOf("summary"));
  prepareFolder(*sample.comm_, sample.folder_);
  const std::string text = writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, sample.folder_ + "/summary.json");
  if (sample.comm_->getRank() == 0)
    TEST_ASSERT(json::parse(text) == readJson(sample.folder_ + "/summary.json"))
  else
    TEST_ASSERT(text.empty());
}

TEUCHOS_UNIT_TEST(Summary, NamesEveryPathThatItWritesAndNoOther) {
  sample::SampleRun sample(sample::folderOf("summary"));
  sample.solution_.estimates["mu"] = 1.0;
  sample.solution_.chosenSchur["Explicit"] = 3;
  sample.solution_.errors["displacement_l2"] = 1e-5;
  sample.solution_.neutral = {{"left", "move (1, 0)", true, true}};
  sample.solution_.sharedForces = {{{"joint", "seat"}, 3, {"joint"}}};
  sample.rub();
  sample.scene_.path = SUTURE_SOURCE_DIR "/README.md";  // any file: the record of an invalid scene is null
  sample.scene_.overrides = {"Title=other"};
  sample.model_.materialOfBody[0].strength = std::make_shared<VonMisesStrength>(1.0);
  LeastSafety least;
  least.factor = 2.0;
  least.body = least.id = 0;
  sample.solution_.safety.ofBodies = {least};
  sample.solution_.sinceTime = 1.0;
  sample.solution_.rigidGroups = {{0, {1, 2, 0}, {0.1, 0, 0}, {0, 0, 0.2}}};
  ErrorBound bound;
  bound.exists = true;
  bound.reasons = {"a reason"};
  sample.solution_.bound = bound;
  ErrorBars bars;
  for (const char* quantity : {"von_mises", "tension", "compression", "pressure"}) bars.singular[quantity] = "a reason";
  sample.solution_.errorBars = bars;
  sample.model_.loads.push_back(Load::bodyForce({0, -1, 0}));
  sample.model_.loads.back().name = "weight";
  ForceInterval held{"floor, below"}, touching{"joint", true}, loaded{"weight"};
  held.reason = touching.reason = "a reason";
  loaded.displacement = 0.1;
  sample.solution_.intervals = {held, touching, loaded};
  sample.solution_.since.assign(sample.solution_.displacement.size(), Vector());
  sample.solution_.extremes.displacementSince = sample.solution_.extremes.displacement;
  if (!sample.solution_.pairs.empty()) sample.solution_.pairs.front().bodies = {1, 0};  // the contact joins two pairs of bodies
  sample.scene_.included["materials.xml"] = {"<ParameterList/>", ""};
  prepareFolder(*sample.comm_, sample.folder_);
  Run run = sample.run();
  AccuracyReached accuracy;
  accuracy.levels.resize(1);
  AccuracyLevel& level = accuracy.levels.front();
  level.geometry = accuracy.geometry = level.estimate = level.value = level.energyError = 0.1;
  accuracy.uniform.emplace();
  run.accuracy = accuracy;
  run.invocation.plugins = {{"/some/plugin.so", "0123456789abcdef"}};
  run.invocation.restart = {"/some/checkpoint.h5", "0123456789abcdef"};
  writeSummary(run, runFigures(run), ExitCode::Done, sample.folder_ + "/summary.json");
  std::vector<std::string> written;
  leaves(readJson(sample.folder_ + "/summary.json"), "", written);
  // Not in this run; Transmissions.cpp has those of transmissions.
  const std::set<std::string> mayBeAbsent{"notes.<number>",
                                          "safety.bodies.<body>.step",
                                          "safety.bodies.<body>.time",
                                          "transmissions.<transmission>.error_min",
                                          "transmissions.<transmission>.error_max",
                                          "transmissions.<transmission>.efficiency"};
  for (const std::string& path : written)
    if (std::none_of(summaryPaths().begin(), summaryPaths().end(), [&](const std::string& p) { return fits(path, p); }) &&
        path != "notes") {
      out << "not in summaryPaths(): " << path << "\n";
      success = false;
    }
  for (const std::string& pattern : summaryPaths())
    if (mayBeAbsent.count(pattern) == 0 &&
        std::none_of(written.begin(), written.end(), [&](const std::string& path) { return fits(path, pattern); })) {
      out << "not written: " << pattern << "\n";
      success = false;
    }
}

TEUCHOS_UNIT_TEST(Summary, ReportsTheLargestConditionAndTheBalanceOfElements) {
  sample::SampleRun sample(sample::folderOf("summary"));
  sample.solution_.coarseSize = 7;
  prepareFolder(*sample.comm_, sample.folder_);
  writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, sample.folder_ + "/summary.json");
  const json all = readJson(sample.folder_ + "/summary.json");
  TEST_EQUALITY(all["outer"]["condition"].get<double>(), 24.125);  // the larger of the rows' 24.125 and 24.0
  TEST_EQUALITY(all["preconditioner"]["coarse_size"].get<int>(), 7);
  // Subdomains of 18, 18 and 36 triangles go to ranks 0, 1, 2, 0, ...
  const int ranks = sample.comm_->getSize();
  const int most = ranks == 1 ? 72 : ranks == 2 ? 54 : 36;
  TEST_EQUALITY(all["elements_by_rank"]["max"].get<int>(), most);
  TEST_FLOATING_EQUALITY(all["elements_by_rank"]["imbalance"].get<double>(), most / (72.0 / ranks), 1e-14);
}

TEUCHOS_UNIT_TEST(Summary, SumsUpContact) {
  sample::SampleRun sample(sample::folderOf("summary"));
  prepareFolder(*sample.comm_, sample.folder_);
  writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, sample.folder_ + "/summary.json");
  const json contact = readJson(sample.folder_ + "/summary.json")["contact"];
  TEST_EQUALITY(contact["pairs"].get<int>(), 4);
  TEST_EQUALITY(contact["active"].get<int>(), 3);
  TEST_EQUALITY(contact["max_pressure"].get<double>(), 10.0);
  TEST_EQUALITY(contact["max_gap"].get<double>(), 4e-3);
  TEST_EQUALITY(contact["max_penetration"].get<double>(), 1e-15);
  TEST_EQUALITY(contact["force"]["joint"].size(), 2);  // as many components as dimensions
  TEST_FLOATING_EQUALITY(contact["force"]["joint"][1].get<double>(), 5.0, 1e-15);
  TEST_FLOATING_EQUALITY(contact["force"]["crack"][0].get<double>(), 3.0, 1e-15);
  TEST_FLOATING_EQUALITY(contact["force"]["crack"][1].get<double>(), 4.0, 1e-15);
}

TEUCHOS_UNIT_TEST(Summary, SumsUpFrictionWhereThereIsSome) {
  sample::SampleRun sample(sample::folderOf("summary"));
  prepareFolder(*sample.comm_, sample.folder_);
  const std::string path = sample.folder_ + "/summary.json";
  writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, path);
  const json smooth = readJson(path)["contact"];
  TEST_ASSERT(!smooth.contains("friction") && !smooth["by_piece"]["joint"].contains("friction"));
  sample.rub();
  sample.comm_->barrier();  // all ranks have read it
  writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, path);
  const json all = readJson(path), contact = all["contact"], friction = contact["friction"],
             joint = contact["by_piece"]["joint"]["friction"];
  TEST_EQUALITY(friction["sticking"].get<int>(), 2);
  TEST_EQUALITY(friction["slipping"].get<int>(), 1);
  TEST_EQUALITY(friction["max_mobilisation"].get<double>(), 1.0);
  TEST_FLOATING_EQUALITY(friction["mean_mobilisation"].get<double>(), (0.8 + 0.6 + 1.0) / (0.8 + 1.2 + 2.0), 1e-15);
  TEST_EQUALITY(friction["dissipated_work"].get<double>(), 1.6e-3);
  TEST_FLOATING_EQUALITY(friction["tangential_force"][0].get<double>(), 2.2, 1e-15);
  TEST_FLOATING_EQUALITY(friction["tangential_force"][1].get<double>(), -0.6, 1e-15);
  TEST_EQUALITY(joint["sticking"].get<int>(), 1);
  TEST_FLOATING_EQUALITY(joint["mean_mobilisation"].get<double>(), 1.4 / 2.0, 1e-15);
  TEST_EQUALITY(contact["by_piece"]["crack"]["friction"]["max_mobilisation"].get<double>(), 0.5);
  TEST_FLOATING_EQUALITY(contact["force"]["joint"][0].get<double>(), 1.4, 1e-15);  // total forces, here as in `reactions`
  TEST_FLOATING_EQUALITY(contact["force"]["joint"][1].get<double>(), 5.0, 1e-15);
  TEST_FLOATING_EQUALITY(all["reactions"]["contacts"]["joint"]["force"][0].get<double>(), 1.4, 1e-15);
  TEST_FLOATING_EQUALITY(all["reactions"]["contacts"]["joint"]["moment"][0].get<double>(), 1.5 - 1.4, 1e-13);  // at the height 1
}

// A linear field: all stresses follow Hooke's law, and the first node is reported.
TEUCHOS_UNIT_TEST(Summary, ReportsTheExtremesAndTheirPlaces) {
  sample::SampleRun sample(sample::folderOf("summary"));
  prepareFolder(*sample.comm_, sample.folder_);
  writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, sample.folder_ + "/summary.json");
  const json extremes = readJson(sample.folder_ + "/summary.json")["extremes"];
  const sample::Stress s = sample::exactStress();
  const double mean = 0.5 * (s.xx + s.yy), radius = std::hypot(0.5 * (s.xx - s.yy), s.xy);
  TEST_EQUALITY(extremes["stresses"], "recovered at nodes");
  TEST_FLOATING_EQUALITY(extremes["tension"]["value"].get<double>(), std::max(mean + radius, s.zz), 1e-11);
  TEST_FLOATING_EQUALITY(extremes["compression"]["value"].get<double>(), std::min(mean - radius, s.zz), 1e-11);
  const double a = mean + radius - s.zz, b = mean - radius - s.zz, c = 2 * radius;
  TEST_FLOATING_EQUALITY(extremes["von_mises"]["value"].get<double>(), std::sqrt(0.5 * (a * a + b * b + c * c)), 1e-11);
  TEST_EQUALITY(extremes["von_mises"]["unit"], "Pa");
  TEST_EQUALITY(extremes["von_mises"]["body"], "lower");
  TEST_EQUALITY(extremes["von_mises"]["place"], json::array({0.0, 0.0}));
  TEST_EQUALITY(extremes["displacement"]["body"], "upper");
  TEST_EQUALITY(extremes["displacement"]["place"], json::array({2.0, 2.0}));
  TEST_EQUALITY(extremes["pressure"]["value"], 10.0);
  TEST_EQUALITY(extremes["pressure"]["contact"], "crack");
  TEST_EQUALITY(extremes["pressure"]["bodies"], json::array({"lower", "upper"}));
}

TEUCHOS_UNIT_TEST(Summary, SumsUpConditionsAndContacts) {
  sample::SampleRun sample(sample::folderOf("summary"));
  prepareFolder(*sample.comm_, sample.folder_);
  writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, sample.folder_ + "/summary.json");
  const json reactions = readJson(sample.folder_ + "/summary.json")["reactions"];
  TEST_EQUALITY(reactions["conditions"]["floor, below"], json::parse(R"({"kind": "support", "force": [1.0, 4.0], "moment": [2.0]})"));
  const json& joint = reactions["contacts"]["joint"];  // forces 2, 3 up at x = 0, 0.5; open at x = 1
  TEST_FLOATING_EQUALITY(joint["force"][1].get<double>(), 5.0, 1e-15);
  TEST_FLOATING_EQUALITY(joint["moment"][0].get<double>(), 1.5, 1e-15);
  TEST_FLOATING_EQUALITY(joint["centre"][0].get<double>(), 0.3, 1e-15);
  TEST_EQUALITY(joint["closed"].get<double>(), 1.0);
  TEST_EQUALITY(joint["whole"].get<double>(), 1.5);
  TEST_EQUALITY(reactions["sum"]["force"], json::array({1.0, 4.0}));  // contact between bodies is not included
}

TEUCHOS_UNIT_TEST(Tables, HaveARowAPairAndAConditionWithNamesThatSpreadsheetsRead) {
  sample::SampleRun sample(sample::folderOf("tables"));
  prepareFolder(*sample.comm_, sample.folder_);
  if (sample.comm_->getRank() != 0) return;
  writeContactTable(sample.run(), sample.folder_ + "/contact.csv");
  writeReactionTable(sample.run(), sample.folder_ + "/reactions.csv");
  const auto lines = [](const std::string& path) {
    std::ifstream file(path);
    std::vector<std::string> all;
    for (std::string line; std::getline(file, line);) all.push_back(line);
    return all;
  };
  const std::vector<std::string> pairs = lines(sample.folder_ + "/contact.csv"), sums = lines(sample.folder_ + "/reactions.csv");
  TEST_EQUALITY(pairs.size(), 5);
  TEST_EQUALITY(pairs.at(1), "0,joint,lower,upper,0,1,0,0,1,0,0,0.001,0,4,2,0.5,closed");
  TEST_EQUALITY(pairs.at(3), "2,joint,lower,upper,1,1,0,0,1,0,1,0.001,0.004,0,0,0.5,open");
  TEST_EQUALITY(sums.size(), 5);
  TEST_EQUALITY(sums.at(1), "\"floor, below\",support,,,1,4,0,0,0,2,,,,");
  TEST_EQUALITY(sums.at(2), "joint,contact,lower,upper,0,5,0,0,0,1.5,0.3,1,0,1");
  TEST_EQUALITY(sums.at(4), "sum,sum,,,1,4,0,0,0,2,,,,");
  const auto commas = [](const std::string& line) { return std::count(line.begin(), line.end(), ','); };
  TEST_EQUALITY(commas(sums[0]), commas(sums[2]));
  TEST_EQUALITY(commas(sums[0]), commas(sums[4]));
  TEST_EQUALITY(csvField("a \"b\""), "\"a \"\"b\"\"\"");
}

TEUCHOS_UNIT_TEST(Tables, HaveColumnsOfFrictionAtTheEnd) {
  sample::SampleRun sample(sample::folderOf("tables"));
  prepareFolder(*sample.comm_, sample.folder_);
  sample.rub();
  if (sample.comm_->getRank() != 0) return;
  writeContactTable(sample.run(), sample.folder_ + "/contact.csv");
  std::ifstream file(sample.folder_ + "/contact.csv");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  TEST_EQUALITY(lines.at(0).substr(lines[0].find("status")), "status,tx,ty,tz,slip_x,slip_y,slip_z,bound,dissipated,sliding");
  TEST_EQUALITY(lines.at(1), "0,joint,lower,upper,0,1,0,0,1,0,0,0.001,0,4,2,0.5,closed,0.8,0,0,0.002,0,0,0.8,0.0016,slip");
  TEST_EQUALITY(lines.at(2).substr(lines[2].find("closed")), "closed,0.6,0,0,0,0,0,1.2,0,stick");
  TEST_EQUALITY(lines.at(3).substr(lines[3].find("open")), "open,0,0,0,0,0,0,0,0,");
}

TEUCHOS_UNIT_TEST(Summary, MeasuresTheWholeMeshOverAllRanks) {
  sample::SampleRun sample(sample::folderOf("summary"));
  prepareFolder(*sample.comm_, sample.folder_);
  writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, sample.folder_ + "/summary.json");
  const json all = readJson(sample.folder_ + "/summary.json");
  // |u| of a linear field is largest in a corner of [0,2]^2: (2, 2).
  const double ux = 2 * (sample::Uxx + sample::Uxy), uy = 2 * (sample::Uyx + sample::Uyy);
  TEST_FLOATING_EQUALITY(all["max_displacement"].get<double>(), std::hypot(ux, uy), 1e-14);
  const int ranks = sample.comm_->getSize();
  TEST_FLOATING_EQUALITY(all["phases"]["solve"]["max"].get<double>(), 0.25 * ranks, 1e-14);
  TEST_FLOATING_EQUALITY(all["phases"]["solve"]["avg"].get<double>(), 0.125 * (ranks + 1), 1e-14);
  TEST_FLOATING_EQUALITY(all["peak_memory_mb"]["sum"].get<double>(), ranks * all["peak_memory_mb"]["avg"].get<double>(), 1e-12);
  TEST_ASSERT(all["peak_memory_mb"]["min"].get<double>() > 1.0);
}

TEUCHOS_UNIT_TEST(Summary, NestsTheResolvedParameters) {
  sample::SampleRun sample(sample::folderOf("summary"));
  prepareFolder(*sample.comm_, sample.folder_);
  writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, sample.folder_ + "/summary.json");
  const json parameters = readJson(sample.folder_ + "/summary.json")["parameters"];
  TEST_EQUALITY(parameters["Title"].get<std::string>(), "Two \"blocks\"");
  TEST_EQUALITY(parameters["Outer Solver"]["Tolerance"].get<std::string>(), "1e-8");
  TEST_EQUALITY(parameters["Outer Solver"]["Maximum Iterations"].get<int>(), 50);
  TEST_EQUALITY(parameters["Outer Solver"]["Values"][1].get<double>(), -0.5);
  TEST_EQUALITY(parameters["Partition"]["METIS"]["Seed"].get<int>(), 7);
}

TEUCHOS_UNIT_TEST(Summary, ReportsAFailedRun) {
  sample::SampleRun sample(sample::folderOf("summary"));
  sample.solution_.converged = false;
  sample.solution_.failure = "50 iterations were not enough";
  sample.solution_.energy = std::numeric_limits<double>::quiet_NaN();
  prepareFolder(*sample.comm_, sample.folder_);
  writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Numerical, sample.folder_ + "/summary.json");
  const json all = readJson(sample.folder_ + "/summary.json");
  TEST_EQUALITY(all["converged"].get<bool>(), false);
  TEST_EQUALITY(all["exit_code"].get<int>(), 4);
  TEST_EQUALITY(all["failure"].get<std::string>(), "50 iterations were not enough");
  TEST_ASSERT(all["energy"].is_null());
}

TEUCHOS_UNIT_TEST(Summary, ReportsTheKnownErrors) {
  sample::SampleRun sample(sample::folderOf("summary"));
  prepareFolder(*sample.comm_, sample.folder_);
  const auto written = [&] {
    writeSummary(sample.run(), runFigures(sample.run()), ExitCode::Done, sample.folder_ + "/summary.json");
    return readJson(sample.folder_ + "/summary.json");
  };
  json all = written();
  TEST_EQUALITY(all["error"].size(), 0);
  TEST_ASSERT(all["auxiliary"]["algebraic_error"].is_null());
  TEST_ASSERT(all["auxiliary"]["iteration_seconds"].is_null());
  sample.solution_.energyError = 0.002;
  sample.solution_.auxiliary.energyError = 0.5;
  sample.solution_.auxiliary.iterationSeconds = 0.25;
  all = written();
  TEST_EQUALITY(all["error"].size(), 1);
  TEST_EQUALITY(all["error"]["algebraic_energy_norm"].get<double>(), 0.002);
  TEST_EQUALITY(all["auxiliary"]["algebraic_error"].get<double>(), 0.5);
  TEST_EQUALITY(all["auxiliary"]["iteration_seconds"].get<double>(), 0.25);
  sample.solution_.discretisation = DiscretisationError{0.1, 4.0, {}};
  all = written();
  TEST_EQUALITY(all["error"]["estimated_energy_norm"].get<double>(), 0.1);
  TEST_EQUALITY(all["error"]["estimated_energy_norm_relative"].get<double>(), 0.1 / 4.0);
  TEST_EQUALITY(all["error"]["algebraic_energy_norm_relative"].get<double>(), 0.002 / 4.0);
}

TEUCHOS_UNIT_TEST(History, GivesBackTheSameNumbers) {
  sample::SampleRun sample(sample::folderOf("summary"));
  prepareFolder(*sample.comm_, sample.folder_);
  if (sample.comm_->getRank() != 0) return;
  const std::string path = sample.folder_ + "/history.csv";
  writeHistory({{3, 9, 24.1, 1.0 / 3.0, 1e-300, 84, 5, -1.2093e8 / 7, 0.1, 0.02}}, path);
  std::ifstream file(path);
  std::string header, row;
  std::getline(file, header);
  std::getline(file, row);
  TEST_EQUALITY(header, "iteration,pcg,condition,residual,euclidean,active,changed,energy,step,seconds,algebraic_error");
  int k, pcg, active, changed;
  double condition, residual, euclidean, energy, step, seconds;
  TEST_EQUALITY(std::sscanf(row.c_str(), "%d,%d,%lf,%lf,%lf,%d,%d,%lf,%lf,%lf", &k, &pcg, &condition, &residual, &euclidean, &active,
                            &changed, &energy, &step, &seconds),
                10);
  TEST_EQUALITY(k, 3);
  TEST_EQUALITY(residual, 1.0 / 3.0);
  TEST_EQUALITY(euclidean, 1e-300);
  TEST_EQUALITY(energy, -1.2093e8 / 7);
  TEST_EQUALITY(step, 0.1);
  TEST_EQUALITY(changed, 5);
  TEST_EQUALITY(row.back(), ',');  // the algebraic error is not known
  OuterRow known;
  known.energyError = 1.0 / 3.0;
  writeHistory({known}, path);
  std::ifstream again(path);
  std::getline(again, header);
  std::getline(again, row);
  TEST_EQUALITY(std::stod(row.substr(row.rfind(',') + 1)), 1.0 / 3.0);
}

}  // namespace
