#pragma once
#include <suture/precond/coarse/CoarseElement.hpp>

#include <vector>

namespace suture {

/// Local problems gathered into connected clusters, and the interface between these, as far as each rank needs it.
///
/// Local problems are neighbours when the coarse unknowns they share fix them to each other (not at a hinge, not on a contact line that
/// slides), so that a cluster moves as one body; the graph is cut by METIS. Entities between clusters: see clusterEntities().
struct CoarseClusters {
  std::vector<int> clusterOf, rankOf;  ///< cluster of each element of this rank, and the rank that holds it
  std::vector<int> neighbours;         ///< ranks with which this one exchanges elements, both ways
  InterfaceLayout layout;              ///< clusters of this rank as local problems, coarse unknowns as unknowns
  int count = 0;                       ///< clusters over all ranks
};

/// Rank 0 gathers the connections, cuts, and tells each rank its part: memory there in proportion to the number of local problems.
/// The clusters are the same on any number of ranks but for `wanted` = 0. Collective.
/// \param wanted  clusters; at least one for each connected part and rank, at most one for each local problem; 0: about the square root of
///                the number of local problems
CoarseClusters coarseClusters(const Comm& comm, const CoarseElements& coarse, int wanted);

/// Clusters for so many local problems on so many ranks where the user names none.
int automaticClusters(int locals, int ranks);

}  // namespace suture
