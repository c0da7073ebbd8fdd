#pragma once
#include <suture/mesh/CellBlock.hpp>

#include <vector>

namespace suture {

/// Sides of elements by their two end points. Finds the owners of a segment, and tells whether it lies on the boundary.
class SideTable {
 public:
  /// Indexes only sides whose end points are both marked: the fewer, the cheaper. \param among  by node
  SideTable(const CellBlock& block, const std::vector<char>& among);
  /// Indexes only sides whose end points occur in `some`.
  SideTable(const CellBlock& block, const std::vector<Side>& some);

  /// The sides (none, one, or two in a sound mesh) that join nodes a and b, in ascending order of elements. Local.
  std::vector<Side> between(int a, int b) const;

  /// True if a side belongs to its element only. Local.
  bool onBoundary(const Side& side) const;

 private:
  struct Entry {
    int high;  ///< end point of higher number
    Side side;
  };
  const CellBlock& block_;
  std::vector<int> start_;  ///< nodes + 1: the sides whose lower end point is node n are entries_[start_[n] .. start_[n+1])
  std::vector<Entry> entries_;
};

}  // namespace suture
