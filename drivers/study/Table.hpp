#pragma once
#include <string>
#include <utility>
#include <vector>

#include "Combinations.hpp"

namespace suture::study {

/// Result of one combination of a study.
struct Row {
  const Combination* run = nullptr;
  std::vector<TableCell> cells;                          ///< one for each column
  std::vector<TableCell> judged;                         ///< value of its column for each band; empty for a run that failed
  std::vector<std::pair<TableCell, TableCell>> ordered;  ///< x and y for each order; empty for a run that failed
  int exitCode = 0;
  std::string failure;  ///< in one line; empty: the run converged
};

/// The row of a run. \param summaries  texts of summary.json, one a repetition: of times the median is kept, all else is of the first; a
/// run that ended without one gives a row with exit code and reason only. Local.
Row studyRow(const Study& study, const Combination& run, const std::vector<std::string>& summaries, int exitCode,
             const std::string& failure);

/// "9,670", "0.00123", "true": for people. Local.
std::string shown(const TableCell& cell);
/// All digits. Local.
std::string exact(const TableCell& cell);

/// The table, labels of the sweeps first; the column `failure` only if a run has failed. Local.
std::string tableCsv(const Study& study, const std::vector<Row>& rows);
std::string tableMarkdown(const Study& study, const std::vector<Row>& rows);
/// The table and the plots for suture_study_plot. Local.
std::string tableJson(const Study& study, const std::vector<Row>& rows);

}  // namespace suture::study
