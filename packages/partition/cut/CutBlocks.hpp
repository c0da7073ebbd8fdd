#pragma once
#include <suture/base/Types.hpp>
#include <suture/partition/cut/ElementGraph.hpp>

#include <vector>

namespace suture {

/// Connected elements of a rank's share that METIS cuts into subdomains by themselves.
struct Block {
  int owner, part;        ///< rank that has the elements, and which of its connected parts they are of
  int first, subdomains;  ///< numbers of its subdomains
  int cutter;             ///< rank that calls METIS
};

/// Gives each block of so many elements a rank that cuts it: its owner, but while that makes the busiest rank less so, one of its blocks
/// goes to the rank that has least. Deterministic. Local.
void placeBlocks(const std::vector<int>& elements, int ranks, std::vector<Block>& blocks);

/// Result of METIS for a block.
struct BlockCut {
  std::vector<int> partOf;  ///< element of the block -> subdomain, counted from the block's first
  int repairs = 0;          ///< as metisCut() counts
};

/// Every block on its cutter, which gets the graph from the owner and sends back the cut. Collective.
/// \param blocks  the same on all ranks
/// \param graphs  graphs of this rank's own blocks, in their order
/// \return cuts of this rank's own blocks, in their order, wherever they were made
std::vector<BlockCut> cutBlocks(const Comm& comm, const std::vector<Block>& blocks, std::vector<ElementGraph> graphs, int seed);

}  // namespace suture
