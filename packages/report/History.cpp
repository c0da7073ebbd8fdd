#include <suture/report/Format.hpp>
#include <suture/report/History.hpp>
#include <suture/report/OutputFolder.hpp>

namespace suture {

void writeHistory(const std::vector<OuterRow>& rows, const std::string& path) {
  const bool inSteps = !rows.empty() && rows.back().loadStep > 0;
  std::string text = "iteration,pcg,condition,residual,euclidean,active,changed,energy,step,seconds,algebraic_error";
  text += inSteps ? ",load_step\n" : "\n";
  for (const OuterRow& row : rows)
    text +=
        format("%d,%d,%.17g,%.17g,%.17g,%d,%d,%.17g,%.17g,%.6f,%s%s\n", row.iteration, row.pcg, row.condition, row.residual, row.euclidean,
               row.active, row.changed, row.energy, row.step, row.seconds,
               row.energyError < 0.0 ? "" : format("%.17g", row.energyError).c_str(), inSteps ? format(",%d", row.loadStep).c_str() : "");
  writeTextFile(path, text);
}

}  // namespace suture
