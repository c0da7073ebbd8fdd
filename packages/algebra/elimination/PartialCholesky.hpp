#pragma once

namespace suture {

// The two dense steps of an elimination: columns are factored together with the rows below them, and subtracted from the rest. Matrices of
// doubles by columns, with a stride of `stride` (at least `rows`) numbers. Local.
//
// Both use matrix products between panels of a few columns, because most fronts are small (16 columns of 50 rows). Hertz at 1M unknowns,
// all fronts and local problems of BDDC, one core of an EPYC, three runs in alternation: factors in 0.32 to 0.36 s, by LAPACK's dpotrf and
// BLAS' dtrsm (OpenBLAS 0.3.21) in 0.53 to 0.64; updates 0.52 to 0.89, by dsyrk 0.68 to 0.88 (medians 0.57 and 0.75).

/// Cholesky factor L_11 of the leading triangle of a trapezoid [A_11; A_21], and below it L_21 = A_21 L_11^-T, in place. Only the lower
/// triangle of A_11 is used; some entries above it are overwritten.
/// \param columns  number of columns of A_11
/// \param rows     number of rows of A_11 and A_21 together
/// \return 0, or the number, from 1, of the first pivot that is not positive (or is NaN); columns from there on are not factored
int partialCholesky(int columns, int rows, double* values, int stride);

/// target <- share target - panel panel^T, the lower triangle: with panel = L_21 and share = 1 the Schur complement of A_11 in A_22. Some
/// entries of the upper triangle are overwritten. With share = 0 the target is not read.
/// \param rows     number of rows of panel and target
/// \param columns  number of columns of panel
void symmetricRankUpdate(int rows, int columns, const double* panel, int panelStride, double share, double* target, int targetStride);

}  // namespace suture
