#include <nlohmann/json.hpp>
#include <suture/base/Collective.hpp>
#include <suture/base/Errors.hpp>
#include <suture/report/ContactFields.hpp>
#include <suture/report/Fields.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/OutputFolder.hpp>
#include <suture/report/Steps.hpp>
#include <suture/report/answers/Tables.hpp>

#include <Teuchos_Comm.hpp>

#include <filesystem>

namespace suture {

namespace {

constexpr const char* kKinds[] = {"fields", "contact"};
constexpr const char* kEnding = ".vtkhdf";

std::string nameOfStep(const char* kind, std::size_t place) { return format("%s_%04zu%s", kind, place, kEnding); }

/// Index of the step of a field file; -1 if the file is not a field file.
long placeOfStep(const std::string& name, const std::string& kind) {
  const std::string begin = kind + "_", end = kEnding;
  if (name.size() <= begin.size() + end.size() || name.compare(0, begin.size(), begin) != 0 ||
      name.compare(name.size() - end.size(), end.size(), end) != 0)
    return -1;
  const std::string digits = name.substr(begin.size(), name.size() - begin.size() - end.size());
  return digits.find_first_not_of("0123456789") == std::string::npos ? std::stol(digits) : -1;
}

/// ParaView's file series: names of the existing files and their times. Steps without contact pairs have no file of contact.
std::string seriesOf(const std::filesystem::path& folder, const char* kind, const std::vector<StepRow>& rows) {
  nlohmann::ordered_json files = nlohmann::ordered_json::array();
  std::error_code ignored;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::filesystem::exists(folder / nameOfStep(kind, i), ignored))
      files.push_back({{"name", nameOfStep(kind, i)}, {"time", rows[i].time}});
  return nlohmann::ordered_json{{"file-series-version", "1.0"}, {"files", files}}.dump(2) + "\n";
}

}  // namespace

void writeSteps(const std::vector<StepRow>& rows, const std::vector<std::string>& contacts, const std::string& path) {
  std::string text =
      "step,time,length,outer,pcg,given_up,active,sticking,slipping,changed,residual,energy,external_work,stored_energy,normal_work,"
      "tangential_work,dissipated_work,work_imbalance,step_error,seconds";
  for (const std::string& contact : contacts)
    for (const char* component : {"x", "y", "z"}) text += "," + csvField("force " + contact + " " + component);
  text += "\n";
  for (const StepRow& row : rows) {
    text += format("%d,%.17g,%.17g,%d,%d,%d,%d,%d,%d,%d,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.3g,%.3g,%.6f", row.step, row.time,
                   row.length, row.outer, row.pcg, row.givenUp, row.active, row.sticking, row.slipping, row.changed, row.residual,
                   row.energy, row.work.external, row.work.stored, row.work.normal, row.work.tangential, row.work.dissipated,
                   row.work.imbalance(), row.work.stepError(), row.seconds);
    for (const Point& force : row.forceOnB) text += format(",%.17g,%.17g,%.17g", force[0], force[1], force[2]);
    text += "\n";
  }
  writeTextFile(path, text);
}

void writeFrames(const std::vector<StepRow>& rows, const std::vector<std::string>& bodies, const std::string& path) {
  std::string text = "step,time,body,displacement_x,displacement_y,displacement_z,rotation_x,rotation_y,rotation_z\n";
  for (const StepRow& row : rows)
    for (const StepRow::Frame& frame : row.frames)
      text += format("%d,%.17g,", row.step, row.time) + csvField(bodies[static_cast<std::size_t>(frame.body)]) +
              format(",%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", frame.displacement[0], frame.displacement[1], frame.displacement[2],
                     frame.rotation[0], frame.rotation[1], frame.rotation[2]);
  writeTextFile(path, text);
}

void writeRigidGroups(const std::vector<StepRow>& rows, const std::string& path) {
  std::string text = "step,time,group,displacement_x,displacement_y,displacement_z,rotation_x,rotation_y,rotation_z,fx,fy,fz,mx,my,mz\n";
  for (const StepRow& row : rows)
    for (const StepRow::Group& group : row.groups) {
      text += format("%d,%.17g,", row.step, row.time) + csvField(group.name);
      for (const Point* vector : {&group.displacement, &group.rotation, &group.force, &group.moment})
        text += format(",%.17g,%.17g,%.17g", (*vector)[0], (*vector)[1], (*vector)[2]);
      text += "\n";
    }
  writeTextFile(path, text);
}

void writeStepFields(const Run& run, const std::vector<StepRow>& rows) {
  const std::filesystem::path folder(run.folder);
  for (const char* kind : kKinds) {
    const bool ofContact = kind == kKinds[1];
    if (ofContact && run.size.pairs == 0) continue;
    const std::string name = nameOfStep(kind, rows.size() - 1), path = (folder / name).string(), unfinished = path + ".new";
    if (ofContact)
      writeContactFields(run, unfinished);
    else
      writeFields(run, unfinished);
    collectivelyOnRoot(run.comm, "moving fields into place", [&] {
      std::error_code error;
      std::filesystem::rename(unfinished, path, error);
      if (error) throw EnvironmentError("cannot move '" + path + "' into place: " + error.message());
      writeTextFile((folder / (std::string(kind) + kEnding + ".series")).string(), seriesOf(folder, kind, rows));
    });
  }
}

void removeStepFields(const std::string& folder, std::size_t kept) {
  std::error_code ignored;
  std::vector<std::filesystem::path> old;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    for (const char* kind : kKinds) {
      const std::string name = entry.path().filename().string();
      if (placeOfStep(name, kind) >= static_cast<long>(kept) || (kept == 0 && name == std::string(kind) + kEnding + ".series"))
        old.push_back(entry.path());
    }
  for (const auto& path : old) std::filesystem::remove(path, ignored);
}

}  // namespace suture
