#pragma once
#include <suture/partition/cut/ElementGraph.hpp>

#include <vector>

namespace suture {

/// Turns any labelling of a connected graph into `parts` parts that are all connected and not empty, changing as little as it can: of every
/// part its largest component stays, the others go to the neighbouring part with which they share most sides; then, while a part is
/// empty, the largest one is cut in two. Labels outside 0..parts-1 are not allowed; needs parts <= elements. Deterministic. Local.
/// \return how many repairs that took: components given away and empty parts filled
int makeConnected(const ElementGraph& graph, int parts, std::vector<int>& partOf);

}  // namespace suture
