#pragma once
#include <map>
#include <optional>
#include <string>
#include <suture/base/scene/SceneReader.hpp>
#include <vector>

#include "Columns.hpp"

namespace suture::study {

/// Placeholder for "as the scene has it" in a list of values.
inline constexpr const char* kUnchanged = "-";

/// One parameter of the scene (or "Scene", the scene file itself) and its values, tied to those of the others of its sweep.
struct Parameter {
  std::string name;  ///< of its list in the study
  std::string path;  ///< in the scene: "Mesh/Constants/scale"
  std::vector<std::string> values;
};

/// Parameters that vary together; different sweeps are combined.
struct Sweep {
  std::string name;
  std::vector<std::string> labels;  ///< one for each value
  std::vector<Parameter> parameters;
};

/// Sweep -> the labels that take part; a sweep that is not named takes part with all.
using Filter = std::map<std::string, std::vector<std::string>>;

/// Bounds of a column over the rows that a filter leaves.
struct Band {
  std::string name, column;  ///< column: as written
  Formula formula;
  Filter where;
  std::optional<double> atMost, atLeast, ratioAtMost, differenceAtMost;
};

/// The order of convergence of a column in another, asserted.
struct Order {
  std::string name, x, y;  ///< columns: as written
  Formula xFormula, yFormula;
  Filter where;
  std::vector<std::size_t> by;  ///< sweeps: a fit for each combination of their labels
  int last = 0;                 ///< of the smallest x so many runs count; 0: all
  std::optional<double> atLeast, atMost;
};

/// A picture: columns (or sweeps) by their names.
struct Plot {
  std::string name, x;
  std::vector<std::string> y, by;
  bool logarithmicX = false, logarithmicY = false, pareto = false;
};

/// A study file, read and checked as far as it goes without its scenes.
struct Study {
  SceneFile file;
  std::string name;  ///< of the file, without extension
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
/// \throws InputError  with all problems: unknown names, tied lists of different lengths, unknown columns, ...  Collective.
Study readStudy(const Comm& comm, const std::string& path, const std::vector<std::string>& overrides = {});

/// "sweep=label" or "sweep=label|label" into `filter`, checked against the sweeps; what is wrong goes to `problems` under `path`. Local.
void addToFilter(const std::string& text, const std::vector<Sweep>& sweeps, const std::string& path, Filter& filter, Problems& problems);

/// True if a combination (of each sweep the index of its label) takes part. Local.
bool passes(const Filter& filter, const std::vector<Sweep>& sweeps, const std::vector<std::size_t>& choice);

}  // namespace suture::study
