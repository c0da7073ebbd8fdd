#include <algorithm>
#include <suture/partition/cut/Blocks.hpp>
#include <suture/partition/cut/ConnectedParts.hpp>
#include <suture/partition/cut/MetisCut.hpp>

namespace suture {
namespace {

// Connected groups of neighbouring elements of a part, made breadth first from the first element without a group.
struct Groups {
  std::vector<int> offsets{0}, elements;

  // groupOf: group of every element of the graph, -1 for the elements of the part; the constructor sets it for the part.
  Groups(const ElementGraph& graph, const std::vector<int>& part, std::vector<int>& groupOf) {
    constexpr std::size_t most = 32;
    elements.reserve(part.size());
    for (const int first : part) {
      if (groupOf[first] >= 0) continue;
      const std::size_t end = elements.size() + most;
      const auto take = [&](int e) {
        if (groupOf[e] >= 0 || elements.size() == end) return;
        groupOf[e] = count();
        elements.push_back(e);
      };
      take(first);
      for (auto at = static_cast<std::size_t>(offsets.back()); at < elements.size() && elements.size() < end; ++at)
        for (const int other : graph.of(elements[at])) take(other);
      offsets.push_back(static_cast<int>(elements.size()));
    }
  }
  int count() const { return static_cast<int>(offsets.size()) - 1; }
};

GroupGraph graphOf(const ElementGraph& graph, const Groups& groups, const std::vector<int>& groupOf) {
  GroupGraph of;
  std::vector<int>& neighbours = of.graph.neighbours;
  for (int group = 0; group < groups.count(); ++group) {
    const std::size_t first = neighbours.size();
    for (int i = groups.offsets[group]; i < groups.offsets[group + 1]; ++i)
      for (const int element : graph.of(groups.elements[i])) {
        const int other = groupOf[element];
        if (other == group) continue;
        const auto known = std::find(neighbours.begin() + first, neighbours.end(), other);
        if (known != neighbours.end()) {
          ++of.sides[known - neighbours.begin()];
        } else {
          neighbours.push_back(other);
          of.sides.push_back(1);
        }
      }
    of.graph.offsets.push_back(static_cast<int>(neighbours.size()));
    of.elements.push_back(groups.offsets[group + 1] - groups.offsets[group]);
  }
  return of;
}

// Borders of groups are jagged; each tooth adds a node to the seam.
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
  constexpr int sweeps = 5;
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
  constexpr int elementsOfBlock = 240000, leastSubdomains = 9;  // METIS' method for fewer parts is slower (MetisCut.cpp)
  const int blocks = std::max(1, std::min((elements + elementsOfBlock / 2) / elementsOfBlock, subdomains / leastSubdomains));
  std::vector<int> of(blocks, subdomains / blocks);
  for (int block = 0; block < subdomains % blocks; ++block) ++of[block];
  return of;
}

std::vector<int> cutIntoBlocks(const ElementGraph& graph, const std::vector<std::vector<int>>& parts,
                               const std::vector<std::vector<int>>& subdomains, int seed) {
  std::vector<int> blockOf(graph.elements()), groupOf;
  int blocks = 0;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const int first = blocks;
    blocks += static_cast<int>(subdomains[part].size());
    if (subdomains[part].size() == 1) {
      for (const int e : parts[part]) blockOf[e] = first;
      continue;
    }
    groupOf.resize(graph.elements(), -1);
    const Groups groups(graph, parts[part], groupOf);
    const std::vector<int> blockOfGroup = metisShares(graphOf(graph, groups, groupOf), subdomains[part], seed);
    for (const int e : parts[part]) blockOf[e] = first + blockOfGroup[groupOf[e]];
  }
  if (blocks > static_cast<int>(parts.size())) {
    smoothBorders(graph, blockOf);
    makeConnected(graph, blocks, blockOf);
  }
  return blockOf;
}

}  // namespace suture
