#pragma once
#include <suture/partition/cut/ElementGraph.hpp>
#include <suture/precond/coarse/CoarseElement.hpp>

#include <vector>

namespace suture {

/// Local problems and the coarse unknowns they name, without the matrices. Unknowns are numbered 0, 1, ... in the order of their numbers
/// over all ranks, so that ranks which know the same entity list it alike.
struct ClusterGraph {
  int dimension = 2;
  std::vector<std::vector<int>> unknownsOf;        ///< unknowns of each local problem
  std::vector<InterfaceLayout::Unknown> unknowns;  ///< by number
  std::vector<std::vector<int>> holders;           ///< local problems that hold each unknown, ascending

  /// From unknownsOf.
  void findHolders();
};

/// Local problems as vertices; neighbours share unknowns whose values under rigid motions determine the motion. Local.
ElementGraph fixedNeighbours(const ClusterGraph& graph);

/// Vertices and edges between clusters in coarse unknowns, those that the graph knows. Unknowns of two clusters hang together where two
/// local problems, one in each, share both of them. The ends of an edge are its unknowns at the two places that are farthest apart, counted
/// with the vertices that bound it. \param clusterOf  cluster of each local problem. Local.
std::vector<InterfaceLayout::Entity> clusterEntities(const ClusterGraph& graph, const std::vector<int>& clusterOf);

}  // namespace suture
