#pragma once
#include <suture/precond/coarse/CoarseElement.hpp>

#include <vector>

namespace suture {

/// Local problems gathered into connected clusters, and the interface between these, as far as this rank needs it.
///
/// Local problems are neighbours when the coarse unknowns they share fix them to each other (not at a hinge, not on a contact line that
/// slides), so that a cluster moves as one body. Each rank cuts the graph of its own by METIS: no rank knows all local problems, and a
/// cluster's matrices are where they are needed. Entities between clusters: see clusterEntities().
struct CoarseClusters {
  std::vector<int> clusterOf;  ///< cluster of each element of this rank, a place in `layout.locals`
  InterfaceLayout layout;      ///< clusters of this rank as local problems, coarse unknowns as unknowns
  int count = 0;               ///< clusters over all ranks
};

/// Ranks that share coarse unknowns tell each other what they know of them: messages and memory in proportion to a rank's own elements.
/// Collective.
/// \param locals  local problems over all ranks
/// \param wanted  clusters over all ranks, each rank's part in proportion to its local problems; at least one for each connected part and
///                rank, at most one for each local problem; 0: automaticClusters()
CoarseClusters coarseClusters(const CommPtr& comm, const CoarseElements& coarse, int locals, int wanted);

/// Clusters for so many local problems on so many ranks where the user names none: about the square root of the number of local problems.
int automaticClusters(int locals, int ranks);

}  // namespace suture
