#include <Teuchos_Comm.hpp>
#include <algorithm>
#include <suture/base/Buffer.hpp>
#include <suture/base/Collective.hpp>
#include <suture/partition/cut/CutBlocks.hpp>
#include <suture/partition/cut/MetisCut.hpp>

namespace suture {
namespace {

const char* const cutting = "partition";

// Sends data of every block from rank `from` to rank `to` of the block. Collective.
template <typename From, typename To, typename Put, typename Take>
void deliver(const Comm& comm, const std::vector<Block>& blocks, const From& from, const To& to, const Put& put, const Take& take) {
  const int me = comm.getRank();
  for (int rank = 0; rank < comm.getSize(); ++rank) {
    std::vector<int> senders;
    for (const Block& block : blocks)
      if (to(block) == rank && from(block) != rank) senders.push_back(from(block));
    if (senders.empty()) continue;
    std::sort(senders.begin(), senders.end());
    senders.erase(std::unique(senders.begin(), senders.end()), senders.end());
    const auto forEachBlock = [&](int sender, const auto& visit) {
      for (std::size_t i = 0; i < blocks.size(); ++i)
        if (to(blocks[i]) == rank && from(blocks[i]) == sender) visit(i);
    };
    Packer packer;
    collectively(comm, cutting, [&] {
      if (me != rank) forEachBlock(me, [&](std::size_t i) { put(i, packer); });
    });
    std::vector<std::string> received = gatherOn(comm, rank, senders, packer.bytes());
    collectively(comm, cutting, [&] {
      for (std::size_t k = 0; k < received.size(); ++k) {
        Unpacker unpacker(std::move(received[k]));
        forEachBlock(senders[k], [&](std::size_t i) { take(i, unpacker); });
      }
    });
  }
}

}  // namespace

void placeBlocks(const std::vector<int>& elements, int ranks, std::vector<Block>& blocks) {
  constexpr double sent = 1.1;  // relative cost of a block that is sent to another rank and back
  std::vector<double> load(ranks, 0.0);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i].cutter = blocks[i].owner;
    load[blocks[i].owner] += elements[i];
  }
  for (std::size_t moved = 0; moved < blocks.size(); ++moved) {
    const auto most = std::max_element(load.begin(), load.end()), least = std::min_element(load.begin(), load.end());
    const auto busiest = static_cast<int>(most - load.begin());
    // Find the block whose move helps these two ranks most; blocks that were moved stay where they are.
    std::size_t best = blocks.size();
    double after = *most;
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (blocks[i].cutter != busiest || blocks[i].owner != busiest) continue;
      const double then = std::max(*most - elements[i], *least + sent * elements[i]);
      if (then < after) {
        after = then;
        best = i;
      }
    }
    if (best == blocks.size()) return;
    blocks[best].cutter = static_cast<int>(least - load.begin());
    *most -= elements[best];
    *least += sent * elements[best];
  }
}

std::vector<BlockCut> cutBlocks(const Comm& comm, const std::vector<Block>& blocks, std::vector<ElementGraph> graphs, int seed) {
  const int me = comm.getRank();
  const auto ownerOf = [](const Block& block) { return block.owner; };
  const auto cutterOf = [](const Block& block) { return block.cutter; };
  std::vector<ElementGraph> graphOf(blocks.size());
  std::vector<BlockCut> cutOf(blocks.size());
  auto next = graphs.begin();
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (blocks[i].owner == me) graphOf[i] = std::move(*next++);

  deliver(
      comm, blocks, ownerOf, cutterOf,
      [&](std::size_t i, Packer& packer) {
        packer.put(graphOf[i].offsets);
        packer.put(graphOf[i].neighbours);
        packer.put(graphOf[i].centres);
        graphOf[i] = ElementGraph();
      },
      [&](std::size_t i, Unpacker& unpacker) {
        unpacker.get(graphOf[i].offsets);
        unpacker.get(graphOf[i].neighbours);
        unpacker.get(graphOf[i].centres);
      });
  collectively(comm, cutting, [&] {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      if (blocks[i].cutter != me) continue;
      cutOf[i].partOf = metisCut(graphOf[i], blocks[i].subdomains, seed, &cutOf[i].repairs);
      graphOf[i] = ElementGraph();
    }
  });
  deliver(
      comm, blocks, cutterOf, ownerOf,
      [&](std::size_t i, Packer& packer) {
        packer.put(cutOf[i].partOf);
        packer.put(cutOf[i].repairs);
      },
      [&](std::size_t i, Unpacker& unpacker) {
        unpacker.get(cutOf[i].partOf);
        unpacker.get(cutOf[i].repairs);
      });

  std::vector<BlockCut> mine;
  for (std::size_t i = 0; i < blocks.size(); ++i)
    if (blocks[i].owner == me) mine.push_back(std::move(cutOf[i]));
  return mine;
}

}  // namespace suture
