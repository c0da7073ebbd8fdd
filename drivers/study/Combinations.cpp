#include "Combinations.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <suture/base/Collective.hpp>
#include <suture/base/Numbers.hpp>
#include <suture/report/ParametersJson.hpp>
#include <suture/report/SceneSchema.hpp>
#include <suture/simulation/Overrides.hpp>
#include <suture/solver/Method.hpp>

#include "../support/TellingOverrides.hpp"

namespace suture::study {
namespace {

Combination combine(const Study& study, const std::vector<std::string>& set, const std::vector<std::size_t>& choice) {
  Combination run;
  run.choice = choice;
  std::string scene = study.scene;
  const auto add = [&](const std::string& assignment, const std::string& origin) {
    if (overridePath(assignment) == "Scene") {
      scene = trimmed(assignment.substr(assignment.find('=') + 1));
      return;
    }
    run.overrides.push_back(assignment);
    run.origins.push_back(origin);
  };
  for (const std::string& assignment : study.set)
    if (std::none_of(set.begin(), set.end(), [&](const std::string& other) { return overridePath(other) == overridePath(assignment); }))
      add(assignment, "Set");
  for (std::size_t s = 0; s < study.sweeps.size(); ++s)
    for (const Parameter& parameter : study.sweeps[s].parameters)
      if (parameter.values[choice[s]] != kUnchanged)
        add(parameter.path + "=" + parameter.values[choice[s]], "Sweeps/" + study.sweeps[s].name + "/" + parameter.name);
  for (const std::string& assignment : set) add(assignment, "--set");
  // Last, so that messages about the user's paths come first.
  add(std::string("Output/Fields=") + (study.fields ? "true" : "false"), "Fields");
  run.scene = (std::filesystem::path(study.file.folder) / scene).lexically_normal().string();
  return run;
}

// Checks that the scene's parameters used in columns exist.
void checkParameterColumns(const Study& study, const Parameters& scene, Problems& problems) {
  nlohmann::ordered_json summary;
  summary["parameters"] = toJson(scene);
  for (const Column& column : study.columns)
    for (const std::string& path : column.formula.paths())
      if (path.rfind("parameters.", 0) == 0 && !findEntry(summary, path))
        problems.add("Columns", "the scene has no parameter '" + path.substr(path.find('.') + 1) + "' (names between dots)");
}

}  // namespace

std::vector<Combination> combinations(const Study& study, const std::vector<std::string>& set, const Filter& only, Problems& problems) {
  for (const std::string& assignment : set)
    for (const Sweep& sweep : study.sweeps)
      for (const Parameter& parameter : sweep.parameters)
        if (parameter.path == overridePath(assignment))
          problems.add("--set", "'" + parameter.path + "' is varied by the sweep '" + sweep.name + "'");

  std::vector<Combination> runs;
  std::vector<std::size_t> choice(study.sweeps.size(), 0);
  for (int number = 1;; ++number) {
    if (passes(only, study.sweeps, choice)) {
      runs.push_back(combine(study, set, choice));
      runs.back().number = number;
    }
    std::size_t s = choice.size();
    while (s > 0 && ++choice[s - 1] == study.sweeps[s - 1].labels.size()) choice[--s] = 0;
    if (s == 0) return runs;
  }
}

namespace {

// Scene files, each read once, if readable.
class SceneTexts {
 public:
  SceneTexts(const Comm& comm, const Schema& schema) : comm_(comm), schema_(schema) {}

  SceneFile scene(const Combination& run) {
    const auto known = texts_.find(run.scene);
    if (known == texts_.end()) {
      const SceneFile scene = readScene(comm_, run.scene, schema_, run.overrides);
      texts_[run.scene] = scene.text;
      return scene;
    }
    SceneFile scene;  // may use other files, which every rank reads
    collectively(comm_, "reading " + run.scene, [&] { scene = parseScene(known->second, run.scene, schema_, run.overrides); });
    return scene;
  }

 private:
  const Comm& comm_;
  const Schema& schema_;
  std::map<std::string, std::string> texts_;
};

}  // namespace

void checkRuns(const Comm& comm, const Study& study, const std::vector<Combination>& runs) {
  const Schema schema = sceneSchema();
  SceneTexts texts(comm, schema);
  std::set<std::pair<std::string, std::string>> known;
  Problems problems;
  const auto add = [&](const Problem& problem, const std::string& origin) {
    if (known.emplace(origin, problem.path + problem.message).second)
      problems.add(origin, origin == problem.path ? problem.message : problem.path + ": " + problem.message);
  };
  for (const Combination& run : runs) {
    try {
      const SceneFile scene = texts.scene(run);
      makeMethod(*scene.parameters, scene.parameters->sublist("Contact").numParams() > 0);
      Problems columns;
      if (&run == &runs.front()) checkParameterColumns(study, *scene.parameters, columns);
      for (const Problem& problem : columns.list()) add(problem, problem.path);
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems()) {
        const int i = overrideOf(problem, run.overrides);
        add(problem, problem.path == run.scene ? "Scene" : i < 0 ? run.scene : run.origins[i]);
      }
    }
  }
  problems.throwIfAny();
}

std::string labelsOf(const Study& study, const Combination& run) {
  std::string text;
  for (std::size_t s = 0; s < study.sweeps.size(); ++s)
    text += (text.empty() ? "" : "  ") + study.sweeps[s].name + "=" + study.sweeps[s].labels[run.choice[s]];
  return text;
}

Filter readOnly(const Study& study, const std::vector<std::string>& only, Problems& problems) {
  Filter filter;
  std::vector<std::string> labels;
  for (const Sweep& sweep : study.sweeps) labels.insert(labels.end(), sweep.labels.begin(), sweep.labels.end());
  for (const std::string& text : only) {
    std::vector<std::string> owners;
    for (const Sweep& sweep : study.sweeps)
      if (std::find(sweep.labels.begin(), sweep.labels.end(), text) != sweep.labels.end()) owners.push_back(sweep.name);
    if (owners.size() == 1)
      filter[owners.front()].push_back(text);
    else if (owners.size() > 1)
      problems.add("--only", "'" + text + "' is a label of several sweeps (" + joinNames(owners) + "); expected sweep=label");
    else if (text.find('=') != std::string::npos)
      addToFilter(text, study.sweeps, "--only", filter, problems);
    else
      problems.add("--only", unknownName("label", text, labels));
  }
  return filter;
}

}  // namespace suture::study
