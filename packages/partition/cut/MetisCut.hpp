#pragma once
#include <suture/partition/cut/ElementGraph.hpp>

#include <vector>

namespace suture {

/// Cuts a connected graph into exactly `parts` nonempty, connected parts: METIS (in 3D bisection by METIS or planes, bisectInSpace), then
/// repaired by makeConnected(). The same seed gives the same parts. Needs 1 <= parts <= elements. Local.
/// \throws InternalError  if METIS fails. \param repairs  gets the number of repairs (as counted by makeConnected()); may be null
std::vector<int> metisCut(const ElementGraph& graph, int parts, int seed, int* repairs = nullptr);

/// A graph whose vertices are groups of elements.
struct GroupGraph {
  ElementGraph graph;
  std::vector<int> elements;  ///< number of elements of each group
  std::vector<int> sides;     ///< as graph.neighbours: number of common sides of the two groups
};

/// Cuts a graph of groups in proportion to `shares`, one per part, by METIS' recursive bisection. Parts need not be connected. The
/// same seed gives the same parts. Local. \throws InternalError  if METIS fails.
std::vector<int> metisShares(const GroupGraph& groups, const std::vector<int>& shares, int seed);

}  // namespace suture
