#pragma once
#include <suture/report/Run.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// What the pairs of a run say together.
struct ContactFigures {
  int pairs = 0, active = 0;
  double maxPressure = 0.0;            ///< [stress]; of a scene without pairs 0
  double maxGap = 0.0;                 ///< largest current gap [length]
  double maxPenetration = 0.0;         ///< largest -gap [length]
  std::vector<Point> forceOnB;         ///< of each piece: sum of the pairs' forces on side B [force]
  std::vector<double> pressureOf;      ///< of each piece: its largest pressure
  std::vector<double> gapOf;           ///< of each piece: its largest gap
  std::vector<int> pairsOf, activeOf;  ///< of each piece
};

/// Local; \param pieces number of pieces
ContactFigures contactFigures(const std::vector<PairResult>& pairs, int pieces);

/// Largest |u| over all nodes [length]. Collective.
double maxDisplacement(const Run& run);

/// Largest resident memory of the ranks [MB].
struct Memory {
  double min, avg, max, sum;
};
/// Collective.
Memory peakMemory(const Comm& comm);
/// Over all ranks, of what each has. Collective.
Memory memoryFigures(const Comm& comm, double mine);

/// How evenly the elements lie on the ranks.
struct ElementsByRank {
  GlobalId least, most, sum;
  int ranks;
  /// The largest number over the average; 1 is even.
  double imbalance() const { return sum > 0 ? double(most) * ranks / double(sum) : 1.0; }
};
/// Collective.
ElementsByRank elementsByRank(const Run& run);

}  // namespace suture
