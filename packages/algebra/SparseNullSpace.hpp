#pragma once
#include <suture/algebra/SparseMatrix.hpp>

namespace suture {

constexpr int kMostDense = 60;  ///< columns up to which dense decompositions of such matrices are faster than sparse ones

/// Basis of the null space of a sparse matrix by a rank-revealing sparse QR factorisation (Davis 2011, SuiteSparseQR): columns of the
/// matrix whose norm vanishes during the factorisation depend on others. Not orthonormal, mostly sparse. Local.
/// \param threshold  norm below which a column depends on others
/// \return columns of the matrix x dimension of the null space
Matrix sparseNullBasis(const SparseMatrix& rows, double threshold);

/// The same, orthonormal.
Matrix sparseNullSpace(const SparseMatrix& rows, double threshold);

}  // namespace suture
