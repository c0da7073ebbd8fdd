#include <suture/algebra/SparseMatrix.hpp>

#include <algorithm>

namespace suture {

SparseMatrix block(const SparseMatrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns) {
  std::vector<int> place(matrix.rows(), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) place[rows[i]] = static_cast<int>(i);
  // Filled by rows with ascending columns; Eigen converts to columns. Both steps are linear and need no sort.
  Eigen::SparseMatrix<double, Eigen::RowMajor, int> byRow(static_cast<int>(rows.size()), static_cast<int>(columns.size()));
  int* first = byRow.outerIndexPtr();
  const auto eachEntry = [&](auto&& take) {
    for (std::size_t j = 0; j < columns.size(); ++j)
      for (SparseMatrix::InnerIterator it(matrix, columns[j]); it; ++it)
        if (const int row = place[it.row()]; row >= 0) take(row, static_cast<int>(j), it.value());
  };
  eachEntry([&](int row, int, double) { ++first[row + 1]; });
  for (std::size_t i = 0; i < rows.size(); ++i) first[i + 1] += first[i];
  byRow.resizeNonZeros(first[rows.size()]);
  std::vector<int> next(first, first + rows.size());
  eachEntry([&](int row, int column, double value) {
    byRow.innerIndexPtr()[next[row]] = column;
    byRow.valuePtr()[next[row]++] = value;
  });
  return SparseMatrix(byRow);
}

SparseMatrix principalBlock(const SparseMatrix& matrix, const std::vector<int>& positions) {
  const int size = static_cast<int>(positions.size()), *start = matrix.outerIndexPtr(), *row = matrix.innerIndexPtr();
  std::vector<int> place(matrix.rows(), -1);
  for (int i = 0; i < size; ++i) place[positions[i]] = i;
  SparseMatrix made(size, size);
  int* ends = made.outerIndexPtr();
  for (int j = 0; j < size; ++j)
    ends[j + 1] = ends[j] + static_cast<int>(std::count_if(row + start[positions[j]], row + start[positions[j] + 1],
                                                           [&](int i) { return place[i] >= 0; }));
  made.resizeNonZeros(ends[size]);
  int to = 0;
  for (const int column : positions)
    for (int k = start[column]; k < start[column + 1]; ++k)
      if (place[row[k]] >= 0) {
        made.innerIndexPtr()[to] = place[row[k]];
        made.valuePtr()[to++] = matrix.valuePtr()[k];
      }
  return made;
}

Matrix rowsAt(const Matrix& matrix, const std::vector<int>& positions) {
  Matrix rows(positions.size(), matrix.cols());
  for (std::size_t i = 0; i < positions.size(); ++i) rows.row(i) = matrix.row(positions[i]);
  return rows;
}

SparseRows rowsAt(const SparseRows& matrix, const std::vector<int>& positions) {
  std::vector<Eigen::Triplet<double, int>> entries;
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (SparseRows::InnerIterator entry(matrix, positions[i]); entry; ++entry)
      entries.emplace_back(static_cast<int>(i), static_cast<int>(entry.col()), entry.value());
  SparseRows rows(static_cast<Eigen::Index>(positions.size()), matrix.cols());
  rows.setFromTriplets(entries.begin(), entries.end());
  return rows;
}

SparseRows columnsAt(const SparseRows& matrix, const std::vector<int>& positions) {
  std::vector<int> place(static_cast<std::size_t>(matrix.cols()), -1);
  for (std::size_t k = 0; k < positions.size(); ++k) place[static_cast<std::size_t>(positions[k])] = static_cast<int>(k);
  std::vector<Eigen::Triplet<double, int>> entries;
  for (int i = 0; i < static_cast<int>(matrix.rows()); ++i)
    for (SparseRows::InnerIterator entry(matrix, i); entry; ++entry)
      if (const int column = place[static_cast<std::size_t>(entry.col())]; column >= 0) entries.emplace_back(i, column, entry.value());
  SparseRows columns(matrix.rows(), static_cast<Eigen::Index>(positions.size()));
  columns.setFromTriplets(entries.begin(), entries.end());
  return columns;
}

std::vector<int> complement(int size, const std::vector<int>& some) {
  std::vector<char> taken(size, 0);
  for (int i : some) taken[i] = 1;
  std::vector<int> others;
  for (int i = 0; i < size; ++i)
    if (!taken[i]) others.push_back(i);
  return others;
}

}  // namespace suture
