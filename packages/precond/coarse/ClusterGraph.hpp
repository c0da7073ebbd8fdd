#pragma once
#include <suture/partition/cut/ElementGraph.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>

#include <vector>

namespace suture {

/// Local problems and the coarse unknowns they name, without the matrices. Unknowns are numbered 0, 1, ... in the order of their global
/// numbers, so all ranks that know an entity list its unknowns in the same order.
struct ClusterGraph {
  int dimension = 2;
  std::vector<std::vector<int>> unknownsOf;        ///< unknowns of each local problem
  std::vector<InterfaceLayout::Unknown> unknowns;  ///< by number
  std::vector<std::vector<int>> holders;           ///< local problems that hold each unknown, ascending

  /// Sets `holders` from `unknownsOf`.
  void findHolders();
};

/// Graph of local problems; two are neighbours if the unknowns they share determine all rigid motions. Local.
ElementGraph fixedNeighbours(const ClusterGraph& graph);

/// Divides clusters that are more than eight times as long as wide (in 3D as the wider of both widths) into pieces four times as long as
/// wide: the condition number of BDDC on adjacent strips grows with the fourth power of length over width. Pieces are connected if the
/// cluster is. Local. \param neighbours  of the local problems \param clusterOf  changed: numbers below the result  \return clusters
int divideSlender(const ClusterGraph& graph, const ElementGraph& neighbours, int clusters, std::vector<int>& clusterOf);

/// Vertices and edges between clusters, in the coarse unknowns of the graph. Unknowns of two clusters are connected if two local problems,
/// one in each cluster, share both of them. The ends of an edge are its unknowns at the two points that are farthest apart, including the
/// vertices that bound it. \param clusterOf  cluster of each local problem. Local.
std::vector<InterfaceLayout::Entity> clusterEntities(const ClusterGraph& graph, const std::vector<int>& clusterOf);

}  // namespace suture
