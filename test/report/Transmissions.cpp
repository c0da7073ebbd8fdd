#include <suture/base/Errors.hpp>
#include <suture/report/answers/Transmissions.hpp>

#include <Teuchos_UnitTestHarness.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

using namespace suture;

namespace {

StepRow::Group groupAt(const std::string& name, const Point& displacement, const Point& rotation, const Point& force, const Point& moment) {
  return {name, displacement, rotation, force, moment};
}

// A rack (force along x) driven by a pinion of radius 2 that turns by `angle` about z against a load of 10: it lags by 0.01
// sin(angle).
StepRow rackAt(int step, double angle) {
  StepRow row;
  row.step = step;
  row.time = 0.5 * step;
  row.groups = {groupAt("other", {7, 7, 7}, {7, 7, 7}, {7, 7, 7}, {7, 7, 7}),
                groupAt("pinion", {0, 0, 0}, {0, 0, angle}, {1, 2, 3}, {4, 5, 20}),
                groupAt("rack", {-2 * angle + 0.01 * std::sin(angle), 0, 0}, {0, 0, 0}, {10, 0, 0}, {6, 6, 6})};
  return row;
}

Transmission rackAndPinion() { return {"rack", "Output/Transmissions/rack", {"pinion", true, 2}, {"rack", false, 0}, -2.0}; }

TEUCHOS_UNIT_TEST(Transmissions, SubtractTheRatioTimesTheDrivingMotion) {
  const std::vector<StepRow> steps{rackAt(1, 0.0), rackAt(2, 0.3), rackAt(3, 1.0)};
  const std::vector<TransmissionRow> rows = transmissionRows(steps, rackAndPinion());
  TEST_EQUALITY(rows.size(), 3u);
  const double angles[] = {0.0, 0.3, 1.0};
  for (std::size_t i = 0; i < 3; ++i) {
    TEST_EQUALITY(rows[i].step, int(i) + 1);
    TEST_EQUALITY(rows[i].driving, angles[i]);
    TEST_COMPARE(std::abs(rows[i].error - 0.01 * std::sin(angles[i])), <, 1e-15);
    TEST_EQUALITY(rows[i].drivingLoad, 20);
    TEST_EQUALITY(rows[i].drivenLoad, 10);
  }
  const nlohmann::ordered_json summary = transmissionsJson(steps, {rackAndPinion()});
  TEST_EQUALITY(summary["rack"]["error_min"].get<double>(), 0.0);
  TEST_COMPARE(std::abs(summary["rack"]["error_max"].get<double>() - 0.01 * std::sin(1.0)), <, 1e-15);
}

TEUCHOS_UNIT_TEST(Transmissions, HaveTheEfficiencyOfTheirWorks) {
  // The pinion puts in 20 over 1 rad, the rack delivers 10 over 2 - 0.01 sin 1.
  const std::vector<TransmissionRow> rows = transmissionRows({rackAt(1, 0.0), rackAt(2, 0.3), rackAt(3, 1.0)}, rackAndPinion());
  TEST_COMPARE(std::abs(transmissionEfficiency(rows) - (2 - 0.01 * std::sin(1.0)) / 2), <, 1e-15);
  TEST_ASSERT(std::isnan(transmissionEfficiency(transmissionRows({rackAt(1, 0.2)}, rackAndPinion()))));
  TEST_ASSERT(transmissionsJson({rackAt(1, 0.2)}, {rackAndPinion()})["rack"]["efficiency"].is_null());
}

TEUCHOS_UNIT_TEST(Transmissions, LeaveOutStepsWithoutTheirGroups) {
  std::vector<StepRow> steps{rackAt(1, 0.0), rackAt(2, 0.3)};
  steps[0].groups.pop_back();
  TEST_EQUALITY(transmissionRows(steps, rackAndPinion()).size(), 1u);
  TEST_ASSERT(transmissionsJson({}, {rackAndPinion()})["rack"]["error_max"].is_null());
}

TEUCHOS_UNIT_TEST(Transmissions, NameTheirFiles) {
  Transmission one = rackAndPinion();
  one.name = "gear 1/2";
  TEST_EQUALITY(one.fileName(), "transmission_gear_1_2.csv");
}

}  // namespace
