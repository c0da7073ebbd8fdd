#pragma once
#include <map>
#include <optional>
#include <string>
#include <suture/base/scene/SceneReader.hpp>
#include <vector>

#include "Columns.hpp"

namespace suture::study {

/// Placeholder in a list of values: keeps the value of the scene.
inline constexpr const char* kUnchanged = "-";

/// A parameter of the scene (or "Scene", the scene file itself) and its values, which vary together with others of its sweep.
struct Parameter {
  std::string name;  ///< name of its list in the study
  std::string path;  ///< in the scene: "Mesh/Constants/scale"
  std::vector<std::string> values;
};

/// Parameters that vary together; different sweeps are combined.
struct Sweep {
  std::string name;
  std::vector<std::string> labels;  ///< one per value
  std::vector<Parameter> parameters;
};

/// Sweep -> selected labels; a sweep that is not listed is not restricted.
using Filter = std::map<std::string, std::vector<std::string>>;

/// Bounds of a column over the rows that pass a filter.
struct Band {
  std::string name, column;  ///< column: as written
  Formula formula;
  Filter where;
  std::optional<double> atMost, atLeast, ratioAtMost, differenceAtMost;
};

/// A required order of convergence of one column with respect to another.
struct Order {
  std::string name, x, y;  ///< columns: as written
  Formula xFormula, yFormula;
  Filter where;
  std::vector<std::size_t> by;  ///< sweeps: one fit per combination of their labels
  int last = 0;                 ///< number of runs that count, those with the smallest x; 0: all
  std::optional<double> atLeast, atMost;
};

/// A plot: columns (or sweeps) by name.
struct Plot {
  std::string name, x;
  std::vector<std::string> y, by;
  bool logarithmicX = false, logarithmicY = false, pareto = false;
};

/// A study file, read and checked without its scenes.
struct Study {
  SceneFile file;
  std::string name;  ///< name of the file without extension
  std::string title, scene;
  std::vector<std::string> set;  ///< "Path=value" in every run
  std::vector<Sweep> sweeps;
  std::vector<Column> columns;
  std::vector<Band> bands;
  std::vector<Order> orders;
  std::vector<Plot> plots;
  int repetitions = 1;
  bool fields = false, allowFailures = false;
};

/// Reads a study as strictly as a scene. \param overrides  of the study's own parameters
/// \throws InputError  lists all problems: unknown names, lists of different lengths in a sweep, unknown columns, ...  Collective.
Study readStudy(const Comm& comm, const std::string& path, const std::vector<std::string>& overrides = {});

/// Adds "sweep=label" or "sweep=label|label" to `filter`, checked against the sweeps; adds errors to `problems` under `path`. Local.
void addToFilter(const std::string& text, const std::vector<Sweep>& sweeps, const std::string& path, Filter& filter, Problems& problems);

/// True if a combination (the index of the label for each sweep) passes the filter. Local.
bool passes(const Filter& filter, const std::vector<Sweep>& sweeps, const std::vector<std::size_t>& choice);

}  // namespace suture::study
