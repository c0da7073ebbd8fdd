#include <suture/report/Format.hpp>
#include <suture/report/History.hpp>
#include <suture/report/OutputFolder.hpp>

namespace suture {

namespace {

std::string headerOf(bool inSteps) {
  return std::string("iteration,pcg,condition,residual,euclidean,active,changed,energy,step,seconds,algebraic_error") +
         (inSteps ? ",load_step\n" : "\n");
}

std::string lineOf(const OuterRow& row, bool inSteps) {
  return format("%d,%d,%.17g,%.17g,%.17g,%d,%d,%.17g,%.17g,%.6f,%s%s\n", row.iteration, row.pcg, row.condition, row.residual, row.euclidean,
                row.active, row.changed, row.energy, row.step, row.seconds,
                row.energyError < 0.0 ? "" : format("%.17g", row.energyError).c_str(), inSteps ? format(",%d", row.loadStep).c_str() : "");
}

}  // namespace

void writeHistory(const std::vector<OuterRow>& rows, const std::string& path) {
  const bool inSteps = !rows.empty() && rows.back().loadStep > 0;
  std::string text = headerOf(inSteps);
  for (const OuterRow& row : rows) text += lineOf(row, inSteps);
  writeTextFile(path, text);
}

void LiveHistory::add(const OuterRow& row) {
  const bool inSteps = row.loadStep > 0;
  if (!hasRows_) file_ << headerOf(inSteps);
  hasRows_ = true;
  file_ << lineOf(row, inSteps) << std::flush;
}

}  // namespace suture
