#pragma once
#include <suture/partition/ElementGraph.hpp>

#include <vector>

namespace suture {

/// Cuts a connected graph into exactly `parts` parts, none empty, each connected: METIS, then repaired by makeConnected(). The same seed
/// gives the same parts. Needs 1 <= parts <= elements. Local. \throws InternalError  when METIS fails.
/// \param repairs  gets how often METIS' answer had to be repaired (as makeConnected() counts); may be null
std::vector<int> metisCut(const ElementGraph& graph, int parts, int seed, int* repairs = nullptr);

}  // namespace suture
