#include <Teuchos_ParameterList.hpp>
#include <filesystem>
#include <suture/base/Collective.hpp>
#include <suture/report/ContactFields.hpp>
#include <suture/report/Fields.hpp>
#include <suture/report/History.hpp>
#include <suture/report/Report.hpp>
#include <suture/report/Summary.hpp>

namespace suture {
namespace {

bool wantsFields(const Parameters& scene) {
  return !scene.isSublist("Output") || !scene.sublist("Output").isType<bool>("Fields") || scene.sublist("Output").get<bool>("Fields");
}

}  // namespace

std::string writeReport(const Run& run, ExitCode code) {
  const std::filesystem::path folder(run.folder);
  const std::string fields = (folder / "fields_0000.vtkhdf").string();
  const std::string contact = (folder / "contact_0000.vtkhdf").string();
  {
    const Timers::Scope write(run.timers, "write");
    // summary.json is written last: while it is missing, the folder is not that of a finished run.
    collectivelyOnRoot(run.comm, "clearing the output folder", [&] {
      for (const auto& old : {fields, contact, (folder / "summary.json").string()}) {
        std::error_code ignored;
        std::filesystem::remove(old, ignored);
      }
    });
    if (wantsFields(*run.scene.parameters)) {
      writeFields(run, fields);
      if (run.size.pairs > 0) writeContactFields(run, contact);
    }
    collectivelyOnRoot(run.comm, "writing history.csv", [&] { writeHistory(run.monitor.rows(), (folder / "history.csv").string()); });
  }
  return writeSummary(run, code, (folder / "summary.json").string());
}

}  // namespace suture
