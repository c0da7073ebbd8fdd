#pragma once
#include <string>
#include <vector>

#include "../support/Program.hpp"
#include "Bands.hpp"
#include "Options.hpp"

namespace suture::study {

/// The whole of suture_study. Collective. \throws Error  of any kind
ExitCode run(const CommPtr& comm, const Options& options);

/// Results of the runs of a study.
struct Rows {
  std::vector<Row> rows;  ///< on rank 0
  bool stopped = false;   ///< on request (SIGUSR1): rows are missing
};

/// Runs every combination, as suture_solve would, into folder/runs/<number>; a line each on the console. A run that does not converge, or
/// is refused when its mesh is known, for which there is no memory, or that meets a bug, is a row with exit code and reason. The tables are
/// written after each run. \throws EnvironmentError  the folder cannot be written. Collective.
Rows runAll(const CommPtr& comm, const Study& study, const std::vector<Combination>& runs, const Options& options);

/// table.csv, table.md and study.json of the rows so far. Local (rank 0). \throws EnvironmentError
void writeTables(const Comm& comm, const Study& study, const std::vector<Row>& rows, const std::string& folder);

/// --check: the runs and what they change, on the console.
void listRuns(const Comm& comm, const Study& study, const std::vector<Combination>& runs);

/// table.csv, table.md, study.json and the plots into the folder, the verdicts on the console; the exit code of the study. Collective.
ExitCode reportStudy(const Comm& comm, const Study& study, const Rows& all, const Options& options);

}  // namespace suture::study
