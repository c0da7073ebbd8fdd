#pragma once
#include <suture/report/Run.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Friction figures, over pairs whose law restricts sliding.
struct FrictionFigures {
  int pairs = 0, sticking = 0, slipping = 0;
  double maxMobilisation = 0.0;  ///< largest ratio of tangential force to its bound, over pairs with a positive bound
  double tangential = 0.0;       ///< sum of the magnitudes of their tangential forces [force]
  double bound = 0.0;            ///< sum of their bounds [force]
  double dissipated = 0.0;       ///< work of the pairs that slip [energy]
  Point onB{0, 0, 0};            ///< sum of the tangential forces on side B [force]

  void add(const PairResult& pair);
  /// Mean over the pairs, weighted by their bounds.
  double meanMobilisation() const { return bound > 0.0 ? tangential / bound : 0.0; }
};

/// Contact figures over all pairs of a run.
struct ContactFigures {
  int pairs = 0, active = 0;
  int touching = 0;                    ///< open pairs with zero gap
  double maxPressure = 0.0;            ///< [stress]; 0 without pairs
  double maxGap = 0.0;                 ///< largest current gap [length]
  double maxPenetration = 0.0;         ///< largest -gap [length]
  std::vector<Point> forceOnB;         ///< sum of each piece's pair forces on side B, including tangential forces [force]
  std::vector<double> pressureOf;      ///< largest pressure of each piece
  std::vector<double> gapOf;           ///< largest gap of each piece
  std::vector<int> pairsOf, activeOf;  ///< pairs and closed pairs of each piece
  FrictionFigures friction;
  std::vector<FrictionFigures> frictionOf;  ///< by piece
};

/// True if the law of at least one pair restricts sliding. Local.
bool hasFriction(const std::vector<PairResult>& pairs);

/// Local; \param pieces number of pieces
ContactFigures contactFigures(const std::vector<PairResult>& pairs, int pieces);

/// The same, including pressures on the axis in the maxima.
ContactFigures contactFigures(const Solution& solution, int pieces);

/// Estimated error of nodal pressures, relative to the largest pressure of a piece, caused by straight elements on curved sides; 0
/// without pressure. Local. \param largest  pressure of the piece [stress]
double pressureError(const ContactPiece& piece, double largest);

/// A warning if the estimated discretisation error of a converged solution exceeds a quarter of its energy norm. Uses the requested
/// estimate, otherwise the cheap one. Local, the same on all ranks.
std::vector<std::string> meshNotes(const Solution& solution);

/// Notes on contact pressures: estimated errors above one per cent and node-to-node oscillations above three per cent, per piece; warnings
/// above ten per cent. Collective, the same on all ranks. \param pieces, solution  as in Run
std::vector<std::string> pressureNotes(const Comm& comm, const std::vector<ContactPiece>& pieces, const Solution& solution);

/// Notes on solutions beyond the assumptions of the program: strains or rotations above a tenth, and contacts of at least ten pairs whose
/// pressure is carried by one to three pairs. Collective, the same on all ranks.
/// \param meshes  those of solution.displacement;  \param pieces, solution  as in Run
std::vector<std::string> plausibilityNotes(const Comm& comm, const std::vector<SubdomainMesh>& meshes, const ElasticModel& model,
                                           const std::vector<ContactPiece>& pieces, const Solution& solution);

/// Largest |u| over all nodes [length]. Collective.
double maxDisplacement(const Run& run);

/// Largest resident memory of the ranks [MB].
struct Memory {
  double min, avg, max, sum;
};
/// Collective.
Memory peakMemory(const Comm& comm);

/// Figures of a run in addition to its solution, for summary and console, collected after its files are written.
struct RunFigures {
  double largestDisplacement;              ///< largest |u| over all nodes [length]
  std::vector<Timers::Statistics> phases;  ///< [s]
  Memory memory;                           ///< [MB]
  int dimension = 2;
};
/// Collective.
RunFigures runFigures(const Run& run);

/// Statistics of one value per rank. Collective.
Memory memoryFigures(const Comm& comm, double mine);

/// Distribution of the elements over the ranks.
struct ElementsByRank {
  GlobalId least, most, sum;
  int ranks;
  /// Largest number over the average; 1 if balanced.
  double imbalance() const { return sum > 0 ? double(most) * ranks / double(sum) : 1.0; }
};
/// Collective.
ElementsByRank elementsByRank(const Run& run);

}  // namespace suture
