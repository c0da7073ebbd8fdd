#include <suture/algebra/SparseMatrix.hpp>

namespace suture {

SparseMatrix block(const SparseMatrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns) {
  std::vector<int> place(matrix.rows(), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) place[rows[i]] = static_cast<int>(i);
  // Filled by rows, columns ascending; Eigen turns it over into columns. Both steps are linear, and need no sort.
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

Matrix rowsAt(const Matrix& matrix, const std::vector<int>& positions) {
  Matrix rows(positions.size(), matrix.cols());
  for (std::size_t i = 0; i < positions.size(); ++i) rows.row(i) = matrix.row(positions[i]);
  return rows;
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
