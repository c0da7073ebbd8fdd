#pragma once
#include <string>
#include <utility>
#include <vector>

#include "Combinations.hpp"

namespace suture::study {

/// Result of one combination of a study.
struct Row {
  const Combination* run = nullptr;
  std::vector<TableCell> cells;                          ///< one per column
  std::vector<TableCell> judged;                         ///< one per band, the value of its column; empty for a failed run
  std::vector<std::pair<TableCell, TableCell>> ordered;  ///< one per order, x and y; empty for a failed run
  int exitCode = 0;
  std::string failure;  ///< in one line; empty if the run converged
};

/// The row of a run. \param summaries  texts of summary.json, one per repetition: times are medians, all other figures are from the first;
/// without a summary the row contains only exit code and reason. Local.
Row studyRow(const Study& study, const Combination& run, const std::vector<std::string>& summaries, int exitCode,
             const std::string& failure);

/// For readers: "9,670", "0.00123", "true". Local.
std::string shown(const TableCell& cell);
/// With all digits. Local.
std::string exact(const TableCell& cell);

/// The table, with the labels of the sweeps first; the column `failure` only if a run has failed. Local.
std::string tableCsv(const Study& study, const std::vector<Row>& rows);
std::string tableMarkdown(const Study& study, const std::vector<Row>& rows);
/// The table and the plots for suture_plot. Local.
std::string tableJson(const Study& study, const std::vector<Row>& rows);

}  // namespace suture::study
