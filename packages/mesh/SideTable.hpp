#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Table of the sides of elements by their vertices. Finds the owners of a segment or a face, and whether it lies on the boundary.
class SideTable {
 public:
  /// Indexes only sides whose vertices are all marked, to save time. \param among  by node
  SideTable(const CellBlock& block, const std::vector<char>& among);
  /// Indexes only sides whose vertices all occur in `some`.
  SideTable(const CellBlock& block, const std::vector<Side>& some);

  /// The sides (none, one, or two in a valid mesh) with these vertices, in ascending order of elements. Local.
  std::vector<Side> of(const SideKey& key) const;

  /// True if a side belongs to one element only. Local.
  bool onBoundary(const Side& side) const;

 private:
  struct Entry {
    long long rest;  ///< SideKey::rest
    Side side;
  };
  const CellBlock& block_;
  std::vector<int> start_;  ///< nodes + 1: the sides whose lowest vertex is node n are entries_[start_[n] .. start_[n+1])
  std::vector<Entry> entries_;
};

}  // namespace suture
