#pragma once
namespace suture {

// The two dense steps of a front: its columns are eliminated, and what they leave goes to the rest. Matrices by columns, local.

/// Cholesky factor of the leading triangle of a trapezoid, and the rows below it times the inverse of its transpose, in place. By panels of
/// twelve columns, products of matrices between them. For all fronts of hertz at 1M unknowns, most of which have some 16 columns of 50
/// rows: 0.12 to 0.15 s, by LAPACK's dpotrf and BLAS' dtrsm (OpenBLAS 0.3.21, a core of an EPYC) 0.34 to 0.37 s. \param rows  all of them,
/// the triangle's among them \return 0, or the number, from 1, of the first pivot that is not positive
int factorColumns(int columns, int rows, double* values, int stride);

/// target <- share target - panel panel^T, the lower triangle; of the upper one some entries are written, too. By products of matrices, 24
/// columns at a time: for the same fronts 0.51 to 0.59 s, by BLAS' dsyrk 0.73 s. A target with share 0 is not read.
void subtractSquare(int rows, int columns, const double* panel, int panelStride, double share, double* target, int targetStride);

}  // namespace suture
