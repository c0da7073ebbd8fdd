#pragma once
#include <string>
#include <vector>

#include "../support/Program.hpp"
#include "Bands.hpp"
#include "Options.hpp"

namespace suture::study {

/// Runs suture_study. Collective. \throws Error  of any kind
ExitCode run(const CommPtr& comm, const Options& options);

/// Results of the runs of a study.
struct Rows {
  std::vector<Row> rows;  ///< on rank 0
  bool stopped = false;   ///< stopped by a request (SIGUSR1): rows are missing
};

/// Runs every combination, as suture_solve would, into folder/runs/<number>; prints one line per run. A run that does not converge, is
/// refused after reading its mesh, runs out of memory, or fails because of a bug becomes a row with exit code and reason. The tables are
/// written after each run. \throws EnvironmentError  the folder cannot be written. Collective.
Rows runAll(const CommPtr& comm, const Study& study, const std::vector<Combination>& runs, const Options& options);

/// Writes table.csv, table.md and study.json with the rows so far. Local (rank 0). \throws EnvironmentError
void writeTables(const Comm& comm, const Study& study, const std::vector<Row>& rows, const std::string& folder);

/// --check: prints the runs and their overrides.
void listRuns(const Comm& comm, const Study& study, const std::vector<Combination>& runs);

/// Writes table.csv, table.md, study.json and the plots into the folder and prints the verdicts. \return the exit code. Collective.
ExitCode reportStudy(const Comm& comm, const Study& study, const Rows& all, const Options& options);

}  // namespace suture::study
