// Extremes and reactions of scenes whose answers follow from statics and formulas, on any number of ranks.
#include <Teuchos_UnitTestHarness.hpp>
#include <nlohmann/json.hpp>
#include <support/Blocks.hpp>
#include <suture/elasticity/IsotropicLaw.hpp>
#include <suture/mesh/Generators.hpp>
#include <suture/simulation/Simulation.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace suture {
namespace {

using nlohmann::json;

ElasticModel modelOf(const std::vector<std::string>& bodies, double young, double poisson) {
  ElasticModel model;
  for (const std::string& body : bodies) model.addBody(body, std::make_shared<IsotropicLaw>(IsotropicModuli{young, poisson}));
  return model;
}

Load along(const std::string& group, const std::function<double(const Point&)>& x, const std::function<double(const Point&)>& y) {
  Load load = Load::traction(group, {0, 0, 0});
  load.expressions = {Expression(x), Expression(y)};
  load.name = group;
  return load;
}

/// [0,2]x[0,1], on rollers left and below.
Scene bar(const Load& load, const std::vector<std::string>& settings, double poisson = 0.25, bool axisymmetric = false) {
  ElasticModel model = modelOf({"bar"}, 2e6, poisson);
  model.loads = {load};
  model.axisymmetric = axisymmetric;
  const auto mesh = [] { return boxes({{"bar", 0, 2, 0, 1, 8, 4}}); };
  return makeScene(model, mesh, {Condition::displacement("bar_left", {0}, {0}), Condition::displacement("bar_bottom", {0}, {1})}, {},
                   settings);
}

double distance(const Point& a, const Point& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

TEUCHOS_UNIT_TEST(Answers, OfUniformTensionAreExact) {
  const double pull = 3e4, young = 2e6, poisson = 0.25;
  for (const char* nodal : {"true", "false"}) {
    Simulation simulation(blocks::world(),
                          bar(Load::traction("bar_right", {pull, 0, 0}), {"Partition/METIS/Subdomains=4", "Outer Solver/Tolerance=1e-12",
                                                                          std::string("Output/Nodal Stresses=") + nodal}));
    const Extremes& found = simulation.solve().extremes;
    TEST_EQUALITY(found.recovered, nodal == std::string("true"));
    const double across = poisson * pull;  // plane strain
    TEST_FLOATING_EQUALITY(found.vonMises.value, std::sqrt(pull * pull + across * across - pull * across), 1e-9);
    TEST_FLOATING_EQUALITY(found.tension.value, pull, 1e-9);
    TEST_EQUALITY(found.compression.value, 0.0);  // zero up to round-off, which has no place
    TEST_ASSERT(!found.compression.exists());
    const double ux = (1 - poisson * poisson) * pull / young * 2, uy = poisson * (1 + poisson) * pull / young;
    TEST_FLOATING_EQUALITY(found.displacement.value, std::hypot(ux, uy), 1e-9);
    TEST_EQUALITY(distance(found.displacement.place, {2, 1, 0}), 0.0);
    // The stress is uniform: the first node or element is reported, on any number of ranks.
    TEST_EQUALITY(found.vonMises.id, 0);
    TEST_EQUALITY(found.vonMises.body, 0);
    const Reactions& reactions = simulation.solution().verification.reactions;
    TEST_EQUALITY(reactions.supports.size(), 2);
    TEST_FLOATING_EQUALITY(reactions.loads[0].force[0], pull, 1e-12);
    TEST_FLOATING_EQUALITY(reactions.loads[0].moment[2], -0.5 * pull, 1e-12);
    TEST_FLOATING_EQUALITY(reactions.supports[0].force[0], -pull, 1e-9);
    TEST_FLOATING_EQUALITY(reactions.supports[0].moment[2], 0.5 * pull, 1e-9);
    TEST_COMPARE(std::abs(reactions.supports[1].force[1]), <, 1e-9 * pull);
  }
}

/// Pure bending: linear stress, which recovered stresses reproduce up to the surface, and centroid stresses do not.
TEUCHOS_UNIT_TEST(Answers, OfACoupleAreThoseOfTheBeam) {
  const double slope = 4e4;
  const auto scene = [&](const char* nodal) {
    ElasticModel model = modelOf({"bar"}, 2e6, 0.0);
    model.loads = {along(
        "bar_right", [=](const Point& p) { return slope * (p[1] - 0.5); }, [](const Point&) { return 0.0; })};
    const auto mesh = [] { return boxes({{"bar", 0, 2, 0, 1, 64, 32, Cell::Quadrilateral4}}); };
    return makeScene(model, mesh, {Condition::displacement("bar_left", {0, 0})}, {},
                     {"Partition/METIS/Subdomains=3", "Outer Solver/Tolerance=1e-10", std::string("Output/Nodal Stresses=") + nodal});
  };
  Simulation nodal(blocks::world(), scene("true")), central(blocks::world(), scene("false"));
  const Extremes &recovered = nodal.solve().extremes, &computed = central.solve().extremes;
  TEST_FLOATING_EQUALITY(recovered.tension.value, 0.5 * slope, 5e-3);
  TEST_FLOATING_EQUALITY(recovered.compression.value, -0.5 * slope, 5e-3);
  TEST_COMPARE(computed.tension.value, <, 0.985 * 0.5 * slope);
  TEST_EQUALITY(recovered.tension.place[1], 1.0);
  TEST_EQUALITY(recovered.compression.place[1], 0.0);
  const Reactions& reactions = nodal.solution().verification.reactions;
  const double couple = -slope / 12;  // integral of -(y - 1/2)^2
  TEST_COMPARE(std::abs(reactions.loads[0].force[0]), <, 1e-12 * slope);
  TEST_FLOATING_EQUALITY(reactions.loads[0].moment[2], couple, 1e-12);
  TEST_FLOATING_EQUALITY(reactions.supports[0].moment[2], -couple, 1e-8);
  TEST_COMPARE(distance(reactions.supports[0].force, {0, 0, 0}), <, 1e-8 * slope);
}

/// A block under a pressure that grows along it, on another one.
Scene pressed(const std::vector<std::string>& settings) {
  ElasticModel model = modelOf({"upper", "lower"}, 2e6, 0.3);
  model.loads = {along(
                     "upper_top", [](const Point&) { return 0.0; }, [](const Point& p) { return -1e4 * p[0]; }),
                 Load::bodyForce({0, -2e3, 0}, "upper")};
  model.loads[1].name = "weight";
  const auto mesh = [] { return boxes({{"upper", 0, 2, 0, 1, 12, 6}, {"lower", 0, 3, -1, 0, 15, 5}}); };
  return makeScene(model, mesh, {Condition::displacement("lower_bottom", {0, 0}), Condition::displacement("upper_left", {0}, {0})},
                   {Contact::between("upper_bottom", "lower_top")}, settings);
}

TEUCHOS_UNIT_TEST(Answers, BalanceEveryBodyOnItsOwn) {
  for (const char* formulation : {"Contact On The Interface", "Condensed Groups"}) {
    Simulation simulation(blocks::world(), pressed({"Partition/METIS/Subdomains=4", "Outer Solver/Tolerance=1e-11",
                                                    std::string("Formulation=") + formulation}));
    const Solution& solution = simulation.solve();
    const Reactions& reactions = solution.verification.reactions;
    const double force = -2e4 - 4e3, moment = -8e4 / 3 - 4e3;  // load and weight: integrals of 1e4 x, 1e4 x^2
    TEST_FLOATING_EQUALITY(reactions.loads[0].force[1], -2e4, 1e-11);
    TEST_FLOATING_EQUALITY(reactions.loads[0].moment[2], -8e4 / 3, 1e-11);
    TEST_FLOATING_EQUALITY(reactions.loads[1].force[1], -4e3, 1e-11);
    TEST_FLOATING_EQUALITY(reactions.loads[1].moment[2], -4e3, 1e-11);
    const Resultant &ground = reactions.supports[0], &guide = reactions.supports[1];
    TEST_FLOATING_EQUALITY(ground.force[1], -force, 1e-8);
    TEST_FLOATING_EQUALITY(ground.moment[2] + guide.moment[2], -moment, 1e-8);
    TEST_COMPARE(std::abs(ground.force[0] + guide.force[0]), <, 1e-7);
    if (blocks::world()->getRank() != 0) continue;
    const ContactResultant contact = contactResultants(solution.pairs, 1, false).front();
    TEST_COMPARE_ARRAYS(contact.bodies[0], std::vector<int>{0});
    TEST_COMPARE_ARRAYS(contact.bodies[1], std::vector<int>{1});
    TEST_FLOATING_EQUALITY(contact.onB.force[1], force, 1e-8);
    TEST_FLOATING_EQUALITY(contact.onB.moment[2], moment + guide.moment[2], 1e-8);  // the upper body in balance
    TEST_FLOATING_EQUALITY(contact.centre[0], contact.onB.moment[2] / force, 1e-10);
    TEST_FLOATING_EQUALITY(contact.whole, 2.0, 1e-12);
    TEST_ASSERT(contact.closed > 0.5 && contact.closed <= contact.whole);
  }
}

TEUCHOS_UNIT_TEST(Answers, NameAllBodiesOfASide) {
  std::vector<PairResult> pairs(4);
  for (const auto& [pair, bodies] : {std::pair(0, std::array<int, 2>{3, 1}), {1, {0, 1}}, {2, {3, 1}}, {3, {2, -1}}}) {
    pairs[pair].line = pair == 3;
    pairs[pair].bodies = bodies;
  }
  const std::vector<ContactResultant> found = contactResultants(pairs, 2, false);
  const std::vector<int> ofSideA{0, 3}, ofSideB{1}, onObstacle{2};
  TEST_COMPARE_ARRAYS(found[0].bodies[0], ofSideA);
  TEST_COMPARE_ARRAYS(found[0].bodies[1], ofSideB);
  TEST_COMPARE_ARRAYS(found[1].bodies[0], onObstacle);
  TEST_ASSERT(found[1].bodies[1].empty());
}

TEUCHOS_UNIT_TEST(Answers, OfAnObstacleSumToZero) {
  ElasticModel model = modelOf({"body"}, 2e6, 0.2);
  model.loads = {Load::pressure("body_top", 1e4)};
  const auto box = [] { return boxes({{"body", 0, 2, 0, 1, 8, 4}}); };
  Simulation simulation(blocks::world(),
                        makeScene(model, box, {Condition::displacement("body_left", {0}, {0})},
                                  {Contact::with(Obstacle::line({0, 0, 0}, {0, 3, 0}), "body_bottom")}, {"Outer Solver/Tolerance=1e-11"}));
  const std::string folder = "answers_" + std::to_string(blocks::world()->getSize()) + "_out";
  simulation.writeInto(folder);
  simulation.solve();
  const RunResult result = simulation.report();
  if (blocks::world()->getRank() != 0) return;
  const json all = json::parse(result.summary), &reactions = all["reactions"];
  const json& contact = reactions["contacts"].front();
  TEST_FLOATING_EQUALITY(contact["force"][1].get<double>(), -2e4, 1e-8);
  TEST_FLOATING_EQUALITY(contact["centre"][0].get<double>(), 1.0, 1e-8);
  TEST_EQUALITY(contact["bodies"], json::array({"body"}));
  TEST_EQUALITY(reactions["conditions"]["1"]["kind"], "load");
  TEST_FLOATING_EQUALITY(reactions["conditions"]["1"]["moment"][0].get<double>(), -2e4, 1e-12);
  TEST_EQUALITY(reactions["conditions"]["body_left"]["kind"], "support");
  for (const char* part : {"force", "moment"})
    for (const json& component : reactions["sum"][part]) TEST_COMPARE(std::abs(component.get<double>()), <, 1e-7 * 2e4);
  const json& pressure = all["extremes"]["pressure"];
  TEST_FLOATING_EQUALITY(pressure["value"].get<double>(), 1e4, 1e-8);
  TEST_EQUALITY(pressure["place"], json::array({0.0, 0.0}));  // all pressures are equal: the first pair is reported
  std::ifstream table(folder + "/contact.csv"), sums(folder + "/reactions.csv");
  std::string line;
  int lines = 0;
  while (std::getline(table, line)) ++lines;
  TEST_EQUALITY(lines, 1 + 9);
  for (lines = 0; std::getline(sums, line);) ++lines;
  TEST_EQUALITY(lines, 1 + 2 + 1 + 1);
}

TEUCHOS_UNIT_TEST(Answers, OfAnAxisymmetricBodyAreThoseOfTheWholeCircle) {
  const double pi = std::acos(-1.0), pull = 5e3;
  Simulation simulation(blocks::world(), bar(Load::traction("bar_top", {0, pull, 0}), {"Outer Solver/Tolerance=1e-12"}, 0.0, true));
  const Solution& solution = simulation.solve();
  const Reactions& reactions = solution.verification.reactions;
  TEST_FLOATING_EQUALITY(reactions.loads[0].force[1], pull * pi * 4, 1e-11);
  TEST_FLOATING_EQUALITY(reactions.supports[1].force[1], -pull * pi * 4, 1e-9);
  TEST_EQUALITY(reactions.supports[1].moment[2], 0.0);
  TEST_FLOATING_EQUALITY(solution.extremes.tension.value, pull, 1e-9);
}

/// Rows of a table, as texts.
std::vector<std::vector<std::string>> rowsOf(const std::string& path) {
  std::ifstream file(path);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(file, line);) {
    rows.emplace_back(1);
    for (const char c : line) c == ',' ? static_cast<void>(rows.back().emplace_back()) : rows.back().back().push_back(c);
  }
  return rows;
}

TEUCHOS_UNIT_TEST(Probes, HaveTheExactValuesOfALinearField) {
  const double pull = 3e4, young = 2e6, poisson = 0.25;
  const std::string folder = "probes_" + std::to_string(blocks::world()->getSize()) + "_out";
  Simulation simulation(blocks::world(),
                        bar(Load::traction("bar_right", {pull, 0, 0}),
                            {"Partition/METIS/Subdomains=4", "Outer Solver/Tolerance=1e-12", "Output/Probes/spot/Type=Point",
                             "Output/Probes/spot/Place={0.3, 0.7}", "Output/Probes/cut/Type=Line", "Output/Probes/cut/From={0, 0}",
                             "Output/Probes/cut/To={2, 1}", "Output/Probes/cut/Points=5", "Output/Probes/end/Type=Group",
                             "Output/Probes/end/Group=bar_right"}));
  simulation.writeInto(folder);
  simulation.solve();
  TEST_ASSERT(simulation.report().code == ExitCode::Done);
  if (blocks::world()->getRank() != 0) return;
  const auto check = [&](const std::vector<std::string>& row, double arc, double x, double y) {
    TEST_EQUALITY(row.size(), 19);
    TEST_EQUALITY(row[4], "bar");
    const double values[] = {arc, x, y, (1 - poisson * poisson) * pull / young * x, -poisson * (1 + poisson) * pull / young * y, pull};
    const int columns[] = {0, 1, 2, 5, 6, 8};
    for (int k = 0; k < 6; ++k) TEST_COMPARE(std::abs(std::stod(row[columns[k]]) - values[k]), <, 1e-8 * (k == 5 ? pull : 1.0));
    TEST_COMPARE(std::abs(std::stod(row[10]) - poisson * pull), <, 1e-8 * pull);
    TEST_EQUALITY(row[17] + row[18], "");  // no contact
  };
  const auto spot = rowsOf(folder + "/probe_spot.csv"), cut = rowsOf(folder + "/probe_cut.csv"), end = rowsOf(folder + "/probe_end.csv");
  TEST_EQUALITY(spot.size(), 2);
  TEST_EQUALITY(cut.size(), 6);
  TEST_EQUALITY(end.size(), 6);
  check(spot.at(1), 0, 0.3, 0.7);
  for (int i = 0; i < 5; ++i) {
    check(cut.at(i + 1), std::sqrt(5.0) * i / 4, 0.5 * i, 0.25 * i);
    check(end.at(i + 1), 0.25 * i, 2, 0.25 * i);
  }
}

TEUCHOS_UNIT_TEST(Probes, AlongAContactHaveItsPressures) {
  const std::string folder = "probes_contact_" + std::to_string(blocks::world()->getSize()) + "_out";
  Simulation simulation(blocks::world(),
                        pressed({"Outer Solver/Tolerance=1e-10", "Output/Probes/upper/Type=Group", "Output/Probes/upper/Group=upper_bottom",
                                 "Output/Probes/lower/Type=Group", "Output/Probes/lower/Group=lower_top"}));
  simulation.writeInto(folder);
  simulation.solve();
  simulation.report();
  if (blocks::world()->getRank() != 0) return;
  std::vector<double> found, expected;
  for (const char* side : {"upper", "lower"}) {
    auto rows = rowsOf(folder + "/probe_" + side + ".csv");
    rows.erase(rows.begin());
    for (const auto& row : rows)
      if (!row.at(18).empty()) found.push_back(std::stod(row[18]));
  }
  for (const PairResult& pair : simulation.solution().pairs) expected.push_back(pair.pressure);
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  TEST_EQUALITY(found.size(), expected.size());
  for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) TEST_COMPARE(std::abs(found[i] - expected[i]), <, 1e-8 * 1e4);
}

