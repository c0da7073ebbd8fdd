#pragma once
#include <suture/partition/cut/ElementGraph.hpp>

#include <vector>

namespace suture {

/// Number of subdomains of each block of a connected part: blocks have about 240,000 elements and at least nine subdomains, and are as
/// equal as possible; a smaller part is one block. Blocks distribute METIS' work among ranks. Local.
std::vector<int> subdomainsOfBlocks(int elements, int subdomains);

/// Cuts connected parts into connected blocks, in proportion to their subdomains: METIS on groups of up to 32 neighbouring elements, then
/// borders are smoothed (an element with more neighbours in another block joins that block). Bisection by coordinates would take half the
/// time, but on graded meshes its blocks end in slivers (Hertz at 1M: condition 9.5 to 12.7 instead of 6.8 to 9.9, eight seeds
/// each). Deterministic. Local.
/// \param graph       parts have no neighbours in other parts
/// \param parts       elements of each part
/// \param subdomains  number of subdomains of each block of each part
/// \return element -> block, numbered part by part
std::vector<int> cutIntoBlocks(const ElementGraph& graph, const std::vector<std::vector<int>>& parts,
                               const std::vector<std::vector<int>>& subdomains, int seed);

}  // namespace suture
