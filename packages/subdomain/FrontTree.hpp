#pragma once
#include <suture/subdomain/SparseMatrix.hpp>

#include <vector>

namespace suture {

/// In which order the interior unknowns of a subdomain are eliminated, and in which dense fronts: the symbolic part of a multifrontal
/// factorisation (Duff and Reid 1983; Liu 1992) with the boundary last. Unknowns that follow each other and have the same pattern, as those
/// of a node, are one group: ordering (AMD, of the interior alone), elimination tree and supernodes (relaxed) are CHOLMOD's, of the graph
/// of groups, which has a quarter of the entries. Local.
struct FrontTree {
  /// A front eliminates some groups that follow each other; what is below them is numbered by `rows`. Children come before parents, and all
  /// descendants of a front directly before it.
  struct Front {
    int firstGroup = 0, endGroup = 0;
    int firstRow = 0, endRow = 0;  // in `rows`
    int parent = -1;               // -1: what it leaves belongs to the boundary
  };

  /// \param boundary  unknowns that are not eliminated
  /// \throws EnvironmentError  out of memory
  FrontTree(const SparseMatrix& matrix, const std::vector<int>& boundary);

  int groups() const { return static_cast<int>(start.size()) - 1; }
  /// Unknowns that are eliminated.
  int interior() const { return start[interiorGroups]; }

  std::vector<int> unknownAt;  ///< position -> unknown: interior in the order of elimination, then the boundary, ascending
  std::vector<int> start;      ///< group -> its first position; groups + 1 numbers
  int interiorGroups = 0;
  std::vector<Front> fronts;
  std::vector<int> rows;  ///< groups, ascending within a front
};

}  // namespace suture
