#include <suture/algebra/elimination/FrontTree.hpp>
#include <suture/algebra/elimination/NestedDissection.hpp>

#include <algorithm>
#include <numeric>

namespace suture {

namespace {

// Up to this many groups are eliminated in one dense front, including zeros. 4 to 16 take the same time within noise; 16 gives a tenth more
// entries in the factor, 24 a third.
constexpr int kLeaf = 8;

/// Groups of unknowns in the order of the matrix, interior ones first.
struct Groups {
  std::vector<int> first;  // unknown
  std::vector<int> size;   // unknowns
  std::vector<int> of;     // unknown -> group
  int interior = 0;

  int count() const { return static_cast<int>(first.size()); }
};

/// For each unknown, true if it has the pattern of the previous one: both occur in the same earlier columns, and the rows below them are
/// the same.
std::vector<char> patternOfTheOneBefore(const SymmetricMatrix& matrix) {
  const int n = matrix.rows(), *first = matrix.lower().outerIndexPtr(), *rows = matrix.lower().innerIndexPtr();
  std::vector<char> same(n + 1, 1);
  same[0] = 0;
  for (int j = 0; j < n; ++j) {
    const int end = first[j + 1], begin = first[j] < end && rows[first[j]] == j ? first[j] + 1 : first[j];  // below the diagonal
    for (int k = begin; k < end; ++k) {
      if (k + 1 == end || rows[k + 1] != rows[k] + 1) same[rows[k] + 1] = 0;
      if ((k == begin ? j : rows[k - 1]) != rows[k] - 1) same[rows[k]] = 0;
    }
    if (j + 1 < n) same[j + 1] = same[j + 1] && end - begin == first[j + 2] - end && std::equal(rows + begin, rows + end, rows + end);
  }
  return same;
}

Groups groupsOf(const SymmetricMatrix& matrix, const std::vector<int>& boundary) {
  const int n = matrix.rows();
  std::vector<char> last(n, 0);
  for (const int b : boundary) last[b] = 1;
  const std::vector<char> same = patternOfTheOneBefore(matrix);
  Groups groups;
  groups.of.resize(n);
  for (const char side : {0, 1}) {
    for (int j = 0; j < n; ++j) {
      if (last[j] != side) continue;
      const bool joins = j > 0 && last[j - 1] == side && same[j];
      if (!joins) {
        groups.first.push_back(j);
        groups.size.push_back(0);
      }
      groups.of[j] = groups.count() - 1;
      ++groups.size.back();
    }
    if (side == 0) groups.interior = groups.count();
  }
  return groups;
}

/// Calls visit(g, h) once for each pair of coupled groups. The unknowns of a group are consecutive: the first one's column below the
/// diagonal lists the later groups.
template <typename Visit>
void forEachCouple(const SymmetricMatrix& matrix, const Groups& groups, const Visit& visit) {
  for (int g = 0; g < groups.count(); ++g) {
    int known = g;  // rows ascend, hence groups do, too
    for (SparseMatrix::InnerIterator it(matrix.lower(), groups.first[g]); it; ++it) {
      const int other = groups.of[it.row()];
      if (other == g || other == known) continue;
      known = other;
      visit(g, other);
    }
  }
}

Adjacency adjacencyOf(const SymmetricMatrix& matrix, const Groups& groups) {
  Adjacency graph;
  graph.first.assign(groups.count() + 1, 0);
  forEachCouple(matrix, groups, [&](int g, int other) { ++graph.first[g + 1], ++graph.first[other + 1]; });
  std::partial_sum(graph.first.begin(), graph.first.end(), graph.first.begin());
  graph.adjacent.resize(graph.first.back());
  std::vector<int> next(graph.first.begin(), graph.first.end() - 1);
  forEachCouple(matrix, groups, [&](int g, int other) {
    graph.adjacent[next[g]++] = other;
    graph.adjacent[next[other]++] = g;
  });
  return graph;
}

}  // namespace

FrontTree::FrontTree(const SymmetricMatrix& matrix, const std::vector<int>& boundary, const std::vector<Point>& places) {
  const Groups groups = groupsOf(matrix, boundary);
  const Adjacency graph = adjacencyOf(matrix, groups);
  interiorGroups = groups.interior;
  std::vector<Point> placeOf;
  placeOf.reserve(interiorGroups);
  for (int g = 0; g < interiorGroups; ++g) placeOf.push_back(places[groups.first[g]]);
  DissectionOrder dissection = nestedDissection(graph, placeOf, interiorGroups, kLeaf);
  std::vector<int>& order = dissection.order;
  for (int g = interiorGroups; g < groups.count(); ++g) order.push_back(g);

  std::vector<int> position(groups.count());
  unknownAt.reserve(matrix.rows());
  start.push_back(0);
  for (int p = 0; p < groups.count(); ++p) {
    position[order[p]] = p;
    for (int k = 0; k < groups.size[order[p]]; ++k) unknownAt.push_back(groups.first[order[p]] + k);
    start.push_back(static_cast<int>(unknownAt.size()));
  }

  // The rows of a front: couplings of its groups, and rows left by its children.
  const std::vector<int>& ends = dissection.ends;
  std::vector<std::vector<int>> children(ends.size());
  std::vector<int> seen(groups.count(), -1);
  fronts.resize(ends.size());
  for (int f = 0; f < static_cast<int>(ends.size()); ++f) {
    Front& front = fronts[f];
    front.firstGroup = f == 0 ? 0 : ends[f - 1];
    front.endGroup = ends[f];
    front.firstRow = static_cast<int>(rows.size());
    const auto see = [&](int p) {
      if (p < front.endGroup || seen[p] == f) return;
      seen[p] = f;
      rows.push_back(p);
    };
    for (int p = front.firstGroup; p < front.endGroup; ++p)
      for (const int other : graph.of(order[p])) see(position[other]);
    for (const int child : children[f])
      for (int r = fronts[child].firstRow; r < fronts[child].endRow; ++r) see(rows[r]);
    std::sort(rows.begin() + front.firstRow, rows.end());
    front.endRow = static_cast<int>(rows.size());
    if (front.firstRow == front.endRow || rows[front.firstRow] >= interiorGroups) continue;
    front.parent = static_cast<int>(std::upper_bound(ends.begin(), ends.end(), rows[front.firstRow]) - ends.begin());
    children[front.parent].push_back(f);
  }
}

}  // namespace suture
