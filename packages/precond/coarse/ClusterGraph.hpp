#pragma once
#include <suture/partition/cut/ElementGraph.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>

#include <vector>

namespace suture {

/// All local problems and the coarse unknowns they name, on one rank, without the matrices.
struct ClusterGraph {
  std::vector<std::vector<int>> unknownsOf;        ///< unknowns of each local problem, by ascending id
  std::vector<InterfaceLayout::Unknown> unknowns;  ///< by number
  std::vector<std::vector<int>> holders;           ///< local problems that hold each unknown, ascending

  /// From unknownsOf.
  void findHolders();
};

/// Local problems as vertices; neighbours share unknowns whose values under rigid motions determine the motion. Local.
ElementGraph fixedNeighbours(const ClusterGraph& graph);

/// The interface of clusters: corners and edges of the layout, both of all clusters. `boundaries`, `locals`, `unknowns` are for the caller.
/// \param clusterOf  cluster of each local problem. Local.
InterfaceLayout clusterEntities(const ClusterGraph& graph, const std::vector<int>& clusterOf);

}  // namespace suture
