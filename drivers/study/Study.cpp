#include "Study.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <filesystem>
#include <set>
#include <suture/base/Numbers.hpp>
#include <suture/simulation/Overrides.hpp>

#include "Schema.hpp"

namespace suture::study {
namespace {

std::vector<std::string> texts(const Parameters& list, const std::string& name) {
  return list.get<Teuchos::Array<std::string>>(name).toVector();
}

std::vector<std::string> names(const std::vector<Sweep>& sweeps) {
  std::vector<std::string> all;
  for (const Sweep& sweep : sweeps) all.push_back(sweep.name);
  return all;
}

void checkLabels(const Sweep& sweep, const std::string& path, Problems& problems) {
  std::set<std::string> seen;
  for (const std::string& label : sweep.labels) {
    if (!seen.insert(label).second)
      problems.add(path, "the label '" + label + "' occurs twice; labels must differ" +
                             (sweep.parameters.size() > 1 ? " (set them by Labels)" : ""));
    if (label.find('|') != std::string::npos)
      problems.add(path, "the label '" + label + "' contains '|', which separates labels in filters");
  }
}

Sweep readSweep(const Parameters& list, const std::string& name, Problems& problems) {
  Sweep sweep{name, texts(list, "Labels"), {}};
  for (const std::string& parameter : sublistNames(list)) {
    const Parameters& own = list.sublist(parameter);
    sweep.parameters.push_back({parameter, overridePath(own.get<std::string>("Path")), texts(own, "Values")});
    const Parameter& last = sweep.parameters.back();
    const Parameter& first = sweep.parameters.front();
    if (last.values.empty()) problems.add(pathOf(own, "Values"), "is empty; expected at least one value");
    if (last.values.size() != first.values.size())
      problems.add(pathOf(own, "Values"), "has " + std::to_string(last.values.size()) + " values, but '" + first.name +
                                              "' of the same sweep has " + std::to_string(first.values.size()) +
                                              ": parameters of one sweep vary together");
  }
  if (sweep.parameters.empty()) return sweep;  // reported by the schema
  const std::size_t count = sweep.parameters.front().values.size();
  if (!sweep.labels.empty() && sweep.labels.size() != count)
    problems.add(pathOf(list, "Labels"),
                 "has " + std::to_string(sweep.labels.size()) + " labels for " + std::to_string(count) + " values; expected one per value");
  if (sweep.labels.empty()) {
    sweep.labels.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<std::string> different;  // one word for parameters that always have equal values
      for (const Parameter& parameter : sweep.parameters)
        if (i < parameter.values.size() && std::find(different.begin(), different.end(), parameter.values[i]) == different.end())
          different.push_back(parameter.values[i]);
      for (const std::string& value : different) sweep.labels[i] += (sweep.labels[i].empty() ? "" : " ") + value;
    }
  }
  checkLabels(sweep, pathOf(list), problems);
  return sweep;
}

// Checks that each path of the scene is changed in one place only; otherwise a sweep could be overridden and compare a run with itself.
void checkPaths(const Study& study, Problems& problems) {
  std::map<std::string, std::string> owner;
  const auto claim = [&](const std::string& path, const std::string& where) {
    if (path == "Output/Folder" || path == "Output/Fields")
      problems.add(where,
                   "'" + path + "' is set by the study itself" + (path == "Output/Fields" ? " (its parameter Fields)" : " (--output)"));
    const auto [at, isNew] = owner.emplace(path, where);
    if (!isNew) problems.add(where, "'" + path + "' is changed in " + at->second + " as well");
  };
  for (const std::string& assignment : study.set) {
    const std::size_t equals = assignment.find('=');
    if (equals == std::string::npos || trimmed(assignment.substr(0, equals)).empty())
      problems.add("Set", "'" + assignment + "' is not of the form Path/To/Parameter=value");
    else
      claim(overridePath(assignment), "Set");
  }
  for (const Sweep& sweep : study.sweeps)
    for (const Parameter& parameter : sweep.parameters) claim(parameter.path, "Sweeps/" + sweep.name + "/" + parameter.name);
  if (owner.count("Scene") == 0 && study.scene.empty()) problems.add("Scene", "is missing: a study needs a scene, or a sweep over scenes");
  if (owner.count("Scene") && !study.scene.empty()) problems.add("Scene", "is given, but changed in " + owner["Scene"] + " as well");
}

std::optional<double> realIf(const Parameters& list, const std::string& name) {
  if (!list.isParameter(name)) return std::nullopt;
  return list.get<double>(name);
}

// The formula of a column of the table, or a separate formula.
Formula formulaOf(const Study& study, const std::string& column, const std::string& path, Problems& problems) {
  const auto known = std::find_if(study.columns.begin(), study.columns.end(), [&](const Column& one) { return one.name == column; });
  return known != study.columns.end() ? known->formula : columnFormula(column, path, problems);
}

Band readBand(const Parameters& list, const std::string& name, const Study& study, Problems& problems) {
  const std::string column = list.get<std::string>("Column");
  Band band{name,
            column,
            formulaOf(study, column, pathOf(list, "Column"), problems),
            {},
            realIf(list, "At Most"),
            realIf(list, "At Least"),
            realIf(list, "Largest Over Smallest At Most"),
            realIf(list, "Largest Minus Smallest At Most")};
  if (!band.atMost && !band.atLeast && !band.ratioAtMost && !band.differenceAtMost)
    problems.add(pathOf(list), "has no bound: expected At Most, At Least, Largest Over Smallest At Most or Largest Minus Smallest At Most");
  for (const std::string& where : texts(list, "Where")) addToFilter(where, study.sweeps, pathOf(list, "Where"), band.where, problems);
  return band;
}

Order readOrder(const Parameters& list, const std::string& name, const Study& study, Problems& problems) {
  const std::string x = list.get<std::string>("X"), y = list.get<std::string>("Y");
  Order order{name, x,  y, formulaOf(study, x, pathOf(list, "X"), problems), formulaOf(study, y, pathOf(list, "Y"), problems), {}, {},
              0,    {}, {}};
  order.last = list.get<int>("Last");
  order.atLeast = realIf(list, "At Least");
  order.atMost = realIf(list, "At Most");
  if (!order.atLeast && !order.atMost) problems.add(pathOf(list), "has no bound: expected At Least or At Most");
  if (order.last == 1) problems.add(pathOf(list, "Last"), "a single run has no order; expected at least 2, or 0 for all");
  for (const std::string& where : texts(list, "Where")) addToFilter(where, study.sweeps, pathOf(list, "Where"), order.where, problems);
  const std::vector<std::string> sweeps = names(study.sweeps);
  for (const std::string& by : texts(list, "By")) {
    const auto at = std::find(sweeps.begin(), sweeps.end(), by);
    if (at == sweeps.end())
      problems.add(pathOf(list, "By"), unknownName("sweep", by, sweeps));
    else
      order.by.push_back(std::size_t(at - sweeps.begin()));
  }
  return order;
}

Plot readPlot(const Parameters& list, const std::string& name, const Study& study, Problems& problems) {
  Plot plot{name, list.get<std::string>("X"), texts(list, "Y"), texts(list, "By")};
  const std::vector<std::string> sweeps = names(study.sweeps);
  std::vector<std::string> columns;
  for (const Column& column : study.columns) columns.push_back(column.name);
  std::vector<std::string> both = sweeps;
  both.insert(both.end(), columns.begin(), columns.end());
  const auto check = [&](const std::string& word, const std::vector<std::string>& known, const std::string& parameter, const char* kind) {
    if (std::find(known.begin(), known.end(), word) == known.end()) problems.add(pathOf(list, parameter), unknownName(kind, word, known));
  };
  check(plot.x, both, "X", "column or sweep");
  for (const std::string& y : plot.y) check(y, columns, "Y", "column");
  for (const std::string& by : plot.by) check(by, sweeps, "By", "sweep");
  for (const std::string& axis : texts(list, "Logarithmic")) {
    check(axis, {"X", "Y"}, "Logarithmic", "axis");
    (axis == "X" ? plot.logarithmicX : plot.logarithmicY) = true;
  }
  plot.pareto = list.get<bool>("Pareto");
  return plot;
}

void readColumns(Study& study, Problems& problems) {
  const std::vector<std::string> given = texts(*study.file.parameters, "Columns");
  for (const std::string& text : given) study.columns.push_back(readColumn(text, "Columns", problems));
  if (given.empty())
    for (const auto& named : namedColumns()) study.columns.push_back({named.first, Formula(named.second)});
  std::set<std::string> seen;
  for (const std::string& sweep : names(study.sweeps)) seen.insert(sweep);
  for (const Column& column : study.columns)
    if (!seen.insert(column.name).second) problems.add("Columns", "another column (or a sweep) has the name '" + column.name + "'");
}

}  // namespace

