#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/report/AccuracyRequest.hpp>
#include <suture/report/History.hpp>
#include <suture/report/Steps.hpp>

#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace suture {

/// Monitor of a run: writes the table to the console (rank 0's `console`; null on other ranks and for --quiet) and collects the rows of
/// history.csv. Local: every rank has one and collects the same rows.
///
/// A note that begins with "warning: " is a warning: something was repaired or assumed, or the result may be inaccurate.
class RunMonitor : public Monitor {
 public:
  /// \param verbose  also prints the inner iterations
  /// \param strict   turns warnings into errors (--strict)
  RunMonitor(std::ostream* console, bool verbose, bool strict = false);
  void auxiliary(const AuxiliaryRow& row) override;
  void outer(const OuterRow& row) override;
  /// Stores and prints a note; a repeated text is dropped.
  /// \throws InputError  for a warning, when strict; on every rank, since every rank receives the same notes
  void note(const std::string& text) override;
  void inner(int iteration, double relativeResidual) override;
  bool wantsInner() const override { return verbose_; }
  bool stopRequested() const override { return stop_ && stop_(); }
  /// \param stop  called after every outer iteration; true ends the run
  void stopWhen(std::function<bool()> stop) { stop_ = std::move(stop); }

  /// Begins a load step: from now on the table has one row per step instead of one per outer iteration, unless verbose.
  void beginStep(int step) { loadStep_ = step; }
  /// Prints the row of a load step.
  void endStep(const StepRow& row);

  /// Begins a mesh of a run with a request for accuracy: rows and notes of the mesh before are dropped, and neither rows nor notes are
  /// printed. All notes are kept until showNotes().
  void beginLevel();
  /// Prints the row of a mesh. \param number  from 0 on
  void endLevel(int number, const AccuracyLevel& level);
  /// Ends a mesh without a solution: the rows and notes of the mesh before count again.
  void dropLevel();
  /// Ends the sequence of meshes: prints the notes of the last one.
  void endLevels();

  /// Also appends each row to the file of a LiveHistory.
  void recordIn(const std::string& path) { live_ = std::make_unique<LiveHistory>(path); }

  /// Sets an energy unknown to the solver that is added to the energy of every row.
  void shiftEnergy(double shift) { energyShift_ = shift; }

  /// Prints failures in red and warnings in yellow, for terminals.
  void useColours() { coloured_ = true; }
  enum class Colour { Good = 32, Warning = 33, Bad = 31 };
  /// The text in a colour, if colours are in use.
  std::string in(Colour colour, const std::string& text) const;

  std::ostream* console() const { return console_; }  ///< null: silent
  const std::vector<OuterRow>& rows() const { return rows_; }
  const std::vector<std::string>& notes() const { return notes_; }
  /// Prints the number of warnings above, since users read the last lines.
  void countWarnings() const;

 private:
  std::ostream* console_;
  bool verbose_, strict_, coloured_ = false;
  bool inLevels_ = false;
  bool printsRows() const { return console_ && ((loadStep_ == 0 && !inLevels_) || verbose_); }
  void print(const std::string& note) const;

  int loadStep_ = 0;
  double energyShift_ = 0.0;
  std::function<bool()> stop_;
  std::vector<OuterRow> rows_;
  std::vector<std::string> notes_;
  std::vector<OuterRow> rowsBefore_;  // rows of the mesh before
  std::vector<std::string> notesBefore_;
  std::unique_ptr<LiveHistory> live_;
};

}  // namespace suture
