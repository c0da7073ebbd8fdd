#pragma once
#include <suture/precond/coarse/CoarseElement.hpp>

#include <vector>

namespace suture {

/// Local problems gathered into connected clusters, and the part of the interface between clusters that this rank needs.
///
/// Two local problems are neighbours if the coarse unknowns they share fix them to each other (not at a hinge, not on a sliding contact
/// line), so that a cluster moves as one body. Each rank cuts its own graph by METIS: no rank knows all local problems, and the matrices of
/// a cluster are already on its rank. A rank's local problems are close to each other (numberSubdomainsAlongCurve), so its clusters are
/// compact; those that are not are divided (divideSlender). Entities between clusters: see clusterEntities().
struct CoarseClusters {
  std::vector<int> clusterOf;  ///< cluster of each element of this rank, a place in `layout.locals`
  InterfaceLayout layout;      ///< clusters of this rank as local problems, coarse unknowns as unknowns
  int count = 0;               ///< clusters over all ranks
};

/// Ranks that share coarse unknowns exchange their data; messages and memory are proportional to a rank's own elements. Collective.
/// \param locals  local problems over all ranks
/// \param wanted  clusters over all ranks, distributed in proportion to each rank's local problems; at least one per connected part and
/// rank, at most one per local problem; 0: automaticClusters(). Divided slender clusters (divideSlender) come on top.
CoarseClusters coarseClusters(const CommPtr& comm, const CoarseElements& coarse, int locals, int wanted);

/// Default number of clusters: about the square root of the number of local problems, at least one per rank.
int automaticClusters(int locals, int ranks);

}  // namespace suture
