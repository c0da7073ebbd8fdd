#pragma once
#include <suture/partition/cut/ElementGraph.hpp>

#include <vector>

namespace suture {

/// Turns any labelling of a connected graph into `parts` connected, nonempty parts, with few changes: the largest component of every part
/// stays, the others go to the neighbouring part with which they share most sides; then, while a part is empty, the largest one is cut in
/// two. Labels must be in 0..parts-1; needs parts <= elements. Deterministic. Local.
/// \return number of repairs: components given away and empty parts filled
int makeConnected(const ElementGraph& graph, int parts, std::vector<int>& partOf);

}  // namespace suture
