#include <SuiteSparseQR.hpp>
#include <suture/algebra/SparseNullSpace.hpp>
#include <suture/algebra/dense/Decompositions.hpp>
#include <suture/base/Errors.hpp>

#include <algorithm>
#include <memory>
#include <vector>

namespace suture {

namespace {

/// CHOLMOD's settings for long integers.
struct Settings {
  cholmod_common common;
  Settings() {
    cholmod_l_start(&common);
    common.print = 0;
    common.try_catch = 1;
  }
  ~Settings() { cholmod_l_finish(&common); }
  Settings(const Settings&) = delete;
  Settings& operator=(const Settings&) = delete;
};

/// Upper staircase matrix R and the column order of rows E = Q R.
struct Staircase {
  std::vector<std::vector<std::pair<int, double>>> rows;  // entries by column, ascending
  std::vector<int> order;
};

Staircase factor(const SparseMatrix& matrix, double threshold) {
  Settings settings;
  cholmod_common* common = &settings.common;
  cholmod_sparse* a = cholmod_l_allocate_sparse(matrix.rows(), matrix.cols(), matrix.nonZeros(), 1, 1, 0, CHOLMOD_REAL, common);
  if (!a) throw EnvironmentError("sparse QR: out of memory");
  auto *starts = static_cast<SuiteSparse_long*>(a->p), *at = static_cast<SuiteSparse_long*>(a->i);
  auto* values = static_cast<double*>(a->x);
  std::copy(matrix.outerIndexPtr(), matrix.outerIndexPtr() + matrix.cols() + 1, starts);
  std::copy(matrix.innerIndexPtr(), matrix.innerIndexPtr() + matrix.nonZeros(), at);
  std::copy(matrix.valuePtr(), matrix.valuePtr() + matrix.nonZeros(), values);
  cholmod_sparse* r = nullptr;
  SuiteSparse_long* permutation = nullptr;
  const SuiteSparse_long rank = SuiteSparseQR<double>(SPQR_ORDERING_DEFAULT, threshold, 0, a, &r, &permutation, common);
  cholmod_l_free_sparse(&a, common);
  if (rank < 0 || !r) throw EnvironmentError("sparse QR failed: out of memory");
  Staircase result;
  result.rows.resize(static_cast<std::size_t>(rank));
  const auto *begin = static_cast<SuiteSparse_long*>(r->p), *rowOf = static_cast<SuiteSparse_long*>(r->i);
  const auto* entries = static_cast<double*>(r->x);
  for (SuiteSparse_long column = 0; column < matrix.cols(); ++column) {
    result.order.push_back(static_cast<int>(permutation ? permutation[column] : column));
    for (SuiteSparse_long k = begin[column]; k < begin[column + 1]; ++k)
      if (rowOf[k] < rank && entries[k] != 0.0)
        result.rows[static_cast<std::size_t>(rowOf[k])].emplace_back(static_cast<int>(column), entries[k]);
  }
  cholmod_l_free_sparse(&r, common);
  if (permutation) cholmod_l_free(matrix.cols(), sizeof(SuiteSparse_long), permutation, common);
  return result;
}

}  // namespace

Matrix sparseNullBasis(const SparseMatrix& rows, double threshold) {
  const Eigen::Index n = rows.cols();
  if (rows.nonZeros() == 0) return Matrix::Identity(n, n);
  SparseMatrix compressed = rows;
  compressed.makeCompressed();
  const Staircase r = factor(compressed, threshold);
  std::vector<char> isPivot(static_cast<std::size_t>(n), 0);
  for (const auto& row : r.rows) {
    if (row.empty() || isPivot[static_cast<std::size_t>(row.front().first)]) throw InternalError("sparse QR: a row without pivot");
    isPivot[static_cast<std::size_t>(row.front().first)] = 1;
  }
  std::vector<Eigen::Index> columnOf(static_cast<std::size_t>(n), -1);  // column of each dependent unknown in the basis
  Eigen::Index count = 0;
  for (std::size_t k = 0; k < isPivot.size(); ++k)
    if (!isPivot[k]) columnOf[k] = count++;
  if (count == 0) return Matrix(n, 0);
  // Each dependent unknown is one in its own vector; the pivots follow from the rows, the last first.
  Matrix basis = Matrix::Zero(n, count);
  for (std::size_t k = 0; k < isPivot.size(); ++k)
    if (columnOf[k] >= 0) basis(static_cast<Eigen::Index>(k), columnOf[k]) = 1.0;
  for (auto row = r.rows.rbegin(); row != r.rows.rend(); ++row) {
    const auto& [pivot, size] = row->front();
    for (std::size_t k = 1; k < row->size(); ++k) basis.row(pivot) -= (*row)[k].second * basis.row((*row)[k].first);
    basis.row(pivot) /= size;
  }
  Matrix ordered(n, count);
  for (Eigen::Index k = 0; k < n; ++k) ordered.row(r.order[static_cast<std::size_t>(k)]) = basis.row(k);
  return ordered;
}

Matrix sparseNullSpace(const SparseMatrix& rows, double threshold) { return orthonormalBasis(sparseNullBasis(rows, threshold), 0.0); }

}  // namespace suture
