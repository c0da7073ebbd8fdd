#include <suture/algebra/dense/SymmetricMatrix.hpp>

#include <algorithm>

namespace suture {

SymmetricMatrix::SymmetricMatrix(SparseMatrix&& matrix) {
  const int n = static_cast<int>(matrix.rows()), *start = matrix.outerIndexPtr(), *row = matrix.innerIndexPtr();
  std::vector<int> from(n);  // start of the triangle in each column
  Eigen::Index onDiagonal = 0, below = 0;
  for (int j = 0; j < n; ++j) {
    from[j] = static_cast<int>(std::lower_bound(row + start[j], row + start[j + 1], j) - row);
    onDiagonal += from[j] < start[j + 1] && row[from[j]] == j;
    below += start[j + 1] - from[j];
  }
  nonZeros_ = 2 * below - onDiagonal;
  if (below == matrix.nonZeros()) {
    lower_.swap(matrix);
    return;
  }
  lower_.resize(n, n);
  lower_.resizeNonZeros(below);
  int* ends = lower_.outerIndexPtr();
  for (int j = 0; j < n; ++j) {
    ends[j + 1] = ends[j] + start[j + 1] - from[j];
    std::copy(row + from[j], row + start[j + 1], lower_.innerIndexPtr() + ends[j]);
    std::copy(matrix.valuePtr() + from[j], matrix.valuePtr() + start[j + 1], lower_.valuePtr() + ends[j]);
  }
}

SparseMatrix SymmetricMatrix::full() const {
  const int n = rows(), *start = lower_.outerIndexPtr(), *row = lower_.innerIndexPtr();
  const double* value = lower_.valuePtr();
  SparseMatrix both(n, n);
  int* ends = both.outerIndexPtr();
  for (int j = 0; j < n; ++j)
    for (int k = start[j]; k < start[j + 1]; ++k) {
      ++ends[j + 1];
      if (row[k] != j) ++ends[row[k] + 1];
    }
  for (int j = 0; j < n; ++j) ends[j + 1] += ends[j];
  both.resizeNonZeros(ends[n]);
  // Column by column: the entries of a column above the diagonal have all been written, in order, by the columns before it.
  std::vector<int> next(ends, ends + n);
  for (int j = 0; j < n; ++j) {
    std::copy(row + start[j], row + start[j + 1], both.innerIndexPtr() + next[j]);
    std::copy(value + start[j], value + start[j + 1], both.valuePtr() + next[j]);
    for (int k = start[j]; k < start[j + 1]; ++k) {
      if (row[k] == j) continue;
      const int at = next[row[k]]++;
      both.innerIndexPtr()[at] = j;
      both.valuePtr()[at] = value[k];
    }
  }
  return both;
}

}  // namespace suture
