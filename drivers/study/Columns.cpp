#include "Columns.hpp"

#include <algorithm>
#include <suture/base/Numbers.hpp>
#include <suture/report/Summary.hpp>

namespace suture::study {
namespace {

std::vector<std::string> parts(const std::string& path) {
  std::vector<std::string> all(1);
  for (const char c : path) c == '.' ? all.emplace_back() : all.back() += c;
  return all;
}

// True if a path follows a path of summary.json as far as it goes; "contact.force.fault above" names a vector.
bool leadsAlong(const std::vector<std::string>& path, const std::string& known) {
  if (known == "parameters.<path>") return path.size() > 1 && path.front() == "parameters";
  const std::vector<std::string> pattern = parts(known);
  const bool vector = pattern.back() == "<component>" && path.size() + 1 == pattern.size();
  if (path.size() != pattern.size() && !vector) return false;
  for (std::size_t i = 0; i < path.size(); ++i)
    if (pattern[i].front() != '<' && pattern[i] != path[i]) return false;
  return true;
}

bool isKnown(const std::string& path) {
  const std::vector<std::string> names = parts(path);
  const auto& known = summaryPaths();
  return std::any_of(known.begin(), known.end(), [&](const std::string& one) { return leadsAlong(names, one); });
}

// Lists in a summary ("accuracy.levels"), or the keys of their entries ("accuracy.levels.unknowns").
std::vector<std::string> listPaths(bool keys) {
  std::vector<std::string> all;
  const std::string entry = ".<number>.";
  for (const std::string& known : summaryPaths()) {
    const std::size_t at = known.find(entry);
    if (at == std::string::npos) continue;
    const std::string path = known.substr(0, at) + (keys ? known.substr(at + entry.size() - 1) : "");
    const bool isPlain = path.find('<') == std::string::npos;
    if (isPlain && std::find(all.begin(), all.end(), path) == all.end()) all.push_back(path);
  }
  return all;
}

void checkLists(const std::vector<std::string>& names, const std::vector<std::string>& known, const std::string& what,
                const std::string& path, Problems& problems) {
  for (const std::string& name : names)
    if (std::find(known.begin(), known.end(), name) == known.end()) problems.add(path, unknownName(what, name, known));
}

}  // namespace

const std::vector<std::pair<std::string, std::string>>& namedColumns() {
  static const std::vector<std::pair<std::string, std::string>> named{
      {"dofs", "dofs"},
      {"h", "exp(0 - ln(elements) / dimension)"},
      {"subdomains", "subdomains"},
      {"interface_dofs", "interface_dofs"},
      {"coarse", "preconditioner.coarse_size"},
      {"auxiliary_pcg", "auxiliary.iterations"},
      {"auxiliary_condition", "auxiliary.condition"},
      {"steps", "outer.iterations"},
      {"outer_pcg", "outer.pcg_total"},
      {"pcg", "auxiliary.iterations + outer.pcg_total"},
      {"condition", "max(auxiliary.condition, outer.condition)"},
      {"residual", "outer.residual"},
      {"active", "contact.active"},
      {"solve_seconds", "phases.solve.max"},
      {"setup_seconds", "phases.assemble.max + phases.factor.max + preconditioner.setup_seconds"},
      {"peak_mb", "peak_memory_mb.max"},
      {"exit_code", "exit_code"},
  };
  return named;
}

Formula columnFormula(const std::string& text, const std::string& path, Problems& problems) {
  Formula formula("0");
  try {
    formula = Formula(text);
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) problems.add(path, problem.message);
    return formula;
  }
  std::vector<std::string> known = summaryPaths();
  for (const auto& [name, meaning] : namedColumns())
    if (std::find(known.begin(), known.end(), name) == known.end()) known.push_back(name);
  for (const std::string& name : formula.paths()) {
    const auto own = std::find_if(namedColumns().begin(), namedColumns().end(), [&](const auto& one) { return one.first == name; });
    if (own != namedColumns().end())
      formula.substitute(name, Formula(own->second));
    else if (!isKnown(name))
      problems.add(path, unknownName("column", name, known));
  }
  checkLists(formula.sums(), listPaths(true), "key of a list", path, problems);
  checkLists(formula.counts(), listPaths(false), "list", path, problems);
  return formula;
}

Column readColumn(const std::string& text, const std::string& path, Problems& problems) {
  const std::size_t equals = text.find('=');
  const std::string name = trimmed(text.substr(0, equals));
  const std::string formula = equals == std::string::npos ? name : trimmed(text.substr(equals + 1));
  if (name.empty()) problems.add(path, "'" + text + "': a column without a name; expected a name, a path, or name = formula");
  return {name, columnFormula(formula, path, problems)};
}

}  // namespace suture::study
