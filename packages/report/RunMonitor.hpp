#pragma once
#include <suture/base/Monitor.hpp>
#include <suture/report/Steps.hpp>

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace suture {

/// Listens to the run; writes the table on the console (rank 0's `console`, null on the others and for --quiet) and collects the rows of
/// history.csv. Local: every rank has one and collects the same rows.
///
/// A note that begins with "warning: " is a warning: something was repaired or assumed for the user.
class RunMonitor : public Monitor {
 public:
  /// \param verbose  prints the inner iterations, too
  /// \param strict   turns a warning into an error (--strict)
  RunMonitor(std::ostream* console, bool verbose, bool strict = false);
  void auxiliary(const AuxiliaryRow& row) override;
  void outer(const OuterRow& row) override;
  /// Keeps and prints a note, once: the same text again is dropped.
  /// \throws InputError  for a warning, when strict; on every rank, since every rank is told the same
  void note(const std::string& text) override;
  void inner(int iteration, double relativeResidual) override;
  bool wantsInner() const override { return verbose_; }
  bool stopRequested() const override { return stop_ && stop_(); }
  /// \param stop  asked after every outer iteration whether the user wants the run to end
  void stopWhen(std::function<bool()> stop) { stop_ = std::move(stop); }

  /// Begins a load step: tables have a row per step instead of one per outer iteration, unless verbose.
  void beginStep(int step) { loadStep_ = step; }
  /// Prints its row.
  void endStep(const StepRow& row);

  /// Energy that the solver does not know of, added to that of every row.
  void shiftEnergy(double shift) { energyShift_ = shift; }

  /// Bad news in red, warnings in yellow: for a terminal.
  void useColours() { coloured_ = true; }
  enum class Colour { Good = 32, Warning = 33, Bad = 31 };
  /// The text in a colour, if there are any.
  std::string in(Colour colour, const std::string& text) const;

  std::ostream* console() const { return console_; }  ///< null: silent
  const std::vector<OuterRow>& rows() const { return rows_; }
  const std::vector<std::string>& notes() const { return notes_; }
  /// Prints how many warnings stand above: the last lines are those that are read.
  void countWarnings() const;

 private:
  std::ostream* console_;
  bool verbose_, strict_, coloured_ = false;
  bool printsRows() const { return console_ && (loadStep_ == 0 || verbose_); }

  int loadStep_ = 0;
  double energyShift_ = 0.0;
  std::function<bool()> stop_;
  std::vector<OuterRow> rows_;
  std::vector<std::string> notes_;
};

}  // namespace suture
