#pragma once
#include <string>
#include <vector>

namespace suture {

/// One figure in two runs of a scene.
struct ComparedFigure {
  std::string name;
  std::string then, now;    ///< as printed
  double difference = 0.0;  ///< relative to the scale of its kind; infinite if either value is not finite
  double allowed = 0.0;     ///< at the tolerance of the runs
  bool judged = true;       ///< false: may differ between two correct solutions, e.g. iteration counts

  bool agrees() const { return !judged || difference <= allowed; }
};

/// Comparison of two runs of a scene, figure by figure.
struct Comparison {
  std::vector<ComparedFigure> figures;
  double tolerance = 0.0;  ///< tolerance of the outer iteration, or the residual reached if that is larger
  int ranksThen = 1, ranksNow = 1;
  std::vector<std::string> notes;  ///< libraries whose versions differ

  bool agrees() const;
  bool isExact() const;  ///< all figures agree to the last bit
};

/// Compares two summaries (texts of summary.json). Allowed differences follow the bounds of the verdict (quality/Bounds): 100 times the
/// tolerance for energies, displacements, forces and extremes, 1000 times for values at one point (pressure, gap, stresses). The tolerance
/// is the largest of Outer Solver/Tolerance, the residuals of the runs, and the algebraic errors of automatic tolerances. Scales: for
/// forces the largest force of a condition or contact, for gaps and displacements the largest of either, for stresses the largest von
/// Mises stress. The number of closed pairs may differ by the pairs that touch without force. Local.
/// \throws InputError  a summary lacks a key
Comparison compareSummaries(const std::string& then, const std::string& now);

/// The table for the console, one line per figure; the verdict is the last line. Local.
std::string tableOf(const Comparison& comparison);

/// Figures that do not agree: "energy differs by 2.1e-03, allowed 1.0e-06; ...". Local.
std::string failureOf(const Comparison& comparison);

/// comparison.csv. Local. \throws EnvironmentError
void writeComparison(const Comparison& comparison, const std::string& path);

}  // namespace suture
