#pragma once
#include <suture/report/Run.hpp>

#include <map>
#include <string>
#include <vector>

namespace suture {

/// Figures of friction: of pairs whose law restricts sliding.
struct FrictionFigures {
  int pairs = 0, sticking = 0, slipping = 0;
  double maxMobilisation = 0.0;  ///< largest tangential force over its bound; of pairs that have one above zero
  double tangential = 0.0;       ///< sum of magnitudes of these pairs [force]
  double bound = 0.0;            ///< sum of their bounds [force]
  double dissipated = 0.0;       ///< work of the pairs that slip [energy]
  Point onB{0, 0, 0};            ///< sum of the tangential forces on side B [force]

  void add(const PairResult& pair);
  /// The mean over the pairs by their bounds.
  double meanMobilisation() const { return bound > 0.0 ? tangential / bound : 0.0; }
};

/// Figures of all pairs of a run.
struct ContactFigures {
  int pairs = 0, active = 0;
  int touching = 0;                    ///< open ones without a gap
  double maxPressure = 0.0;            ///< [stress]; of a scene without pairs 0
  double maxGap = 0.0;                 ///< largest current gap [length]
  double maxPenetration = 0.0;         ///< largest -gap [length]
  std::vector<Point> forceOnB;         ///< sum of each piece's pair forces on side B, tangential ones among them [force]
  std::vector<double> pressureOf;      ///< largest pressure of each piece
  std::vector<double> gapOf;           ///< largest gap of each piece
  std::vector<int> pairsOf, activeOf;  ///< pairs and closed pairs of each piece
  FrictionFigures friction;
  std::vector<FrictionFigures> frictionOf;  ///< by piece
};

/// True if some pair's law restricts sliding. Local.
bool hasFriction(const std::vector<PairResult>& pairs);

/// Local; \param pieces number of pieces
ContactFigures contactFigures(const std::vector<PairResult>& pairs, int pieces);

/// The same, with pressures on the axis among the largest.
ContactFigures contactFigures(const Solution& solution, int pieces);

/// Estimated error of nodal pressures relative to the largest one of a piece, where straight elements stand for curved sides; 0 without
/// pressure. Local. \param largest  pressure of the piece [stress]
double pressureError(const ContactPiece& piece, double largest);

/// A warning where the estimated error of the mesh exceeds a quarter of the energy norm of a converged solution: by the estimate that was
/// asked for, or else by the cheap one. Local, the same on all ranks.
std::vector<std::string> meshNotes(const Solution& solution);

/// Sentences on estimated errors of contact pressures, each piece above one per cent, and on pressures that alternate from node to node by
/// more than three: beyond ten per cent warnings. Collective, the same on all ranks. \param pieces, solution  as in Run
std::vector<std::string> pressureNotes(const Comm& comm, const std::vector<ContactPiece>& pieces, const Solution& solution);

/// Sentences on solutions that a small-strain program should not be trusted with unseen: strains or rotations of elements beyond a tenth,
/// and long contacts (of at least ten pairs) of which one or two pairs alone are closed. Collective, the same on all ranks.
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

/// Figures of a run beside its solution, for summary and console, gathered once its files are written.
struct RunFigures {
  double largestDisplacement;              ///< largest |u| over all nodes [length]
  std::vector<Timers::Statistics> phases;  ///< [s]
  Memory memory;                           ///< [MB]
  int dimension = 2;
};
/// Collective.
RunFigures runFigures(const Run& run);

/// Over all ranks, of what each has. Collective.
Memory memoryFigures(const Comm& comm, double mine);

/// Distribution of the elements over the ranks.
struct ElementsByRank {
  GlobalId least, most, sum;
  int ranks;
  /// The largest number over the average; 1 is even.
  double imbalance() const { return sum > 0 ? double(most) * ranks / double(sum) : 1.0; }
};
/// Collective.
ElementsByRank elementsByRank(const Run& run);

}  // namespace suture
