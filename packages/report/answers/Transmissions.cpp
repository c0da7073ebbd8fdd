#include <nlohmann/json.hpp>
#include <suture/base/Errors.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/answers/Tables.hpp>
#include <suture/report/answers/Transmissions.hpp>

#include <Teuchos_ParameterList.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

namespace suture {

namespace {

const std::vector<std::string>& motionNames() {
  static const std::vector<std::string> all{"Motion x", "Motion y", "Motion z", "Rotation x", "Rotation y", "Rotation z"};
  return all;
}

std::vector<std::string> rigidGroupsOf(const Parameters& scene) {
  std::vector<std::string> names;
  if (!scene.isSublist("Boundary Conditions")) return names;
  const Parameters& list = scene.sublist("Boundary Conditions");
  for (const std::string& name : sublistNames(list)) {
    const Parameters& condition = list.sublist(name);
    if (condition.isType<std::string>("Type") && condition.get<std::string>("Type") == "Rigid Group") names.push_back(name);
  }
  return names;
}

Transmission::Side sideOf(const Parameters& list, const std::string& name, const std::vector<std::string>& groups, int dimension,
                          Problems& problems) {
  const auto group = list.get<std::string>(name), motion = list.get<std::string>(name + " Motion");
  const std::string path = pathOf(list) + "/" + name;
  if (groups.empty())
    problems.add(path, "the scene has no boundary condition with Type = Rigid Group, whose motion could be tabulated");
  else if (!std::count(groups.begin(), groups.end(), group))
    problems.add(path, unknownName("rigid group", group, groups));
  if (dimension == 2 && motion != "Motion x" && motion != "Motion y" && motion != "Rotation z")
    problems.add(path + " Motion", "'" + motion + "' does not exist in 2D; expected Motion x, Motion y or Rotation z");
  const auto place = static_cast<std::size_t>(std::find(motionNames().begin(), motionNames().end(), motion) - motionNames().begin());
  return {group, place >= 3, place % 3};
}

const StepRow::Group* groupIn(const StepRow& row, const std::string& name) {
  const auto found = std::find_if(row.groups.begin(), row.groups.end(), [&](const StepRow::Group& one) { return one.name == name; });
  return found == row.groups.end() ? nullptr : &*found;
}

double motionOf(const StepRow::Group& group, const Transmission::Side& side) {
  return (side.rotates ? group.rotation : group.displacement)[side.axis];
}

double loadOf(const StepRow::Group& group, const Transmission::Side& side) {
  return (side.rotates ? group.moment : group.force)[side.axis];
}

}  // namespace

std::string Transmission::fileName() const { return tableName("transmission", name); }

Schema transmissionSchema() {
  return Schema("Table transmission_<name>.csv: motions and loads of two rigid groups over the load steps, and the transmission error.")
      .text("Driving", std::nullopt, "A boundary condition with Type = Rigid Group")
      .oneOf("Driving Motion", "Rotation z", motionNames(), "The motion of its point that drives")
      .text("Driven", std::nullopt, "The Rigid Group that follows")
      .oneOf("Driven Motion", "Rotation z", motionNames(), "The motion of its point that follows")
      .real("Ratio", std::nullopt,
            "Motion of the driven group over that of the driving one, if bodies were rigid: -z1 / z2 of two gears with external teeth. The "
            "transmission error is the driven motion minus Ratio times the driving one");
}

std::vector<Transmission> readTransmissions(const Parameters& scene) {
  std::vector<Transmission> all;
  if (!scene.isSublist("Output") || !scene.sublist("Output").isSublist("Transmissions")) return all;
  const Parameters& list = scene.sublist("Output").sublist("Transmissions");
  const std::vector<std::string> names = sublistNames(list);
  if (names.empty()) return all;
  Problems problems;
  const std::vector<std::string> groups = rigidGroupsOf(scene);
  if (!scene.isSublist("Load Steps") || !scene.sublist("Load Steps").isParameter("Times") ||
      scene.sublist("Load Steps").get<Teuchos::Array<double>>("Times").empty())
    problems.add(pathOf(list), "needs Load Steps/Times: a transmission has one row per load step");
  std::map<std::string, std::string> files;
  for (const std::string& name : names) {
    const Parameters& entry = list.sublist(name);
    const int dimension = sceneDimension(scene);
    Transmission one{name, pathOf(entry), sideOf(entry, "Driving", groups, dimension, problems),
                     sideOf(entry, "Driven", groups, dimension, problems), entry.get<double>("Ratio")};
    const auto [at, isNew] = files.emplace(one.fileName(), name);
    if (!isNew)
      problems.add(one.path, "writes the same file " + at->first + " as the transmission '" + at->second + "'; rename one of them");
    all.push_back(std::move(one));
  }
  problems.throwIfAny();
  return all;
}

std::vector<TransmissionRow> transmissionRows(const std::vector<StepRow>& steps, const Transmission& transmission) {
  std::vector<TransmissionRow> rows;
  for (const StepRow& step : steps) {
    const StepRow::Group* driving = groupIn(step, transmission.driving.group);
    const StepRow::Group* driven = groupIn(step, transmission.driven.group);
    if (!driving || !driven) continue;
    TransmissionRow row;
    row.step = step.step;
    row.time = step.time;
    row.driving = motionOf(*driving, transmission.driving);
    row.driven = motionOf(*driven, transmission.driven);
    row.error = row.driven - transmission.ratio * row.driving;
    row.drivingLoad = loadOf(*driving, transmission.driving);
    row.drivenLoad = loadOf(*driven, transmission.driven);
    rows.push_back(row);
  }
  return rows;
}

double transmissionEfficiency(const std::vector<TransmissionRow>& rows) {
  double input = 0.0, output = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    input += 0.5 * (rows[i].drivingLoad + rows[i - 1].drivingLoad) * (rows[i].driving - rows[i - 1].driving);
    output -= 0.5 * (rows[i].drivenLoad + rows[i - 1].drivenLoad) * (rows[i].driven - rows[i - 1].driven);
  }
  return input == 0.0 ? std::numeric_limits<double>::quiet_NaN() : output / input;
}

void writeTransmissions(const std::vector<StepRow>& steps, const std::vector<Transmission>& transmissions, const std::string& folder) {
  for (const Transmission& transmission : transmissions) {
    std::string text = "step,time,driving,driven,error,driving_load,driven_load\n";
    for (const TransmissionRow& row : transmissionRows(steps, transmission))
      text += format("%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", row.step, row.time, row.driving, row.driven, row.error, row.drivingLoad,
                     row.drivenLoad);
    writeTextFile((std::filesystem::path(folder) / transmission.fileName()).string(), text);
  }
}

nlohmann::ordered_json transmissionsJson(const std::vector<StepRow>& steps, const std::vector<Transmission>& transmissions) {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const Transmission& transmission : transmissions) {
    const std::vector<TransmissionRow> rows = transmissionRows(steps, transmission);
    nlohmann::ordered_json& one = all[transmission.name];
    if (rows.empty()) {
      one = {{"error_min", nullptr}, {"error_max", nullptr}, {"efficiency", nullptr}};
      continue;
    }
    const auto [least, largest] =
        std::minmax_element(rows.begin(), rows.end(), [](const TransmissionRow& a, const TransmissionRow& b) { return a.error < b.error; });
    const double efficiency = transmissionEfficiency(rows);
    one = {{"error_min", least->error}, {"error_max", largest->error}};
    one["efficiency"] = std::isfinite(efficiency) ? nlohmann::ordered_json(efficiency) : nlohmann::ordered_json();
  }
  return all;
}

}  // namespace suture
