#include <suture/algebra/elimination/Supervariables.hpp>

#include <algorithm>
#include <utility>

namespace suture {

Supervariables::Supervariables(const SparseMatrix& matrix, int size) : size_(size), groupOf_(size, 0) {
  const int *start = matrix.outerIndexPtr(), *rows = matrix.innerIndexPtr();
  const auto lower = [&](int column) {
    const int* const end = std::lower_bound(rows + start[column], rows + start[column + 1], size);
    return std::pair(std::lower_bound(rows + start[column], end, column), end);
  };
  // A group begins at a row if some column to the left contains only one of this row and the previous one, or if their two columns differ
  // below.
  std::vector<char> begins(size + 1, 0);
  for (int column = 0; column < size; ++column) {
    const auto [from, end] = lower(column);
    const int* const below = from != end && *from == column ? from + 1 : from;
    int last = column;
    for (const int* row = below; row != end; last = *row++)
      if (*row != last + 1) begins[last + 1] = begins[*row] = 1;
    begins[last + 1] = 1;
    if (column + 1 == size) continue;
    const auto [next, nextEnd] = lower(column + 1);
    if (end - below != nextEnd - next || !std::equal(below, end, next)) begins[column + 1] = 1;
  }
  for (int unknown = 0; unknown < size; ++unknown) {
    if (unknown == 0 || begins[unknown]) first_.push_back(unknown);
    groupOf_[unknown] = static_cast<int>(first_.size()) - 1;
  }
  first_.push_back(size);
}

SparseMatrix Supervariables::graph(const SparseMatrix& matrix) const {
  SparseMatrix graph(count(), count());
  graph.reserve(matrix.nonZeros() / 8);
  for (int group = 0; group < count(); ++group) {
    graph.startVec(group);
    int last = group - 1;
    for (SparseMatrix::InnerIterator it(matrix, first_[group]); it; ++it)
      if (it.row() < size_ && groupOf_[it.row()] > last) graph.insertBack(last = groupOf_[it.row()], group) = 1.0;
  }
  graph.finalize();
  return graph;
}

void Supervariables::expand(const std::vector<int>& order, int* to) const {
  for (const int group : order)
    for (int unknown = first_[group]; unknown < first_[group + 1]; ++unknown) *to++ = unknown;
}

SparseMatrix permutedLower(const SparseMatrix& matrix, const std::vector<int>& order) {
  const int n = static_cast<int>(order.size());
  std::vector<int> place(n);
  for (int i = 0; i < n; ++i) place[order[i]] = i;
  // Filled by rows, then by columns, in which the rows ascend.
  std::vector<int> rowStart(n + 1, 0);
  SparseMatrix made(n, n);
  int* const start = made.outerIndexPtr();
  const auto eachEntry = [&](const auto& take) {
    for (int j = 0; j < n; ++j)
      for (SparseMatrix::InnerIterator it(matrix, j); it; ++it)
        if (it.row() >= j) take(std::max(place[it.row()], place[j]), std::min(place[it.row()], place[j]), it.value());
  };
  eachEntry([&](int row, int column, double) {
    ++rowStart[row + 1];
    ++start[column + 1];
  });
  for (int i = 0; i < n; ++i) {
    rowStart[i + 1] += rowStart[i];
    start[i + 1] += start[i];
  }
  made.resizeNonZeros(start[n]);
  std::vector<std::pair<int, double>> byRow(start[n]);
  std::vector<int> next(rowStart.begin(), rowStart.end() - 1);
  eachEntry([&](int row, int column, double value) { byRow[next[row]++] = {column, value}; });
  next.assign(start, start + n);
  for (int row = 0; row < n; ++row)
    for (int k = rowStart[row]; k < rowStart[row + 1]; ++k) {
      const int to = next[byRow[k].first]++;
      made.innerIndexPtr()[to] = row;
      made.valuePtr()[to] = byRow[k].second;
    }
  return made;
}

}  // namespace suture
