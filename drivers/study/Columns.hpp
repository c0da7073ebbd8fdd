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

/// The columns that have a name of their own ("pcg": all applications of the operator, start included): name, formula. They may stand in
/// formulas, and are the columns of a study that names none.
const std::vector<std::pair<std::string, std::string>>& namedColumns();

/// A formula whose names are all known: of namedColumns(), which are replaced by what they mean, or paths of summary.json (summaryPaths()).
/// Errors are added to `problems` under `path`; the result is then of no use. Local.
Formula columnFormula(const std::string& text, const std::string& path, Problems& problems);

/// "name", "path" or "name = formula". Local.
Column readColumn(const std::string& text, const std::string& path, Problems& problems);

}  // namespace suture::study