void addToFilter(const std::string& text, const std::vector<Sweep>& sweeps, const std::string& path, Filter& filter, Problems& problems) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    problems.add(path, "'" + text + "' is not of the form sweep=label");
    return;
  }
  const std::string name = trimmed(text.substr(0, equals));
  const auto sweep = std::find_if(sweeps.begin(), sweeps.end(), [&](const Sweep& one) { return one.name == name; });
  if (sweep == sweeps.end()) {
    problems.add(path, unknownName("sweep", name, names(sweeps)));
    return;
  }
  for (std::size_t begin = equals + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find('|', begin), text.size());
    const std::string label = trimmed(text.substr(begin, end - begin));
    begin = end + 1;
    if (std::find(sweep->labels.begin(), sweep->labels.end(), label) == sweep->labels.end())
      problems.add(path, unknownName("label of " + name, label, sweep->labels));
    filter[name].push_back(label);
  }
}

bool passes(const Filter& filter, const std::vector<Sweep>& sweeps, const std::vector<std::size_t>& choice) {
  for (std::size_t s = 0; s < sweeps.size(); ++s) {
    const auto wanted = filter.find(sweeps[s].name);
    if (wanted == filter.end()) continue;
    const std::string& label = sweeps[s].labels[choice[s]];
    if (std::find(wanted->second.begin(), wanted->second.end(), label) == wanted->second.end()) return false;
  }
  return true;
}

