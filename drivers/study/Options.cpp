#include "Options.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>

#include "../support/CommandLine.hpp"

namespace suture::study {

std::optional<int> Options::parse(int argc, char* argv[]) {
  commandLine.assign(argv, argv + argc);
  std::vector<std::string> set;
  const auto describe = [&](CLI::App& app) {
    app.add_option("STUDY", study, "Study file (XML); 'suture_schema --study' documents it")->required()->type_name("FILE");
    app.add_option("--output", output, "Output folder; default: studies_out/<study> next to the study")->type_name("DIR");
    addSetOption(app, set,
                 "Change a parameter of the scene in every run, or with the prefix 'Study/' one of the study, e.g. "
                 "--set Study/Repetitions=3");
    app.add_option("--only", only, "Run only the combinations with this label ('label' or 'sweep=label'); may be repeated")
        ->type_name("LABEL")
        ->allow_extra_args(false);
    app.add_flag("--check", check, "Check the study and the parameters of all runs and list the runs without running them");
    app.add_flag("--continue", goOn, "Continue an interrupted study; keeps the finished runs in its output folder");
    app.add_flag("--quiet", quiet, "Print only errors and missed bands");
    addPluginOption(app, plugins);
    app.footer(
        "Exit codes: 0 done, 2 command line, 3 input, 4 a run failed or a band was missed, 5 environment (memory, files, libraries),\n"
        "70 a bug in Suture, 75 stopped on request.");
  };
  const auto end =
      parseCommandLine(argc, argv, "suture_study", "Runs a scene with different values of its parameters and writes one table.", describe);
  const std::string prefix = "Study/";
  for (const std::string& assignment : set) {
    if (assignment.compare(0, prefix.size(), prefix) == 0)
      ofTheStudy.push_back(assignment.substr(prefix.size()));
    else
      overrides.push_back(assignment);
  }
  return end;
}

std::string Options::folder() const {
  if (!output.empty()) return output;
  const std::filesystem::path file(study);
  return (file.parent_path() / "studies_out" / file.stem()).string();
}

}  // namespace suture::study
