#include <suture/subdomain/SparseMatrix.hpp>

#include <vector>

namespace suture {

SparseMatrix block(const SparseMatrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns) {
  std::vector<int> place(matrix.rows(), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) place[rows[i]] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (SparseMatrix::InnerIterator it(matrix, columns[j]); it; ++it)
      if (place[it.row()] >= 0) entries.emplace_back(place[it.row()], static_cast<int>(j), it.value());
  SparseMatrix result(static_cast<int>(rows.size()), static_cast<int>(columns.size()));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
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
