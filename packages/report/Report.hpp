#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/base/SceneReader.hpp>
#include <suture/base/Timers.hpp>
#include <suture/constraints/Constraints.hpp>
#include <suture/elasticity/ElasticModel.hpp>
#include <suture/partition/SubdomainMesh.hpp>
#include <suture/solver/Solution.hpp>

#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace suture {

/// The scene's list `Output`.
Schema outputSchema();

/// Listens to the run; writes the table on the console (rank 0's `console`, null for --quiet) and collects the rows of history.csv.
class RunMonitor : public Monitor {
 public:
  /// \param verbose  prints the inner iterations, too
  RunMonitor(std::ostream* console, bool verbose);
  void auxiliary(const AuxiliaryRow& row) override;
  void outer(const OuterRow& row) override;
  void note(const std::string& text) override;
  void inner(int iteration, double relativeResidual) override;
  bool wantsInner() const override { return verbose_; }

  const std::vector<OuterRow>& rows() const { return rows_; }
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::ostream* console_;
  bool verbose_;
  std::vector<OuterRow> rows_;
  std::vector<std::string> notes_;
};

/// Everything a report needs of a run; all references outlive it.
struct Run {
  const Comm& comm;
  const SceneFile& scene;
  const ElasticModel& model;
  const std::vector<ContactPiece>& pieces;       ///< on all ranks: names (pairs on rank 0 only)
  const std::vector<SubdomainMesh>& subdomains;  ///< of this rank
  const ProblemSize& size;
  const Solution& solution;
  const RunMonitor& monitor;
  Timers& timers;
  std::string meshHash;
  std::vector<std::string> commandLine;
  std::string folder;  ///< output folder
};

/// Makes the output folder and checks that it can be written, before any work is done. Collective.
/// \throws EnvironmentError
void prepareFolder(const Comm& comm, const std::string& folder);

/// First line of the console: title, version, ranks, sizes. Rank 0's stream.
void printHeader(std::ostream& console, const Comm& comm, const SceneFile& scene, const ProblemSize& size);

/// fields_0000.vtkhdf (and contact_0000.vtkhdf with contact lines), history.csv, summary.json, each under a temporary name first.
/// Collective. The files are written also for a run that did not converge; summary.json says so.
void writeReport(const Run& run, ExitCode code);

/// Last lines of the console: converged or why not, contact figures, phases, memory, files. Collective; prints on rank 0.
void printFooter(std::ostream* console, const Run& run);

}  // namespace suture
