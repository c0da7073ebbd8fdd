#include <Teuchos_Comm.hpp>
#include <Teuchos_ParameterList.hpp>
#include <filesystem>
#include <set>
#include <suture/base/Collective.hpp>
#include <suture/report/ContactFields.hpp>
#include <suture/report/Fields.hpp>
#include <suture/report/History.hpp>
#include <suture/report/Report.hpp>
#include <suture/report/Summary.hpp>
#include <suture/report/answers/Probes.hpp>
#include <suture/report/answers/Tables.hpp>
#include <suture/report/answers/Transmissions.hpp>

namespace suture {
namespace {

/// \param choice  parameter of the list `Output`, true by default
bool wants(const Parameters& scene, const char* choice) {
  return !scene.isSublist("Output") || !scene.sublist("Output").isType<bool>(choice) || scene.sublist("Output").get<bool>(choice);
}

const char* const fieldFiles[] = {"fields_0000.vtkhdf", "contact_0000.vtkhdf"};
const char* const tables[] = {"contact.csv", "reactions.csv", "steps.csv"};
/// Files whose names contain names of the scene.
bool isNamedTable(const std::string& name) {
  return (name.rfind("probe_", 0) == 0 || name.rfind("transmission_", 0) == 0) && name.size() > 4 &&
         name.compare(name.size() - 4, 4, ".csv") == 0;
}

/// A folder in the output folder for incomplete files; its remaining content is removed at the end. Collective except its destructor.
class Staging {
 public:
  Staging(const Comm& comm, const std::filesystem::path& folder) : isRoot_(comm.getRank() == 0), path_(folder / ".new") {
    collectivelyOnRoot(comm, "preparing the results", [&] {
      std::error_code error;
      std::filesystem::remove_all(path_, error);
      std::filesystem::create_directory(path_, error);
      if (error) throw EnvironmentError("cannot create the folder '" + path_.string() + "': " + error.message());
    });
  }
  ~Staging() {
    std::error_code ignored;
    if (isRoot_) std::filesystem::remove_all(path_, ignored);
  }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  std::string operator/(const char* name) const { return (path_ / name).string(); }
  const std::filesystem::path& path() const { return path_; }

  /// Replaces the files of an earlier run by the new ones, summary.json last. On rank 0.
  /// \param inSteps  fields of load steps are already in place and stay
  void moveTo(const std::filesystem::path& folder, bool inSteps) const {
    std::error_code error;
    std::filesystem::remove(folder / "summary.json", error);
    const auto move = [&](const std::string& name) {
      std::filesystem::rename(path_ / name, folder / name, error);
      if (error) throw EnvironmentError("cannot move '" + (folder / name).string() + "' into place: " + error.message());
    };
    std::set<std::string> names{tables[0], tables[1], tables[2]};
    if (!inSteps) {
      names.insert({fieldFiles[0], fieldFiles[1]});
      removeStepFields(folder.string(), 0);
    }
    for (const std::filesystem::path& place : {folder, path_})  // tables of an earlier run and of this one
      for (const auto& entry : std::filesystem::directory_iterator(place, error))
        if (isNamedTable(entry.path().filename().string())) names.insert(entry.path().filename().string());
    for (const std::string& name : names) {
      if (std::filesystem::exists(path_ / name, error))
        move(name);
      else
        std::filesystem::remove(folder / name, error);
    }
    move("history.csv");
    move("summary.json");
    std::filesystem::remove(folder / "summary.previous.json", error);
  }
  /// Removes the summary after a late failure of the run.
  void withdraw(const std::filesystem::path& folder) const {
    std::error_code ignored;
    if (isRoot_) std::filesystem::remove(folder / "summary.json", ignored);
  }

 private:
  bool isRoot_;
  std::filesystem::path path_;
};

}  // namespace

bool wantsFields(const Parameters& scene) { return wants(scene, "Fields"); }

Written writeReport(const Run& run, ExitCode code) {
  const std::filesystem::path folder(run.folder);
  const Staging staging(run.comm, folder);
  {
    const Timers::Scope write(run.timers, "write");
    if (run.steps.empty() && wantsFields(*run.scene.parameters)) {
      writeFields(run, staging / fieldFiles[0]);
      if (run.size.pairs > 0) writeContactFields(run, staging / fieldFiles[1]);
    }
    if (wants(*run.scene.parameters, "Tables"))
      collectivelyOnRoot(run.comm, "writing tables", [&] {
        if (run.size.pairs > 0) writeContactTable(run, staging / tables[0]);
        writeReactionTable(run, staging / tables[1]);
      });
    writeProbes(run, readProbes(*run.scene.parameters, run.model.bodies), staging.path().string());
    collectivelyOnRoot(run.comm, "writing history.csv", [&] {
      writeHistory(run.monitor.rows(), staging / "history.csv");
      if (!run.steps.empty()) writeSteps(run.steps, run.contactsOfPath, staging / tables[2]);
      writeTransmissions(run.steps, readTransmissions(*run.scene.parameters), staging.path().string());
    });
  }
  Written written{{}, runFigures(run)};
  written.summary = writeSummary(run, written.figures, code, staging / "summary.json");
  try {
    collectivelyOnRoot(run.comm, "moving the results into place", [&] { staging.moveTo(folder, !run.steps.empty()); });
  } catch (...) {
    staging.withdraw(folder);
    throw;
  }
  return written;
}

}  // namespace suture
