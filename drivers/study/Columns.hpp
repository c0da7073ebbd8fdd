#pragma once
#include <string>
#include <suture/base/Errors.hpp>
#include <vector>

#include "Formula.hpp"

namespace suture::study {

/// A column of a study's table.
struct Column {
  std::string name;
  Formula formula;
};

/// The predefined columns ("pcg": all applications of the operator, start included): name, formula. They may be used in formulas, and are
/// the default columns of a study.
const std::vector<std::pair<std::string, std::string>>& namedColumns();

/// Parses a formula and resolves its names: predefined columns are replaced by their formulas, paths refer to summary.json
/// (summaryPaths()). Adds errors to `problems` under `path`; the result is then invalid. Local.
Formula columnFormula(const std::string& text, const std::string& path, Problems& problems);

/// Reads "name", "path" or "name = formula". Local.
Column readColumn(const std::string& text, const std::string& path, Problems& problems);

}  // namespace suture::study
