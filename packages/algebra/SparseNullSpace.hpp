#pragma once
#include <suture/algebra/SparseMatrix.hpp>

namespace suture {

/// Basis of the null space of a sparse matrix by a rank-revealing sparse QR factorisation (Davis 2011, SuiteSparseQR): columns of the
/// matrix whose norm vanishes during the factorisation depend on others. Local. \param threshold  norm below which a column depends on
/// others \return columns x dimension of the null space; not orthonormal, mostly sparse
Matrix sparseNullBasis(const SparseMatrix& rows, double threshold);

/// The same, orthonormal.
Matrix sparseNullSpace(const SparseMatrix& rows, double threshold);

}  // namespace suture
