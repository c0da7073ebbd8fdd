#pragma once
#include <string>
#include <vector>

namespace suture {

/// A figure of two runs of one scene.
struct ComparedFigure {
  std::string name;
  std::string then, now;    ///< as printed
  double difference = 0.0;  ///< relative to the scale of its kind; infinite if one of the two is not finite
  double allowed = 0.0;     ///< at the tolerance of the runs
  bool judged = true;       ///< false: may differ between two right answers, as iterations do

  bool agrees() const { return !judged || difference <= allowed; }
};

/// Results of two runs of one scene, figure by figure.
struct Comparison {
  std::vector<ComparedFigure> figures;
  double tolerance = 0.0;  ///< tolerance of the outer iteration, or the residual reached, if that is larger
  int ranksThen = 1, ranksNow = 1;
  std::vector<std::string> notes;  ///< libraries of other versions

  bool agrees() const;
  bool isExact() const;  ///< no figure differs in any bit
};

/// Compares two summaries (texts of summary.json). Energies, displacements, forces and extremes may differ by what the verdict of each run
/// allows at the tolerance (quality/Bounds): 100 times the tolerance, values at one point (pressure, gap, stresses) 1000 times. The
/// tolerance is the largest of Outer Solver/Tolerance, the residuals that the runs reached, and the algebraic errors of automatic
/// tolerances. Scales: forces the largest force of a condition or contact, gaps and displacements the largest of either, stresses the
/// largest von Mises stress. Closed pairs may differ by those that touch without force. Local.
/// \throws InputError  a summary lacks a key
Comparison compareSummaries(const std::string& then, const std::string& now);

/// The table for the console, a line a figure, and its verdict as the last line. Local.
std::string tableOf(const Comparison& comparison);

/// "energy differs by 2.1e-03, allowed 1.0e-06; ...": figures that do not agree. Local.
std::string failureOf(const Comparison& comparison);

/// comparison.csv. Local. \throws EnvironmentError
void writeComparison(const Comparison& comparison, const std::string& path);

}  // namespace suture
