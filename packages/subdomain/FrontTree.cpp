#include <cholmod.h>
#include <suture/subdomain/CholmodHandle.hpp>
#include <suture/subdomain/FrontTree.hpp>

#include <algorithm>

namespace suture {

namespace {

/// Lower triangle of a graph, compressed columns, sorted.
struct Pattern {
  std::vector<int> first = {0}, rows;

  cholmod_sparse view() const {
    cholmod_sparse made{};
    made.nrow = made.ncol = first.size() - 1;
    made.nzmax = rows.size();
    made.p = const_cast<int*>(first.data());
    made.i = const_cast<int*>(rows.data());
    made.stype = -1;
    made.itype = CHOLMOD_INT;
    made.xtype = CHOLMOD_PATTERN;
    made.sorted = made.packed = 1;
    return made;
  }
};

bool samePattern(const SparseMatrix& matrix, int a, int b) {
  const int *first = matrix.outerIndexPtr(), *rows = matrix.innerIndexPtr();
  return first[a + 1] - first[a] == first[b + 1] - first[b] && std::equal(rows + first[a], rows + first[a + 1], rows + first[b]);
}

}  // namespace

FrontTree::FrontTree(const SparseMatrix& matrix, const std::vector<int>& boundary) {
  const int n = static_cast<int>(matrix.rows());
  std::vector<char> last(n, 0);
  for (const int b : boundary) last[b] = 1;
  // Groups in the order of the matrix, interior first: their first unknowns.
  std::vector<int> members, groupOf(n), sizes;
  for (const char side : {0, 1}) {
    for (int j = 0; j < n; ++j) {
      if (last[j] != side) continue;
      const bool joins = j > 0 && last[j - 1] == side && samePattern(matrix, j - 1, j);
      if (!joins) {
        members.push_back(j);
        sizes.push_back(0);
      }
      groupOf[j] = static_cast<int>(members.size()) - 1;
      ++sizes.back();
    }
    if (side == 0) interiorGroups = static_cast<int>(members.size());
  }
  const int all = static_cast<int>(members.size());

  Pattern whole, leading;
  std::vector<int> seen(all, -1);
  for (int g = 0; g < all; ++g) {
    for (SparseMatrix::InnerIterator it(matrix, members[g]); it; ++it) {
      const int row = groupOf[it.row()];
      if (row < g || seen[row] == g) continue;
      seen[row] = g;
      whole.rows.push_back(row);
    }
    std::sort(whole.rows.begin() + whole.first.back(), whole.rows.end());
    if (g < interiorGroups) {
      for (std::size_t k = whole.first.back(); k < whole.rows.size() && whole.rows[k] < interiorGroups; ++k)
        leading.rows.push_back(whole.rows[k]);
      leading.first.push_back(static_cast<int>(leading.rows.size()));
    }
    whole.first.push_back(static_cast<int>(whole.rows.size()));
  }

  CholmodHandle cholmod;
  std::vector<int> order(all);
  for (int g = 0; g < all; ++g) order[g] = g;
  if (interiorGroups > 0) {
    cholmod_sparse view = leading.view();
    cholmod_amd(&view, nullptr, 0, order.data(), cholmod.common.get());
    cholmod.check("ordering a subdomain");
    view = whole.view();
    cholmod.common->nmethods = 1;
    cholmod.common->method[0].ordering = CHOLMOD_GIVEN;
    cholmod.common->postorder = 0;  // AMD leaves a postordered tree of the interior, which stays one when the boundary is appended
    cholmod.common->supernodal = CHOLMOD_SUPERNODAL;
    for (std::size_t& columns : cholmod.common->nrelax) columns /= 2;  // CHOLMOD means unknowns, and a group is mostly two
    cholmod.factor = cholmod_analyze_p(&view, order.data(), nullptr, 0, cholmod.common.get());
    cholmod.check("analysing a subdomain");
  }

  start.push_back(0);
  for (const int g : order) {
    for (int k = 0; k < sizes[g]; ++k) unknownAt.push_back(members[g] + k);
    start.push_back(static_cast<int>(unknownAt.size()));
  }
  if (interiorGroups == 0) return;

  const int *super = static_cast<const int*>(cholmod.factor->super), *place = static_cast<const int*>(cholmod.factor->pi),
            *below = static_cast<const int*>(cholmod.factor->s);
  std::vector<int> frontOf(interiorGroups);
  for (int s = 0; s < static_cast<int>(cholmod.factor->nsuper) && super[s] < interiorGroups; ++s) {
    Front front;
    front.firstGroup = super[s];
    front.endGroup = std::min(super[s + 1], interiorGroups);  // relaxed supernodes may straddle the limit
    front.firstRow = static_cast<int>(rows.size());
    rows.insert(rows.end(), below + place[s] + (front.endGroup - front.firstGroup), below + place[s + 1]);
    front.endRow = static_cast<int>(rows.size());
    std::fill(frontOf.begin() + front.firstGroup, frontOf.begin() + front.endGroup, static_cast<int>(fronts.size()));
    fronts.push_back(front);
  }
  for (Front& front : fronts)
    if (front.firstRow < front.endRow && rows[front.firstRow] < interiorGroups) front.parent = frontOf[rows[front.firstRow]];
}

}  // namespace suture
