#include <algorithm>
#include <cmath>
#include <ostream>
#include <suture/base/Errors.hpp>
#include <suture/report/Format.hpp>
#include <suture/report/RunMonitor.hpp>

namespace suture {
namespace {

// 0 means "no inner iteration, no estimate".
std::string condition(double value) {
  if (value <= 0.0) return "-";
  return value < 1e5 ? format("%.1f", value) : format("%.1e", value);
}

bool isWarning(const std::string& note) { return note.rfind("warning: ", 0) == 0; }

}  // namespace

RunMonitor::RunMonitor(std::ostream* console, bool verbose, bool strict) : console_(console), verbose_(verbose), strict_(strict) {}

void RunMonitor::auxiliary(const AuxiliaryRow& row) {
  if (!printsRows()) return;
  const char* what = row.contact ? "auxiliary problem (all pairs closed)" : "linear problem";
  if (row.pcg == 0)
    *console_ << format("%s   no interface iteration", what) << std::endl;
  else
    *console_ << format("%s  %5d PCG    condition %s    %.1e", what, row.pcg, condition(row.condition).c_str(), row.tolerance) << std::endl;
}

void RunMonitor::outer(const OuterRow& given) {
  OuterRow row = given;
  row.energy += energyShift_;
  row.loadStep = loadStep_;
  if (printsRows()) {
    if (rows_.empty()) *console_ << "  k   PCG   condition   residual   active  changed         energy    seconds\n";
    *console_ << format("%3d%6d%12s%11.1e%9d%9d%15.4e%11.2f", row.iteration, row.pcg, condition(row.condition).c_str(), row.residual,
                        row.active, row.changed, row.energy, row.seconds)
              << std::endl;
  }
  rows_.push_back(row);
  if (live_) live_->add(row);
}

void RunMonitor::endStep(const StepRow& row) {
  if (!console_ || (inLevels_ && !verbose_)) return;
  if (row.step == 1 || verbose_)
    *console_ << " step        time   outer   PCG   closed   stick    slip  changed         energy     dissipated    seconds\n";
  *console_ << format("%5d%12.6g%8d%6d%9d%8d%8d%9d%15.4e%15.4e%11.2f", row.step, row.time, row.outer, row.pcg, row.active, row.sticking,
                      row.slipping, row.changed, row.energy, row.work.dissipated, row.seconds)
            << std::endl;
}

std::string RunMonitor::in(Colour colour, const std::string& text) const {
  return coloured_ ? format("\033[%dm", int(colour)) + text + "\033[0m" : text;
}

void RunMonitor::countWarnings() const {
  const auto count = std::count_if(notes_.begin(), notes_.end(), isWarning);
  if (!console_ || count == 0) return;
  *console_ << "   " + in(Colour::Warning, count == 1 ? "1 warning, see above" : format("%d warnings, see above", int(count))) << std::endl;
}

void RunMonitor::note(const std::string& text) {
  const bool warning = isWarning(text);
  if (warning && strict_) throw InputError("--strict", text);
  if (std::find(notes_.begin(), notes_.end(), text) != notes_.end()) return;
  notes_.push_back(text);
  if (!inLevels_) print(text);
}

void RunMonitor::print(const std::string& note) const {
  if (console_) *console_ << (isWarning(note) ? "   " + in(Colour::Warning, note) : "   note: " + note) << std::endl;
}

void RunMonitor::beginLevel() {
  inLevels_ = true;
  rowsBefore_ = std::move(rows_);
  notesBefore_ = std::move(notes_);
  rows_.clear();
  notes_.clear();
}

void RunMonitor::dropLevel() {
  rows_ = std::move(rowsBefore_);
  notes_ = std::move(notesBefore_);
}

void RunMonitor::endLevel(int number, const AccuracyLevel& level) {
  if (!console_) return;
  if (number == 0 || verbose_) *console_ << "level    unknowns    elements     error             PCG   outer    seconds   mesh\n";
  const std::string error = std::isfinite(level.error) ? format("%9.3g %% %-8s", 100 * level.error, level.strict ? "bound" : "estimate")
                                                       : format("%9s%11s", "none", "");
  *console_ << format("%5d%12s%12s%s%6d%8d%11.2f   %s", number, grouped(level.unknowns).c_str(), grouped(level.elements).c_str(),
                      error.c_str(), level.iterations, level.outer, level.seconds, level.refinement.c_str())
            << std::endl;
}

void RunMonitor::endLevels() {
  inLevels_ = false;
  for (const std::string& text : notes_) print(text);
}

void RunMonitor::inner(int iteration, double relativeResidual) {
  if (console_ && verbose_) *console_ << format("         inner %4d   %.3e\n", iteration, relativeResidual);
}

}  // namespace suture
