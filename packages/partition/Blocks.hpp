#pragma once
#include <suture/mesh/CellBlock.hpp>
#include <suture/partition/ElementGraph.hpp>

#include <vector>

namespace suture {

/// Into how many subdomains each block of a connected part is cut: blocks of about 120,000 elements and at least nine subdomains, as equal
/// as can be; a smaller part is one block. METIS cuts them one by one, on any rank, and faster than all at once: what it works on stays in
/// the cache (README.md). Local.
std::vector<int> subdomainsOfBlocks(int elements, int subdomains);

/// Cuts connected parts into connected blocks of neighbouring elements, in proportion to their subdomains: recursive bisection across the
/// longer extent by the centres of elements, then borders are smoothed (an element that has more neighbours in another block joins that).
/// Deterministic. Local.
/// \param graph       of the mesh; parts have no neighbours in others
/// \param parts       their elements
/// \param subdomains  of each block of each part
/// \return element -> block, numbered part by part
std::vector<int> cutIntoBlocks(const CellBlock& mesh, const ElementGraph& graph, const std::vector<std::vector<int>>& parts,
                               const std::vector<std::vector<int>>& subdomains);

}  // namespace suture
