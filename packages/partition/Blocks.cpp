#include <algorithm>
#include <numeric>
#include <suture/mesh/CellGeometry.hpp>
#include <suture/partition/Blocks.hpp>
#include <suture/partition/ConnectedParts.hpp>

namespace suture {
namespace {

struct Centre {
  Point at;
  int element;
};
using Centres = Span<Centre>;

int longerExtent(Centres all) {
  Point low = all[0].at, high = low;
  for (const Centre& centre : all)
    for (int k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], centre.at[k]);
      high[k] = std::max(high[k], centre.at[k]);
    }
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  return axis;
}

// Of these elements; the first block has number `first`.
void bisect(Centres all, Span<const int> subdomains, int first, std::vector<int>& blockOf) {
  if (subdomains.size() == 1) {
    for (const Centre& centre : all) blockOf[centre.element] = first;
    return;
  }
  const std::size_t half = subdomains.size() / 2;
  const Span<const int> low(subdomains.begin(), half), high(subdomains.begin() + half, subdomains.size() - half);
  const double lower = std::accumulate(low.begin(), low.end(), 0.0), upper = std::accumulate(high.begin(), high.end(), 0.0);
  const auto below = static_cast<std::size_t>(static_cast<double>(all.size()) * (lower / (lower + upper)));
  const int axis = longerExtent(all);
  std::nth_element(all.begin(), all.begin() + below, all.end(), [axis](const Centre& a, const Centre& b) {
    return a.at[axis] != b.at[axis] ? a.at[axis] < b.at[axis] : a.element < b.element;
  });
  bisect({all.begin(), below}, low, first, blockOf);
  bisect({all.begin() + below, all.size() - below}, high, first + static_cast<int>(half), blockOf);
}

// A straight cut leaves teeth, each of which is a node more on the seam.
void smoothBorders(const ElementGraph& graph, std::vector<int>& blockOf) {
  std::vector<int> border;
  for (int e = 0; e < graph.elements(); ++e)
    for (const int other : graph.of(e))
      if (blockOf[other] != blockOf[e]) {
        border.push_back(e);
        break;
      }
  const auto neighboursIn = [&](int e, int block) {
    const auto all = graph.of(e);
    return std::count_if(all.begin(), all.end(), [&](int other) { return blockOf[other] == block; });
  };
  constexpr int sweeps = 3;
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const int e : border) {
      int best = blockOf[e];
      for (const int other : graph.of(e))
        if (neighboursIn(e, blockOf[other]) > neighboursIn(e, best)) best = blockOf[other];
      blockOf[e] = best;
    }
}

}  // namespace

std::vector<int> subdomainsOfBlocks(int elements, int subdomains) {
  constexpr int elementsOfBlock = 120000, leastSubdomains = 9;  // METIS' way with less takes longer (MetisCut.cpp)
  const int blocks = std::max(1, std::min((elements + elementsOfBlock / 2) / elementsOfBlock, subdomains / leastSubdomains));
  std::vector<int> of(blocks, subdomains / blocks);
  for (int block = 0; block < subdomains % blocks; ++block) ++of[block];
  return of;
}

std::vector<int> cutIntoBlocks(const CellBlock& mesh, const ElementGraph& graph, const std::vector<std::vector<int>>& parts,
                               const std::vector<std::vector<int>>& subdomains) {
  std::vector<int> blockOf(graph.elements());
  std::size_t blocks = 0;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const std::vector<int>& elements = parts[part];
    const int first = static_cast<int>(blocks);
    blocks += subdomains[part].size();
    if (subdomains[part].size() == 1) {
      for (const int e : elements) blockOf[e] = first;
      continue;
    }
    std::vector<Centre> centres;
    centres.reserve(elements.size());
    for (const int e : elements) centres.push_back({centreOf(mesh, e), e});
    bisect(centres, subdomains[part], first, blockOf);
  }
  if (blocks > parts.size()) {
    smoothBorders(graph, blockOf);
    makeConnected(graph, static_cast<int>(blocks), blockOf);
  }
  return blockOf;
}

}  // namespace suture
