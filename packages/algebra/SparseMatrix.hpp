#pragma once
#include <suture/base/Types.hpp>

#include <Eigen/SparseCore>
#include <vector>

namespace suture {

/// Matrices on one rank; compressed columns. Symmetric ones hold both triangles; long-lived ones are kept as SymmetricMatrix (one
/// triangle).
using SparseMatrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

/// The same with compressed rows.
using SparseRows = Eigen::SparseMatrix<double, Eigen::RowMajor, int>;

/// The block of rows and columns given by two lists of positions (each position at most once). Local.
SparseMatrix block(const SparseMatrix& matrix, const std::vector<int>& rows, const std::vector<int>& columns);

/// The rows and columns of a symmetric matrix at ascending positions, in one pass; block() needs two. Local.
SparseMatrix principalBlock(const SparseMatrix& matrix, const std::vector<int>& positions);

/// Rows of a dense matrix at some positions.
Matrix rowsAt(const Matrix& matrix, const std::vector<int>& positions);
SparseRows rowsAt(const SparseRows& matrix, const std::vector<int>& positions);
/// Columns at ascending positions.
SparseRows columnsAt(const SparseRows& matrix, const std::vector<int>& positions);

/// Positions 0..size-1 that are not in `some`, ascending.
std::vector<int> complement(int size, const std::vector<int>& some);

}  // namespace suture
