#pragma once
#include <suture/base/Types.hpp>
#include <suture/partition/cut/ElementGraph.hpp>

#include <vector>

namespace suture {

/// Connected elements of a rank's share that METIS cuts into subdomains independently of other blocks.
struct Block {
  int owner, part;        ///< rank that has the elements, and index of their connected part on that rank
  int first, subdomains;  ///< numbers of its subdomains
  int cutter;             ///< rank that calls METIS
};

/// Assigns each block (with its number of elements) to a rank that cuts it: initially its owner; while that lowers the load of the busiest
/// rank, one of that rank's blocks moves to the least loaded rank. Deterministic. Local.
void placeBlocks(const std::vector<int>& elements, int ranks, std::vector<Block>& blocks);

/// Result of METIS for a block.
struct BlockCut {
  std::vector<int> partOf;  ///< element of the block -> subdomain, counted from the block's first
  int repairs = 0;          ///< as counted by metisCut()
};

/// Cuts every block on its cutter, which gets the graph from the owner and sends back the cut. Collective.
/// \param blocks  the same on all ranks
/// \param graphs  graphs of this rank's own blocks, in their order
/// \return cuts of this rank's own blocks, in their order, regardless of the rank that made them
std::vector<BlockCut> cutBlocks(const Comm& comm, const std::vector<Block>& blocks, std::vector<ElementGraph> graphs, int seed);

}  // namespace suture