TEUCHOS_UNIT_TEST(Probes, OutsideTheBodiesAreRefusedBeforeAnythingIsSolved) {
  for (const char* place : {"{3, 0.5}", "{-1e-3, -1}"}) {
    PartitionedScene scene =
        cut(read(RunContext(blocks::world()), bar(Load::traction("bar_right", {1, 0, 0}),
                                                  {"Output/Probes/far/Type=Point", std::string("Output/Probes/far/Place=") + place})));
    TEST_THROW(check(std::move(scene)), InputError);
  }
}

TEUCHOS_UNIT_TEST(Largest, ReportsTheFirstOfEqualPlacesInAnyOrder) {
  const auto at = [](double x) { return [x] { return Point{x, 0, 0}; }; };
  Largest forwards, backwards, whole;
  const std::vector<double> values{0.5, 1.0, 1.0 + 1e-9, 0.999, 1.0 + 2e-9, 1.0 - 1e-8};
  for (std::size_t i = 0; i < values.size(); ++i) forwards.take(values[i], 0, GlobalId(i), at(double(i)));
  for (std::size_t i = values.size(); i-- > 0;) backwards.take(values[i], 0, GlobalId(i), at(double(i)));
  whole.take(backwards);
  for (const Largest* one : {&forwards, &backwards, &whole}) {
    TEST_EQUALITY(one->found().value, 1.0 + 2e-9);
    TEST_EQUALITY(one->found().id, 1);
    TEST_EQUALITY(one->found().place[0], 1.0);
  }
  Largest negative;
  for (const double value : {-3.0, -1.0, -2.0}) negative.take(value, 2, 7, at(value));
  TEST_EQUALITY(negative.found().value, -1.0);
  TEST_ASSERT(!Largest().found().exists());
}

}  // namespace
}  // namespace suture
