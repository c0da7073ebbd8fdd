#pragma once
#include <suture/partition/cut/ElementGraph.hpp>

#include <vector>

namespace suture {

/// Cuts a connected graph into exactly `parts` parts, none empty, each connected: METIS, in space halving by METIS or planes
/// (bisectInSpace), then repaired by makeConnected(). The same seed gives the same parts. Needs 1 <= parts <= elements. Local. \throws
/// InternalError  when METIS fails. \param repairs  gets how often METIS' answer had to be repaired (as makeConnected() counts); may be
/// null
std::vector<int> metisCut(const ElementGraph& graph, int parts, int seed, int* repairs = nullptr);

/// A graph whose vertices are groups of elements.
struct GroupGraph {
  ElementGraph graph;
  std::vector<int> elements;  ///< number of elements of each group
  std::vector<int> sides;     ///< as graph.neighbours: how many sides the two groups have in common
};

/// Cuts a graph of groups in proportion to `shares`, one for each part, by METIS' recursive bisection. Parts need not be connected. The
/// same seed gives the same parts. Local. \throws InternalError  when METIS fails.
std::vector<int> metisShares(const GroupGraph& groups, const std::vector<int>& shares, int seed);

}  // namespace suture