Study readStudy(const Comm& comm, const std::string& path, const std::vector<std::string>& overrides) {
  Study study;
  study.file = readScene(comm, path, studySchema(), overrides);
  const Parameters& all = *study.file.parameters;
  Problems problems;
  study.name = std::filesystem::path(path).stem().string();
  study.title = all.get<std::string>("Title").empty() ? study.name : all.get<std::string>("Title");
  study.scene = all.get<std::string>("Scene");
  study.set = texts(all, "Set");
  study.repetitions = all.get<int>("Repetitions");
  study.fields = all.get<bool>("Fields");
  study.allowFailures = all.get<bool>("Allow Failures");
  const Parameters& sweeps = all.sublist("Sweeps");
  for (const std::string& name : sublistNames(sweeps)) study.sweeps.push_back(readSweep(sweeps.sublist(name), name, problems));
  checkPaths(study, problems);
  readColumns(study, problems);
  const Parameters& bands = all.sublist("Bands");
  for (const std::string& name : sublistNames(bands)) study.bands.push_back(readBand(bands.sublist(name), name, study, problems));
  const Parameters& orders = all.sublist("Orders");
  for (const std::string& name : sublistNames(orders)) study.orders.push_back(readOrder(orders.sublist(name), name, study, problems));
  const Parameters& plots = all.sublist("Plots");
  for (const std::string& name : sublistNames(plots)) study.plots.push_back(readPlot(plots.sublist(name), name, study, problems));
  problems.throwIfAny();
  return study;
}

}  // namespace suture::study
